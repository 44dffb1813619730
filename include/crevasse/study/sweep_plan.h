// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_study_sweep_plan_h
#define crevasse_study_sweep_plan_h

#include <crevasse/app/command_line.h>
#include <crevasse/parameters/assignments.h>

#include <cstddef>
#include <string>
#include <vector>

namespace Crevasse
{
  /** One --vary: parameters that change together, and the values of each. */
  struct SweepAxis
  {
    std::vector<std::string>              parameters; ///< "Section/Name"
    std::vector<std::vector<std::string>> values;     ///< of each parameter

    /** How many values each of them has. */
    std::size_t
    size() const;
  };

  /** One run of a sweep. */
  struct SweepPoint
  {
    std::vector<std::size_t> indices; ///< on each axis
    std::vector<std::string> values;  ///< of each varied parameter
    std::string              folder;  ///< below the sweep's directory
  };

  /** Which runs a sweep consists of: the product of all --vary, the last one
   * changing fastest. */
  class SweepPlan
  {
  public:
    /** @throw SceneError with all that cannot be understood. Whether there are
     * such parameters is not yet looked at. */
    explicit SweepPlan(const SweepRequest &request);

    const std::vector<SweepAxis> &
    axes() const;

    /** "Section/Name" of all axes, one after the other. */
    const std::vector<std::string> &
    parameters() const;

    /** Those of them that change what is computed, and not only how. */
    std::vector<std::string>
    parameters_of_problem() const;

    const std::vector<SweepPoint> &
    points() const;

    /** What a point sets besides the scene and --set. */
    std::vector<Override>
    overrides(const SweepPoint &point) const;

    /** The axis along which orders are observed: that with the most values
     * among those that have a parameter with different positive numbers only;
     * axes().size() if there is none. */
    std::size_t
    main_axis() const;

    /** The numbers of that axis. */
    std::vector<double>
    main_numbers() const;

  private:
    void
    make_points();

    std::vector<SweepAxis>   all_axes;
    std::vector<std::string> names;
    std::vector<SweepPoint>  all_points;
  };
} // namespace Crevasse

#endif
