// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_app_help_texts_h
#define crevasse_app_help_texts_h

namespace Crevasse
{
  /** Text after the options in the output of --help. */
  extern const char *const examples_and_statuses;

  /** Text for a call without arguments. */
  extern const char *const what_to_do_next;
} // namespace Crevasse

#endif
