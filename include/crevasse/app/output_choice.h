// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_app_output_choice_h
#define crevasse_app_output_choice_h

#include <crevasse/app/command_line.h>
#include <crevasse/base/directory_lock.h>
#include <crevasse/base/summary.h>
#include <crevasse/parameters/scene.h>

namespace Crevasse
{
  /** Where a run writes to, and who says so: messages name it. */
  class OutputChoice
  {
  public:
    /** --output, else the scene's output directory, else results/NAME for the
     * scene NAME.prm. */
    OutputChoice(const Command &command, const Scene &scene);

    const std::string &
    directory() const
    {
      return path;
    }

    /** Finds without creating anything what would hinder a run: something on
     * the way that is no directory, or that forbids to write. What else a
     * file system refuses only prepare() finds. @throw FileError */
    void
    require_usable() const;

    /** --resume is what is meant where there are checkpoints of a run with the
     * same parameters that has not ended.
     * @throw SceneError if there are any and nothing else was asked for. */
    void
    require_nothing_to_resume(const std::string &used_parameters) const;

    /** Why a run that has ended there is not to be resumed; empty if it
     * has not ended, or if the scene now allows it more periods.
     *
     * @param parameters all of the scene; see scene_as_json().
     * @throw SceneError if the run that has ended had another scene. */
    std::string
    why_finished(const Scene &scene, const Summary &parameters) const;

    /** Makes the directory that of a run that has not ended, which goes on
     * there, and of no other as long as the lock exists. @throw FileError */
    std::unique_ptr<DirectoryLock>
    resume() const;

    /** Creates the directory where needed, clears the results of an earlier
     * run away, and keeps others out as long as the lock exists.
     *
     * @param kept the folder where those results are, if they are kept.
     * @throw FileError */
    std::unique_ptr<DirectoryLock>
    prepare(std::string &kept) const;

  private:
    std::string
    why_finished(const Summary &summary,
                 const Scene   &scene,
                 const Summary &parameters) const;

    bool        from_command_line, may_replace;
    std::string path;
  };
} // namespace Crevasse

#endif
