// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_temperature_temperature_h
#define crevasse_temperature_temperature_h

#include <crevasse/base/expression.h>

#include <memory>
#include <optional>

namespace Crevasse
{
  template <int dim>
  class TemperatureSeries;

  /** Temperature θ(x,t), or its change if the reference is 0, given by a
   * formula or by a file of fields that another program computed (.h5). */
  template <int dim>
  class Temperature
  {
  public:
    /** @param formula Empty if a file gives the temperature.
     * @param reference Temperature without thermal strain.
     * @throw SceneError if the file cannot be used, FileError if it cannot be
     * read. */
    Temperature(const std::optional<Expression> &formula,
                const std::string               &file_name,
                const double                     period,
                const double                     reference = 0.);

    /** Temperature without thermal strain. */
    double reference;

    /** Temperature θ. @throw SceneError if the point is outside the
     * mesh of the file, or if a formula has no finite value. */
    double
    value(const dealii::Point<dim> &point, const double t) const;

    /** Whether neither temperature nor its change ever differs from 0. */
    bool
    is_zero() const
    {
      return formula && formula->is_zero() && reference == 0.;
    }

    bool
    depends_on_space() const
    {
      return !formula || formula->depends_on_space();
    }

    bool
    depends_on_time() const;

    /** Whether [Loads] Temperature names a file. */
    static bool
    is_file(const std::string &source);

  private:
    std::optional<Expression> formula; ///< formula, unless a file is used
    std::shared_ptr<const TemperatureSeries<dim>> file;
  };
} // namespace Crevasse

#endif
