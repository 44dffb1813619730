// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_temperature_temperature_file_h
#define crevasse_temperature_temperature_file_h

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /** @throw SceneError that names the file. */
  [[noreturn]] void
  refuse_temperature(const std::string &file_name, const std::string &reason);

  /**
   * A temperature that a file gives at some instants of the period: linear in
   * time between these, and periodic. How it is interpolated in space is left
   * to the kinds of file.
   */
  template <int dim>
  class TemperatureFile
  {
  public:
    TemperatureFile(const std::string &file_name, const double period)
      : file_name(file_name)
      , period(period)
    {
    }

    virtual ~TemperatureFile() = default;

    /** @throw SceneError if the file knows nothing about the point. */
    double
    value(const dealii::Point<dim> &point, const double t) const;

    std::size_t
    n_instants() const
    {
      return instants.size();
    }

  protected:
    /** To be called first of all by whoever reads the file, with the instants
     * in ascending order. @throw SceneError if one is outside of the period. */
    void
    set_instants(std::vector<double> instants);

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
