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

#ifndef crevasse_temperature_temperature_file_h
#define crevasse_temperature_temperature_file_h

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /**
   * A temperature that a file gives at some instants of the period: linear in
   * time between these, and periodic. How it is interpolated in space is left
   * to the kinds of file.
   */
  template <int dim>
  class TemperatureFile
  {
  public:
    TemperatureFile(const std::string &file_name, const double period);
    virtual ~TemperatureFile() = default;

    /** @throw SceneError if the file knows nothing about the point. */
    double
    value(const dealii::Point<dim> &point, const double t) const;

    std::size_t
    n_instants() const;

  protected:
    /** To be called first of all by whoever reads the file, with the instants
     * in ascending order. @throw SceneError if one is outside of the period. */
    void
    set_instants(std::vector<double> instants);

    [[noreturn]] void
    refuse(const std::string &reason) const;

    const std::string file_name;

  private:
    virtual double
    value_at_instant(const dealii::Point<dim> &point,
                     const std::size_t         instant) const = 0;

    const double        period;
    std::vector<double> instants;
  };
} // namespace Crevasse

#endif
