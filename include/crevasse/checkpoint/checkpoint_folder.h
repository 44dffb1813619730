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
  /** What manifest.json says of a checkpoint. */
  struct CheckpointManifest
  {
    unsigned int number = 0; ///< of the checkpoints of a run
    unsigned int period = 0, step = 0;
    unsigned int ranks = 0; ///< that wrote it
    Summary      scene;     ///< every parameter

    /** The other files of the checkpoint, by name. */
    std::map<std::string, FileCheck> files;
    /** The tables, by name: what was written later is cut off. */
    std::map<std::string, FileCheck> tables;

    std::size_t
    bytes() const;

    /** What other ranks need. */
    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &number &period &step &ranks;
    }
  };

  /**
   * The folder checkpoint/ of an output directory. A checkpoint is a folder in
   * it, named by its number: NUMBER.new while it is written, then renamed, so
   * that it is there as a whole or not at all. The last two are kept. All
   * functions are those of the first rank only, except the names.
   */
  class CheckpointFolder
  {
  public:
    /** @param directory The output directory of the run. */
    explicit CheckpointFolder(const std::string &directory);

    /** Of the folder of a checkpoint. */
    std::string
    name(const unsigned int number) const
    {
      return path + '/' + std::to_string(number);
    }

    /** The same while it is written. */
    std::string
    new_name(const unsigned int number) const
    {
      return name(number) + ".new";
    }

    /** Makes the folder of a new checkpoint, and returns its number.
     * @throw FileError, also if there is no room for so many bytes. */
    unsigned int
    begin(const std::size_t bytes) const;

    /** Completes the manifest, takes the checkpoint over, and removes those
     * that are not needed any more. All its other files must be there.
     *
     * @param tables of the run, which are written through to the disk.
     * @throw FileError */
    void
    finish(CheckpointManifest             &manifest,
           const std::vector<std::string> &tables) const;

    /** Removes what there is of a checkpoint that was begun, but not finished:
     * what cannot be used should not fill the disk. */
    void
    abandon(const unsigned int number) const;

    /** The newest checkpoint that is in order. Nothing is changed.
     *
     * @param[out] warnings about those that are damaged.
     * @throw FileError if another version of the program wrote it, or if a file
     * that is there cannot be opened. */
    std::optional<CheckpointManifest>
    newest(std::vector<std::string> &warnings) const;

    /** Whether there is a checkpoint, in order or not. */
    bool
    has_any() const
    {
      return !numbers().empty();
    }

    /** Whether the run can go on in its tables. Nothing is changed.
     * @throw FileError if one does not begin with what it was when the
     * checkpoint was written, or cannot be written to. */
    void
    require_tables(const CheckpointManifest &manifest) const;

    /** Cuts the tables to what they had. Renames checkpoints that are newer,
     * which are damaged, to NUMBER.damaged, so that the run can use their
     * numbers. @throw FileError */
    void
    go_back_to(const CheckpointManifest &manifest) const;

  private:
    std::vector<unsigned int>
    numbers() const;

    CheckpointManifest
    read(const unsigned int number) const;

    const std::string directory; ///< of the run
    const std::string path;
  };
} // namespace Crevasse

#endif
