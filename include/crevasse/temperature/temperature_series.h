// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_temperature_temperature_series_h
#define crevasse_temperature_temperature_series_h

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/temperature/simplex_locator.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <hdf5.h>
#include <memory>

namespace Crevasse
{
  /** Reports a wrong file of temperature. @throw SceneError */
  [[noreturn]] inline void
  refuse_temperature(const std::string &file_name, const std::string &reason)
  {
    throw SceneError("[Loads] Temperature = " + file_name + ": " + reason);
  }

  /** Reads arrays of numbers from an HDF5 file. deal.II's classes check nothing
   * in release mode. */
  class NumberFile
  {
  public:
    NumberFile(const std::string &name)
      : file_name(name)
    {
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); // errors are reported here
      file = H5Fopen(name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
      if (file < 0)
        throw_error(
          "is not an HDF5 file, or is damaged; \"crevasse temperature\" "
          "converts fields of other programs.");
    }

    NumberFile(const NumberFile &) = delete;

    ~NumberFile()
    {
      H5Fclose(file);
    }

    /** Reads all rows of a dataset with @p n_columns, row by row. */
    std::vector<double>
    read(const std::string &name, const hsize_t n_columns) const
    {
      const hid_t set = H5Lexists(file, name.c_str(), H5P_DEFAULT) > 0
                          ? H5Dopen2(file, name.c_str(), H5P_DEFAULT)
                          : -1;
      if (set < 0)
        throw_error("has no dataset \"" + name + "\".");
      const hid_t          space    = H5Dget_space(set);
      std::vector<hsize_t> extents  = {0, 1};
      const int            n_dims   = H5Sget_simple_extent_ndims(space);
      const bool           is_table = n_dims == (n_columns > 1 ? 2 : 1);
      if (is_table)
        H5Sget_simple_extent_dims(space, extents.data(), nullptr);
      H5Sclose(space);
      std::vector<double> numbers;
      if (is_table && extents[1] == n_columns)
        numbers.resize(extents[0] * n_columns);
      const bool is_read = !numbers.empty() && H5Dread(set,
                                                       H5T_NATIVE_DOUBLE,
                                                       H5S_ALL,
                                                       H5S_ALL,
                                                       H5P_DEFAULT,
                                                       numbers.data()) >= 0;
      H5Dclose(set);
      if (!is_read)
        throw_error("its dataset \"" + name + "\" must be rows of " +
                    std::to_string(n_columns) + " numbers" +
                    (name.rfind("points", 0) == 0
                       ? ", for Dimension = " + std::to_string(n_columns)
                       : "") +
                    ".");
      if (!std::all_of(numbers.begin(), numbers.end(), [](const double x) {
            return std::isfinite(x);
          }))
        throw_error("its dataset \"" + name +
                    "\" has a number that is not finite.");
      return numbers;
    }

    [[noreturn]] void
    throw_error(const std::string &reason) const
    {
      refuse_temperature(file_name, reason);
    }

  private:
    const std::string file_name;
    hid_t             file;
  };

  /**
   * Change of temperature that another program computed on triangles
   * (tetrahedra) at instants of the period, as `crevasse temperature` writes it
   * to an HDF5 file; linear in time between instants, and periodic:
   *
   * | name           | shape            |                                   |
   * |----------------|------------------|-----------------------------------|
   * | times          | instants         | ascending                         |
   * | mesh_of        | instants         | number of the mesh of each        |
   * | points_[mesh]  | points × dim     | coordinates                       |
   * | cells_[mesh]   | cells × (dim+1)  | numbers of points, from 0         |
   * | theta_[instant]| points           | change of temperature             |
   */
  template <int dim>
  class TemperatureSeries
  {
  public:
    /** Reads the file. @throw SceneError with the file and its fault. */
    TemperatureSeries(const std::string &file_name, const double period)
      : file_name(file_name)
      , period(period)
    {
      const NumberFile file(file_name);
      instants = file.read("times", 1);
      if (std::adjacent_find(instants.begin(),
                             instants.end(),
                             std::greater_equal<>()) != instants.end())
        file.throw_error("its dataset \"times\" must be ascending.");
      if (instants.front() < 0. || instants.back() > period)
        file.throw_error(
          "its instants go from " + Text::from_number(instants.front()) +
          " to " + Text::from_number(instants.back()) +
          "; they must be within the period, from 0 to [Loads] Period = " +
          Text::from_number(period) + ".");

      const auto mesh_of = file.read("mesh_of", 1);
      if (mesh_of.size() != instants.size())
        file.throw_error(
          "its dataset \"mesh_of\" must have as many entries as \"times\".");
      std::map<double, std::shared_ptr<const SimplexLocator<dim>>> meshes;
      for (std::size_t i = 0; i < instants.size(); ++i)
        {
          auto &locator = meshes[mesh_of[i]];
          if (locator == nullptr)
            locator = read_simplices(file, Text::from_number(mesh_of[i]));
          const std::string name = "theta_" + std::to_string(i);
          snapshots.push_back({locator, file.read(name, 1)});
          if (const std::size_t n = snapshots.back().values.size();
              n != locator->n_vertices())
            file.throw_error("its dataset \"" + name + "\" has " +
                             std::to_string(n) + " rows for " +
                             std::to_string(locator->n_vertices()) +
                             " points.");
        }
    }


