// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#ifndef crevasse_temperature_temperature_table_h
#define crevasse_temperature_temperature_table_h

#include <crevasse/temperature/temperature_file.h>

#include <deal.II/base/function_lib.h>

#include <memory>
#include <string>
#include <vector>

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
