// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_temperature_temperature_table_h
#define crevasse_temperature_temperature_table_h

#include <crevasse/base/text_file.h>
#include <crevasse/temperature/temperature_file.h>

#include <deal.II/base/function_lib.h>

#include <memory>
#include <sstream>

namespace Crevasse
{
  /**
   * Change of temperature given at the points of a rectangular grid at instants
   * of the period: multilinear in space.
   */
  template <int dim>
  class TemperatureTable : public TemperatureFile<dim>
  {
  public:
    /** Reads a .csv file with the columns t, x, y[, z], theta and a header
     * line; the rows may have any order.
     *
     * @throw SceneError that names the line if the rows do not make a grid or
     * an instant is outside the period. */
    TemperatureTable(const std::string &file_name, const double period)
      : TemperatureFile<dim>(file_name, period)
    {
      std::vector<Row> rows = read_rows(file_name);
      std::sort(rows.begin(), rows.end());
      const std::vector<double> instants = values_of(rows, 0);
      this->set_instants(instants);

      std::array<std::vector<double>, dim> coordinates;
      dealii::TableIndices<dim>            size;
      std::size_t                          n_points = 1;
      for (unsigned int d = 0; d < dim; ++d)
        {
          coordinates[d] = values_of(rows, d + 1);
          if (coordinates[d].size() < 2)
            refuse_temperature(this->file_name,
                               "all points have the same coordinate " +
                                 std::to_string(d + 1) +
                                 "; a grid needs at least two values.");
          size[d] = coordinates[d].size();
          n_points *= coordinates[d].size();
          lower[d] = coordinates[d].front();
          upper[d] = coordinates[d].back();
        }
      if (rows.size() != n_points * instants.size())
        refuse_temperature(this->file_name,
                           "has " + std::to_string(rows.size()) + " rows; " +
                             std::to_string(instants.size()) +
                             " instants of a grid of " +
                             std::to_string(n_points) + " points make " +
                             std::to_string(instants.size() * n_points) + ".");

      const auto twice = std::adjacent_find(
        rows.begin(), rows.end(), [](const Row &a, const Row &b) {
          return std::equal(a.begin(), a.begin() + dim + 1, b.begin());
        });
      if (twice != rows.end())
        refuse_temperature(this->file_name,
                           "has two rows for t = " +
                             Text::from_number((*twice)[0]) +
                             " at the same point.");

      // The rows are sorted with z varying fastest, as in an array of C.
      std::vector<double> values;
      for (const Row &row : rows)
        values.push_back(row.back());
      for (std::size_t k = 0; k < instants.size(); ++k)
        {
          dealii::Table<dim, double> table;
          table.reinit(size);
          table.fill(values.begin() + k * n_points, true);
          grids.push_back(std::make_unique<const Grid>(coordinates, table));
        }
    }

  private:
    /** Row of the table: t, coordinates, θ. */
    using Row = std::array<double, dim + 2>;

    static std::vector<Row>
    read_rows(const std::string &file_name)
    {
      const std::string  header = dim == 2 ? "t,x,y,theta" : "t,x,y,z,theta";
      std::istringstream file(read_text_file(file_name));
      std::string        line;
      std::getline(file, line);
      line.erase(std::remove_if(line.begin(), line.end(), ::isspace),
                 line.end());
      if (line != header)
        refuse_temperature(file_name,
                           "line 1 must be \"" + header + "\", not \"" +
                             Text::shorten(line) + "\".");

      std::vector<Row> rows;
      for (unsigned int number = 2; std::getline(file, line); ++number)
        {
          if (Text::squeeze(line).empty())
            continue;
          const auto values = Text::to_numbers(line);
          if (!values || values->size() != dim + 2)
            refuse_temperature(file_name,
                               "line " + std::to_string(number) + " must be " +
                                 std::to_string(dim + 2) +
                                 " numbers separated by commas, not \"" +
                                 Text::shorten(line) + "\".");
          rows.emplace_back();
          std::copy(values->begin(), values->end(), rows.back().begin());
        }
      if (rows.empty())
        refuse_temperature(file_name, "has no rows below its header.");
      return rows;
    }

    /** Distinct values of a column, in ascending order. */
    static std::vector<double>
    values_of(const std::vector<Row> &rows, const unsigned int column)
    {
      std::set<double> values;
      for (const Row &row : rows)
        values.insert(row[column]);
      return {values.begin(), values.end()};
    }

    using Grid = dealii::Functions::InterpolatedTensorProductGridData<dim>;

    /** Change of temperature. @throw SceneError if a point is off the grid. */
    double
    value_at_instant(const dealii::Point<dim> &point,
                     const std::size_t         instant) const override
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (const double margin = 1e-10 * (upper[d] - lower[d]);
            point[d] < lower[d] - margin || point[d] > upper[d] + margin)
          refuse_temperature(this->file_name,
                             "the body has the point " +
                               Text::from_point(point) +
                               ", which lies outside the grid from " +
                               Text::from_point(lower) + " to " +
                               Text::from_point(upper) + ".");
      return grids[instant]->value(point);
    }

    std::vector<std::unique_ptr<const Grid>> grids; ///< grid of each instant
    dealii::Point<dim>                       lower, upper;
  };
} // namespace Crevasse

#endif
