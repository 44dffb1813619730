// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_checkpoint_checkpoint_folder_h
#define crevasse_checkpoint_checkpoint_folder_h

#include <crevasse/base/summary.h>
#include <crevasse/checkpoint/field_files.h>

#include <optional>
#include <string>
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
    /** The length of each table, by name: what was written later is cut off. */
    std::map<std::string, std::size_t> tables;

    FileCheck              common;
    std::vector<FieldFile> fields; ///< of each rank

    /** For other ranks. */
    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &number &period &step &ranks &common &fields;
    }
  };

  /**
   * The folder checkpoint/ of an output directory. A checkpoint is a folder in
   * it, named by its number: NUMBER.new while it is written, then renamed, so
   * that it is there as a whole or not at all. The last two are kept. Files of
   * the first rank only, but for those of fields.
   */
  class CheckpointFolder
  {
  public:
    /** @param directory The output directory of the run. */
    explicit CheckpointFolder(const std::string &directory);

    /** Makes the folder of a new checkpoint, and returns its number.
     * @throw FileError */
    unsigned int
    begin() const;

    /** Of a file of a checkpoint that is being written. */
    std::string
    new_file(const unsigned int number, const std::string &name) const;

    /** Writes the manifest, takes the checkpoint over, and removes those that
     * are not needed any more. All its other files must be on the disk.
     * @throw FileError */
    void
    finish(const CheckpointManifest &manifest) const;

    /** Removes what there is of a checkpoint that was begun, but not finished:
     * what cannot be used should not fill the disk. */
    void
    abandon(const unsigned int number) const;

    /** The newest checkpoint that is in order. Nothing is changed.
     *
     * @param[out] warnings about those that are damaged.
     * @throw FileError if another version of the program wrote it. */
    std::optional<CheckpointManifest>
    newest(std::vector<std::string> &warnings) const;

    /** Whether there is a checkpoint, in order or not. */
    bool
    has_any() const;

    /** Renames those that are newer, which are damaged, to NUMBER.damaged, so
     * that a run that goes on before them can use their numbers. */
    void
    set_aside_after(const unsigned int number) const;

    /** Of a file of a checkpoint. */
    std::string
    file(const unsigned int number, const std::string &name) const;

    std::string
    name(const unsigned int number) const;

    static constexpr const char *common_file = "common.bin";

    /** The sizes of these tables of the run, which are written through to the
     * disk; those that somebody has removed are left out.
     * @throw FileError */
    std::map<std::string, std::size_t>
    measure_tables(const std::vector<std::string> &names) const;

    /** Whether the run can go on in its files. Nothing is changed.
     * @throw FileError if one has less than when the checkpoint was written, or
     * cannot be written to. */
    void
    require_tables(const CheckpointManifest &manifest) const;

    /** Cuts the tables to what they had. @throw FileError */
    void
    cut_tables(const CheckpointManifest &manifest) const;

  private:
    std::vector<unsigned int>
    numbers() const;

    /** @throw FileError if it is not in order, OtherFormat if it cannot be
     * told. */
    CheckpointManifest
    read(const unsigned int number) const;

    const std::string directory; ///< of the run
    const std::string path;
  };
} // namespace Crevasse

#endif
