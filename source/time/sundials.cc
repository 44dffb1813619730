// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/time/sundials.h>

#include <deal.II/base/config.h>
#include <deal.II/base/exceptions.h>

#include <arkode/arkode_arkstep.h>

namespace Crevasse
{
  SundialsContext
  make_sundials_context()
  {
    SUNContext context = nullptr;
#if DEAL_II_SUNDIALS_VERSION_GTE(7, 0, 0)
    SUNContext_Create(SUN_COMM_NULL, &context);
#else
    SUNContext_Create(nullptr, &context);
#endif
    AssertThrow(context != nullptr, dealii::ExcOutOfMemory(0));
    return {context, [](SUNContext pointer) { SUNContext_Free(&pointer); }};
  }



  void
  collect_messages([[maybe_unused]] void            *arkode_memory,
                   [[maybe_unused]] const SUNContext context,
                   std::string                      &words)
  {
#if DEAL_II_SUNDIALS_VERSION_GTE(7, 0, 0)
    // Errors; warnings, which are no reason to fail, go to SUNDIALS' own log.
    SUNContext_ClearErrHandlers(context);
    SUNContext_PushErrHandler(
      context,
      [](int,
         const char *,
         const char *,
         const char *message,
         SUNErrCode,
         void *all_words,
         SUNContext) { *static_cast<std::string *>(all_words) = message; },
      &words);
#else
    ARKStepSetErrHandlerFn(
      arkode_memory,
      [](int, const char *, const char *, char *message, void *all_words) {
        *static_cast<std::string *>(all_words) = message;
      },
      &words);
#endif
  }
} // namespace Crevasse