    /** Change of temperature. @throw SceneError outside grid or mesh. */
    double
    value(const dealii::Point<dim> &point, const double t) const
    {
      // The first instant of the next period follows the last instant.
      const std::size_t next =
        std::upper_bound(instants.begin(), instants.end(), t) -
        instants.begin();
      const std::size_t n      = instants.size();
      const std::size_t before = (next + n - 1) % n, after = next % n;
      const double      begin  = instants[before] - (next == 0 ? period : 0.);
      const double      end    = instants[after] + (next == n ? period : 0.);
      const double      weight = end > begin ? (t - begin) / (end - begin) : 0.;
      if (before == after || weight == 0.)
        return value_at_instant(point, before);
      return (1. - weight) * value_at_instant(point, before) +
             weight * value_at_instant(point, after);
    }

    std::size_t
    n_instants() const
    {
      return instants.size();
    }

  private:
    struct Snapshot
    {
      /** Locator of the mesh, shared by all instants with this mesh. */
      std::shared_ptr<const SimplexLocator<dim>> locator;
      std::vector<double>                        values;
    };

    static std::shared_ptr<const SimplexLocator<dim>>
    read_simplices(const NumberFile &file, const std::string &number)
    {
      const auto coordinates = file.read("points_" + number, dim);
      const auto corners     = file.read("cells_" + number, dim + 1);

      std::vector<dealii::Point<dim>> points(coordinates.size() / dim);
      for (std::size_t i = 0; i < coordinates.size(); ++i)
        points[i / dim][i % dim] = coordinates[i];
      using Simplex = typename SimplexLocator<dim>::Simplex;
      std::vector<Simplex> cells(corners.size() / (dim + 1));
      for (std::size_t i = 0; i < corners.size(); ++i)
        {
          if (!(corners[i] >= 0. && corners[i] < points.size()))
            file.throw_error("its dataset \"cells_" + number +
                             "\" has the entry " +
                             Text::from_number(corners[i]) +
                             "; allowed are integers from 0 to " +
                             std::to_string(points.size() - 1) + ".");
          cells[i / (dim + 1)][i % (dim + 1)] = corners[i];
        }
      return std::make_shared<const SimplexLocator<dim>>(std::move(points),
                                                         std::move(cells));
    }

    /** Change of temperature. @throw SceneError if a point is off the mesh. */
    double
    value_at_instant(const dealii::Point<dim> &point,
                     const std::size_t         instant) const
    {
      const Snapshot &snapshot = snapshots[instant];
      double          value    = 0.;
      if (!snapshot.locator->interpolate(point, snapshot.values, value))
        refuse_temperature(
          file_name,
          "the body has the point " + Text::from_point(point) +
            ", which lies outside the mesh" +
            (snapshots.size() == 1
               ? ""
               : " of instant " + std::to_string(instant + 1) + " of " +
                   std::to_string(snapshots.size())) +
            ", farther than " +
            Text::from_number(SimplexLocator<dim>::largest_gap) +
            " of the size of the cells there; the mesh must cover the "
            "body, in the same unit of length.");
      return value;
    }

    const std::string     file_name;
    const double          period;
    std::vector<double>   instants;
    std::vector<Snapshot> snapshots; ///< fields for each instant
  };
} // namespace Crevasse

#endif
