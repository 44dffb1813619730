// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_temperature_temperature_series_h
#define crevasse_temperature_temperature_series_h

#include <crevasse/temperature/cell_locator.h>
#include <crevasse/temperature/temperature_file.h>

#include <memory>
#include <string>
#include <vector>

namespace Crevasse
{
  /** The files that a temperature is read from: this one and those that it
   * names, as a .pvd or .pvtu does.
   * @throw SceneError if one cannot be read. */
  std::vector<std::string>
  files_of_temperature(const std::string &file_name);

  /**
   * A temperature that another program has computed, on a mesh of its own: one
   * field (.vtu, .pvtu), or a collection of such at some instants of the period
   * (.pvd). In space it is interpolated by linear finite elements.
   */
  template <int dim>
  class TemperatureSeries : public TemperatureFile<dim>
  {
  public:
    /** @throw SceneError that names the file and what it lacks. */
    TemperatureSeries(const std::string &file_name, const double period);

  private:
    struct Snapshot
    {
      /** Shared by all instants with the same mesh. */
      std::shared_ptr<const CellLocator<dim>> locator;
      std::vector<double>                     values;
    };

    void
    add_snapshot(const std::vector<std::string> &parts);

    /** @throw SceneError if the point lies outside of the mesh. */
    double
    value_at_instant(const dealii::Point<dim> &point,
                     const std::size_t         instant) const override;

    std::vector<Snapshot> snapshots; ///< one for each instant
  };
} // namespace Crevasse

#endif
