// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_temperature_temperature_table_h
#define crevasse_temperature_temperature_table_h

#include <crevasse/temperature/temperature_file.h>

#include <deal.II/base/function_lib.h>

#include <memory>

namespace Crevasse
{
  /**
   * A temperature that is known at the points of a rectangular grid at some
   * instants of the period: multilinear in space.
   */
  template <int dim>
  class TemperatureTable : public TemperatureFile<dim>
  {
  public:
    /** Reads a .csv file with the columns t, x, y[, z], theta and a header
     * line; the order of the rows does not matter.
     *
     * @throw SceneError that names the line if the rows do not make a grid or
     * an instant is outside of the period. */
    TemperatureTable(const std::string &file_name, const double period);

  private:
    using Grid = dealii::Functions::InterpolatedTensorProductGridData<dim>;

    /** @throw SceneError if the point lies outside of the grid. */
    double
    value_at_instant(const dealii::Point<dim> &point,
                     const std::size_t         instant) const override;

    std::vector<std::unique_ptr<const Grid>> grids; ///< one for each instant
    dealii::Point<dim>                       lower, upper;
  };
} // namespace Crevasse

#endif
