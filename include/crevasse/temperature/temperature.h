// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_temperature_temperature_h
#define crevasse_temperature_temperature_h

#include <crevasse/base/expression.h>
#include <crevasse/temperature/temperature_file.h>

#include <optional>

namespace Crevasse
{
  /** Change of temperature θ(x,t), given by a formula or by a file: a table
   * (.csv), or fields that another program computed (.h5). */
  template <int dim>
  class Temperature
  {
  public:
    /** @param formula Empty if a file gives the temperature.
     * @throw SceneError if the file cannot be used, FileError if it cannot be
     * read. */
    Temperature(const std::optional<Expression> &formula,
                const std::string               &file_name,
                const double                     period);

    /** Change of temperature. @throw SceneError if the point is outside the
     * grid or mesh of the file, or if a formula has no finite value. */
    double
    value(const dealii::Point<dim> &point, const double t) const
    {
      return file != nullptr ? file->value(point, t) : formula->value(point, t);
    }

    bool
    is_zero() const
    {
      return formula && formula->is_zero();
    }

    bool
    depends_on_space() const
    {
      return !formula || formula->depends_on_space();
    }

    bool
    depends_on_time() const
    {
      return file != nullptr ? file->n_instants() > 1
                             : formula->depends_on_time();
    }

    /** Whether [Loads] Temperature names a file. */
    static bool
    is_file(const std::string &source);

  private:
    std::optional<Expression> formula; ///< formula, unless a file is used
    std::unique_ptr<const TemperatureFile<dim>> file;
  };
} // namespace Crevasse

#endif
