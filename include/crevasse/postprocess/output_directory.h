// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_output_directory_h
#define crevasse_postprocess_output_directory_h

#include <string>

namespace Crevasse
{
  /** Creates the directory and its parents if needed, and checks that files can
   * be written there. @throw FileError otherwise. */
  void
  require_writable_directory(const std::string &directory);

  /** What happens to the results of an earlier run. */
  enum class EarlierResults
  {
    are_kept, ///< they are moved to a folder "earlier_1", "earlier_2", ...
    are_removed
  };

  /**
   * Moves or removes the results of an earlier run, so that none is mistaken
   * for a result of this run. Other files stay, as does everything without a
   * used.prm, the sign of a run. A log alone is not kept.
   *
   * @return the folder in which results are kept, or nothing.
   * @throw FileError if something cannot be moved or removed, or a directory
   * has the name of a result file.
   */
  std::string
  clear_earlier_results(const std::string   &directory,
                        const EarlierResults fate);
} // namespace Crevasse

#endif
