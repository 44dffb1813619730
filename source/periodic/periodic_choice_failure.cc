// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/periodic/observed_periods.h>
#include <crevasse/periodic/periodic_choice.h>

#include <cmath>

namespace Crevasse
{
  namespace
  {
    /** Estimated number of further periods of a march at the current rate, in
     * brackets; empty if unknown. */
    std::string
    periods_to_go(const PeriodicResult &result, const double tolerance)
    {
      const double change = result.stress_change.back();
      const double error  = result.stress_error_estimate.back();
      // A ReturnDefect does not fall with the changes, nor does what another
      // Converged quantity lacks.
      if (result.periods < 3 || result.return_defect >= error ||
          !std::isfinite(error) || error <= tolerance)
        return "";
      return Text::Message() << " (about "
                             << std::ceil(std::log(tolerance / error) /
                                          std::log(error / (change + error)))
                             << " more at the current rate)";
    }
  } // namespace



  std::string
  PeriodicChoice::message_of_failure(const PeriodicStateParameters &parameters,
                                     const PeriodicResult &result) const
  {
    if (!parameters.missions.empty())
      return "[Periodic state] Maximum periods = " +
             std::to_string(parameters.maximum_periods) +
             " ended the run before the last of Missions. All results so far "
             "are written. Raise it and continue by --resume, or raise Mission "
             "tolerance.";
    const double      error     = result.judged_error;
    const std::string quantity  = parameters.converged_quantity;
    const bool        is_stress = quantity == "stress";
    Text::Message     message;
    const bool        is_slip = is_stress &&
                         std::isfinite(result.stress_error_estimate.back()) &&
                         !(error <= result.stress_error_estimate.back());
    if (is_stress)
      message << (is_slip
                    ? "The slip that a period leaves on the lips does not "
                      "repeat yet: "
                    : "The stress is not yet periodic: ");
    else
      message << "[Periodic state] Converged quantity = " << quantity
              << " is not yet periodic: ";
    message << "after " << result.periods
            << (result.periods == 1 ? " period" : " periods")
            << (is_stress && !is_slip ? " it" : " the stress")
            << " still changes by " << result.stress_change.back()
            << " of its maximum";
    if (!result.place.empty())
      message << ", most " << result.place;
    message << ", and ";
    message << (is_slip     ? "the error of the slip is "
                : is_stress ? "its error is "
                            : "the error of " + quantity + " is ");
    // The estimate of a stress that hardly relaxes may exceed it.
    if (error <= 1.)
      message << "estimated as " << error << ", more than ";
    else
      message << "not known to be within ";
    message << "[Periodic state] Tolerance = " << parameters.tolerance;
    if (!result.steps_repeat)
      message << ", because adaptive steps do not repeat";
    else if (result.periods > 1 && result.return_defect > parameters.tolerance)
      message << ", because the viscous strain is not yet periodic";
    if (quantity == "opening")
      message << ". A lip that a mean load opens further in each period has no "
                 "periodic opening";
    message << ". All results so far are written. Raise \"Maximum periods\"";
    if (method == PeriodicMethodType::march && result.steps_repeat && !is_slip)
      message << periods_to_go(result, parameters.tolerance);
    message << " and continue by --resume, allow a larger \"Tolerance\"";
    if (!alternative.empty())
      message << ", " << alternative << ',';
    message << " or set Tolerance = 0 to compute a fixed number of periods.";
    return message;
  }
} // namespace Crevasse
