// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_study_stress_reader_h
#define crevasse_study_stress_reader_h

#include <crevasse/study/measured_error.h>

#include <cstdint>
#include <string>
#include <vector>

namespace Crevasse
{
  /** What the file of a StressReader begins with. */
  struct StressRecordHeader
  {
    static constexpr std::uint64_t our_mark = 0x3153534552545343; // "CSTRESS1"

    std::uint64_t mark         = our_mark;
    std::uint64_t dimension    = 0;
    std::uint64_t n_points     = 0;
    std::uint64_t n_components = 0;
    std::uint64_t n_samples    = 0;
    double        period       = 0.;

    /** Of the whole file. */
    std::uint64_t
    n_bytes() const;
  };

  /**
   * The stress at all quadrature points at the instants of the last period of
   * a run, as StressWriter has written it: the header, the instants within
   * the period, the coordinates of the points, and for each instant the stress
   * of all points.
   */
  class StressReader
  {
  public:
    /** @throw FileError if the file cannot be read, or has another size than
     * its header says. */
    explicit StressReader(const std::string &file_name);

    /** The error beside a reference on the same points: the largest difference
     * of a component over the largest component of the reference, at the
     * common instants within the last period of each. */
    MeasuredError
    error(const StressReader &reference) const;

  private:
    bool
    has_the_points_of(const StressReader &other) const;

    StressRecordHeader               header;
    std::vector<double>              instants;
    std::vector<double>              coordinates;
    std::vector<std::vector<double>> samples;
  };
} // namespace Crevasse

#endif
