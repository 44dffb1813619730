// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_temperature_temperature_series_h
#define crevasse_temperature_temperature_series_h

#include <crevasse/temperature/simplex_locator.h>
#include <crevasse/temperature/temperature_file.h>

#include <memory>

namespace Crevasse
{
  /**
   * A temperature that another program has computed, on triangles (tetrahedra),
   * as `crevasse temperature` writes it. The HDF5 file has the datasets
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
  class TemperatureSeries : public TemperatureFile<dim>
  {
  public:
    /** @throw SceneError that names the file and what is wrong with it. */
    TemperatureSeries(const std::string &file_name, const double period);

  private:
    struct Snapshot
    {
      /** Shared by all instants with the same mesh. */
      std::shared_ptr<const SimplexLocator<dim>> locator;
      std::vector<double>                        values;
    };

    /** @throw SceneError if the point lies outside of the mesh. */
    double
    value_at_instant(const dealii::Point<dim> &point,
                     const std::size_t         instant) const override;

    std::vector<Snapshot> snapshots; ///< one for each instant
  };
} // namespace Crevasse

#endif
