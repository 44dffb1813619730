// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_app_output_choice_h
#define crevasse_app_output_choice_h

#include <crevasse/app/command_line.h>
#include <crevasse/base/directory_lock.h>
#include <crevasse/base/summary.h>
#include <crevasse/checkpoint/checkpoints.h>
#include <crevasse/parameters/scene.h>

#include <filesystem>

namespace Crevasse
{
  /** The output directory of a run, and its source, which messages name. */
  class OutputChoice
  {
  public:
    /** Chooses --output, else the scene's output directory, else results/NAME
     * for the scene NAME.prm. */
    OutputChoice(const Command &command, const Scene &scene);

    const std::string directory;

    /** Checks that a run can use the directory, without creating anything: an
     * existing part may not be a directory or may forbid writing. Other
     * obstacles of a file system only prepare() finds. @throw FileError */
    void
    require_usable() const;

    /** Checks for checkpoints of an unfinished run with the same parameters,
     * where --resume was probably forgotten.
     * @throw SceneError if there are any and nothing else was requested. */
    void
    require_nothing_to_resume(const std::string &used_parameters) const;

    /** Reason why a finished run in the directory cannot be resumed; empty if
     * it has not ended, or if the scene now allows more periods.
     *
     * @param parameters all of the scene; see scene_as_json().
     * @throw SceneError if the finished run had another scene. */
    std::string
    why_finished(const Scene &scene, const Summary &parameters) const;

    /** Marks the directory as that of an unfinished run, which continues there
     * from a checkpoint, and keeps others out while the lock exists.
     * @param used text of used.prm.
     * @throw FileError */
    std::unique_ptr<DirectoryLock>
    resume(const std::string &used, const Checkpoints &checkpoints) const;

    /** Creates the directory if needed, clears away the results of an earlier
     * run, so that none is mistaken for a result of this run, and keeps others
     * out while the lock exists. Without a used.prm, the sign of a run, files
     * stay, as do other files. A log alone is not kept.
     * The log names the folder "earlier_1", "earlier_2", … in which earlier
     * results are kept.
     * @param used text of used.prm.
     * @throw FileError, also if a directory has the name of a result file. */
    std::unique_ptr<DirectoryLock>
    prepare(const std::string &used, Log &log) const;

  private:
    [[noreturn]] void
    fail(const std::string &what) const;

    /** Creates the directory and its parents if needed, and checks that files
     * can be written there. @throw FileError */
    void
    require_writable() const;

    /** Moves or removes the results of an earlier run, and reports about them,
     * which would not describe the new results.
     * @return the folder in which they are kept, if they are. */
    std::string
    clear_earlier_results() const;

    const bool from_command_line, may_replace;
  };
} // namespace Crevasse

#endif
