// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_checkpoint_field_files_h
#define crevasse_checkpoint_field_files_h

#include <crevasse/base/checked_file.h>
#include <crevasse/checkpoint/field_archive.h>

#include <cstdint>
#include <string>
#include <vector>

namespace Crevasse
{
  /** Which cells a file of fields has, in the order of CellwiseFields. */
  struct FieldFile
  {
    std::string name; ///< in the folder
    FileCheck   check;
    std::size_t first_cell, n_cells;

    /** For other ranks. */
    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &name &check &first_cell &n_cells;
    }
  };

  /** Writes fields of this rank's cells to a file: the numbers of points of its
   * cells, then one field after the other. */
  class FieldFileWriter : public FieldStore
  {
  public:
    FieldFileWriter(const std::string                &name,
                    const std::vector<std::uint32_t> &n_points);

    void
    of_cells(const unsigned int n, std::vector<double> &values) override;

    void
    of_points(const unsigned int n, std::vector<double> &values) override;

    /** @throw FileError if anything could not be written. */
    FileCheck
    finish();

  private:
    CheckedFile file;
    std::string fault; ///< thrown by finish(), where all ranks learn of it
  };

  /** Reads fields of this rank's cells from the files of whichever ranks had
   * them. */
  class FieldFileReader : public FieldStore
  {
  public:
    /** @throw FileError if there are not as many cells and points. */
    FieldFileReader(const std::string                &folder,
                    const std::vector<FieldFile>     &files,
                    const std::size_t                 first_cell,
                    const std::vector<std::uint32_t> &n_points);

    void
    of_cells(const unsigned int n, std::vector<double> &values) override;

    void
    of_points(const unsigned int n, std::vector<double> &values) override;

  private:
    /** What is wanted of one file, in cells or in points of it. */
    struct Range
    {
      std::size_t begin, end, total;
    };

    struct Source
    {
      std::vector<char> content;
      Range             cells, points;
      std::size_t       position; ///< of the next field, in bytes
    };

    void
    read(Range Source::      *range,
         const unsigned int   n,
         std::vector<double> &values);

    std::vector<Source> sources;
  };
} // namespace Crevasse

#endif
