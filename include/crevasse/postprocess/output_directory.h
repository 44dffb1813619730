// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_output_directory_h
#define crevasse_postprocess_output_directory_h

#include <string>

namespace Crevasse
{
  /** Creates the directory and its parents where needed and makes sure that
   * files can be written there. @throw FileError otherwise. */
  void
  require_writable_directory(const std::string &directory);

  /** What becomes of the results of an earlier run. */
  enum class EarlierResults
  {
    are_kept, ///< in a folder "earlier_1", "earlier_2", ... beside the new ones
    are_removed
  };

  /**
   * Clears away what an earlier run has written there, so that nothing of it is
   * taken for a result of this one. Other files stay, and so does everything
   * where no used.prm tells that there was a run. A log alone is not kept.
   *
   * @return the folder in which results are kept, or nothing.
   * @throw FileError if something cannot be moved or removed, or a directory
   * has the name of a file that is to be written.
   */
  std::string
  clear_earlier_results(const std::string   &directory,
                        const EarlierResults fate);
} // namespace Crevasse

#endif
