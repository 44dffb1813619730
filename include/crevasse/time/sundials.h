// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_sundials_h
#define crevasse_time_sundials_h

#include <memory>
#include <string>
#include <sundials/sundials_context.h>
#include <type_traits>

namespace Crevasse
{
  // Where SUNDIALS 6 and 7 differ. The names ARKStep… are used elsewhere: 7 has
  // them beside its own, ARKode…, which 6 has not.

  using SundialsContext =
    std::unique_ptr<std::remove_pointer_t<SUNContext>, void (*)(SUNContext)>;

  /** Without a communicator: the vectors have theirs. */
  SundialsContext
  make_sundials_context();

  /** What ARKODE says of errors and warnings is kept in @p words, the last one
   * alone, instead of going to standard error.
   *
   * @param words must outlive both others. */
  void
  collect_messages(void            *arkode_memory,
                   const SUNContext context,
                   std::string     &words);
} // namespace Crevasse

#endif
