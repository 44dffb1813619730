// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/study/stress_reader.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace Crevasse
{
  namespace
  {
    void
    read(std::ifstream &file, std::vector<double> &values)
    {
      file.read(reinterpret_cast<char *>(values.data()),
                values.size() * sizeof(double));
    }
  } // namespace



  std::uint64_t
  StressRecordHeader::n_bytes() const
  {
    return sizeof(StressRecordHeader) +
           sizeof(double) * (n_samples + dimension * n_points +
                             n_samples * n_points * n_components);
  }



  StressReader::StressReader(const std::string &file_name)
  {
    std::ifstream file(file_name, std::ios::binary);
    file.read(reinterpret_cast<char *>(&header), sizeof(header));
    std::error_code error;
    // The size first: a damaged header must not ask for all memory.
    if (!file || header.mark != StressRecordHeader::our_mark ||
        std::filesystem::file_size(file_name, error) != header.n_bytes() ||
        error)
      throw FileError(file_name + ": is not there, or is damaged.");

    instants.resize(header.n_samples);
    coordinates.resize(header.dimension * header.n_points);
    read(file, instants);
    read(file, coordinates);
    for (std::uint64_t i = 0; i < header.n_samples; ++i)
      {
        samples.emplace_back(header.n_points * header.n_components);
        read(file, samples.back());
      }
    if (!file)
      throw FileError("Cannot read " + file_name + ".");
  }



  bool
  StressReader::has_the_points_of(const StressReader &other) const
  {
    if (coordinates.size() != other.coordinates.size() ||
        header.dimension != other.header.dimension ||
        header.n_components != other.header.n_components)
      return false;
    double size = 0., difference = 0.;
    for (std::size_t i = 0; i < coordinates.size(); ++i)
      {
        size = std::max(size, std::abs(other.coordinates[i]));
        difference =
          std::max(difference, std::abs(coordinates[i] - other.coordinates[i]));
      }
    return difference <= 1e-10 * size;
  }



  MeasuredError
  StressReader::error(const StressReader &reference) const
  {
    if (!has_the_points_of(reference))
      return MeasuredError::none(
        "the run has not the mesh and the quadrature points of the reference");

    const CommonInstants common(instants, reference.instants, header.period);
    if (!common.objection.empty())
      return MeasuredError::none(common.objection, common.pairs.size());
    Extremes extremes;
    for (const auto &[i, j] : common.pairs)
      for (std::size_t k = 0; k < samples[i].size(); ++k)
        extremes.add(samples[i][k], reference.samples[j][k]);
    for (const std::vector<double> &sample : reference.samples)
      for (const double value : sample)
        extremes.add(value, value);
    return MeasuredError::relative(extremes, common.pairs.size());
  }
} // namespace Crevasse
