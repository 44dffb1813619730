// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/time/arkode_failure.h>

#include <arkode/arkode.h>
#include <sstream>

namespace Crevasse
{
  namespace
  {
    std::string
    advice(const int code)
    {
      switch (code)
        {
          case ARK_TOO_MUCH_ACC:
            return "the tolerances are below the rounding of the viscous "
                   "strain. Raise [Time integration] Relative tolerance or "
                   "Absolute tolerance; under a mean load [Periodic state] "
                   "Secular split = on keeps the strain small";
          case ARK_TOO_MUCH_WORK:
            return "the period takes more steps than the 1000000 that it may "
                   "have. Raise [Time "
                   "integration] Relative tolerance, or choose Scheme = arkode "
                   "implicit or sdirk2";
          case ARK_ERR_FAILURE:
            return "no step is short enough for the tolerances. Raise [Time "
                   "integration] Relative tolerance or Absolute tolerance "
                   "above the accuracy of the contact problems ([Contact] "
                   "Tolerance), look at what jumps in time at this instant, or "
                   "choose Step control = uniform";
          case ARK_CONV_FAILURE:
            return "an implicit stage was not solved. Choose Scheme = sdirk2";
          case ARK_RHSFUNC_FAIL:
          case ARK_FIRST_RHSFUNC_ERR:
          case ARK_REPTD_RHSFUNC_ERR:
          case ARK_UNREC_RHSFUNC_ERR:
          case ARK_RTFUNC_FAIL:
            return "a contact problem was not solved";
          default:
            return "that should not happen. Choose Scheme = sdirk2 or heun, "
                   "and report it";
        }
    }
  } // namespace



  std::string
  describe_arkode_failure(const int          code,
                          const double       t,
                          const std::string &words)
  {
    std::ostringstream text;
    text << "ARKODE stopped at t = " << t << " (code " << code
         << "): " << advice(code) << '.';
    if (!words.empty())
      text << " In its own words: " << words;
    return text.str();
  }
} // namespace Crevasse
