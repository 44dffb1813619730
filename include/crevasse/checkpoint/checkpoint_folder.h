// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_checkpoint_checkpoint_folder_h
#define crevasse_checkpoint_checkpoint_folder_h

#include <crevasse/base/checked_file.h>
#include <crevasse/base/summary.h>

#include <map>
#include <optional>
#include <vector>

namespace Crevasse
{
  /** Contents of manifest.json, the description of a checkpoint. */
  struct CheckpointManifest
  {
    unsigned int number = 0; ///< checkpoint number within the run
    unsigned int period = 0, step = 0;
    unsigned int ranks = 0; ///< number of ranks that wrote it
    Summary      scene;     ///< all parameters of the scene

    /** Size and checksum of each other file of the checkpoint. */
    std::map<std::string, FileCheck> files;
    /** Size and checksum of each table when the checkpoint is written. */
    std::map<std::string, FileCheck> tables;

    std::size_t
    bytes() const;

    /** Serialises the members that every rank needs. */
    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &number &period &step &ranks;
    }
  };

  /**
   * The folder checkpoint/ of an output directory. Each checkpoint is a
   * subfolder named by its number: NUMBER.new while it is written, then
   * renamed, so that it is complete or absent. The last two are kept. Only the
   * first rank may call functions other than name().
   */
  class CheckpointFolder
  {
  public:
    /** @param directory The output directory of the run. */
    explicit CheckpointFolder(const std::string &directory);

    /** Path of a checkpoint's folder. */
    std::string
    name(const unsigned int number) const
    {
      return path + '/' + std::to_string(number);
    }

    /** Path of a checkpoint's folder while the checkpoint is being written. */
    std::string
    new_name(const unsigned int number) const
    {
      return name(number) + ".new";
    }

    /** Creates the folder of a new checkpoint, and returns its number.
     * @throw FileError, also if the disk lacks room for so many bytes. */
    unsigned int
    begin(const std::size_t bytes) const;

    /** Writes the manifest, renames the folder to its final name, and removes
     * all checkpoints but the last two. The other files must exist.
     *
     * @param tables the tables of the run, which are flushed to the disk.
     * @throw FileError */
    void
    finish(CheckpointManifest             &manifest,
           const std::vector<std::string> &tables) const;

    /** Removes an unfinished checkpoint, so that unusable files do not fill the
     * disk. */
    void
    abandon(const unsigned int number) const;

    /** Finds the newest undamaged checkpoint, without changing any file.
     *
     * @param[out] warnings one for each damaged checkpoint.
     * @throw FileError if another version of the program wrote the checkpoint,
     * or if one of its files cannot be opened. */
    std::optional<CheckpointManifest>
    newest(std::vector<std::string> &warnings) const;

    /** Whether the folder has any checkpoint, damaged or not. */
    bool
    has_any() const
    {
      return !numbers().empty();
    }

    /** Checks that a resumed run can append to its tables; changes no file.
     * @throw FileError if a table does not begin with what it held when the
     * checkpoint was written, or cannot be written to. */
    void
    require_tables(const CheckpointManifest &manifest) const;

    /** Truncates the tables to their sizes at this checkpoint. Renames newer
     * checkpoints, which are damaged, to NUMBER.damaged, so that the run can
     * use their numbers. @throw FileError */
    void
    go_back_to(const CheckpointManifest &manifest) const;

  private:
    std::vector<unsigned int>
    numbers() const;

    CheckpointManifest
    read(const unsigned int number) const;

    const std::string directory; ///< output directory of the run
    const std::string path;
  };
} // namespace Crevasse

#endif
