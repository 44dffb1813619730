// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/checkpoint/field_files.h>

#include <algorithm>
#include <cstring>
#include <numeric>

namespace Crevasse
{
  FieldFileWriter::FieldFileWriter(const std::string                &name,
                                   const std::vector<std::uint32_t> &n_points)
    : file(name)
  {
    file.write(n_points.data(), n_points.size() * sizeof(std::uint32_t));
  }



  void
  FieldFileWriter::of_cells(const unsigned int, std::vector<double> &values)
  {
    try
      {
        if (fault.empty())
          file.write(values.data(), values.size() * sizeof(double));
      }
    catch (const FileError &error)
      {
        fault = error.what();
      }
  }



  void
  FieldFileWriter::of_points(const unsigned int n, std::vector<double> &values)
  {
    of_cells(n, values);
  }



  FileCheck
  FieldFileWriter::finish()
  {
    if (!fault.empty())
      throw FileError(fault);
    return file.finish();
  }



  FieldFileReader::FieldFileReader(const std::string                &folder,
                                   const std::vector<FieldFile>     &files,
                                   const std::size_t                 first_cell,
                                   const std::vector<std::uint32_t> &n_points)
  {
    const std::size_t          end_cell = first_cell + n_points.size();
    std::vector<std::uint32_t> found;
    for (const FieldFile &file : files)
      {
        const std::size_t begin = std::max(first_cell, file.first_cell);
        const std::size_t end =
          std::min(end_cell, file.first_cell + file.n_cells);
        if (begin >= end)
          continue;
        std::string fault;
        Source      source;
        source.content =
          read_checked(folder + '/' + file.name, file.check, fault);
        if (!fault.empty())
          throw FileError(fault + ", though it was in order a moment ago.");
        std::vector<std::uint32_t> points(file.n_cells);
        source.position = points.size() * sizeof(std::uint32_t);
        std::memcpy(points.data(), source.content.data(), source.position);
        const auto at = [&](const std::size_t cell) {
          return points.begin() + (cell - file.first_cell);
        };
        found.insert(found.end(), at(begin), at(end));
        const auto sum = [&](const std::size_t cell) {
          return std::accumulate(points.begin(), at(cell), std::size_t(0));
        };
        source.cells  = {begin - file.first_cell,
                         end - file.first_cell,
                         file.n_cells};
        source.points = {sum(begin),
                         sum(end),
                         sum(file.first_cell + file.n_cells)};
        sources.push_back(std::move(source));
      }
    if (found != n_points)
      throw FileError(folder + " does not fit: it has other cells.");
  }



  void
  FieldFileReader::read(Range Source::      *range,
                        const unsigned int   n,
                        std::vector<double> &values)
  {
    values.clear();
    for (Source &source : sources)
      {
        const Range      &wanted = source.*range;
        const std::size_t bytes  = wanted.total * n * sizeof(double);
        if (source.content.size() - source.position < bytes)
          throw FileError(
            "The checkpoint ends where a field is expected: it "
            "was written by another program.");
        const std::size_t old_size = values.size();
        values.resize(old_size + (wanted.end - wanted.begin) * n);
        std::memcpy(values.data() + old_size,
                    source.content.data() + source.position +
                      wanted.begin * n * sizeof(double),
                    (values.size() - old_size) * sizeof(double));
        source.position += bytes;
      }
  }



  void
  FieldFileReader::of_cells(const unsigned int n, std::vector<double> &values)
  {
    read(&Source::cells, n, values);
  }



  void
  FieldFileReader::of_points(const unsigned int n, std::vector<double> &values)
  {
    read(&Source::points, n, values);
  }
} // namespace Crevasse
