// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_temperature_temperature_h
#define crevasse_temperature_temperature_h

#include <crevasse/base/expression.h>

#include <deal.II/base/point.h>

#include <memory>
#include <string>

namespace Crevasse
{
  template <int dim>
  class TemperatureFile;

  /** The change of temperature θ(x,t): a formula, or a file: a table
   * (.csv), or fields that another program computed (.h5). */
  template <int dim>
  class Temperature
  {
  public:
    /** @param source [Loads] Temperature.
     * @throw SceneError if the formula or the file cannot be used, FileError
     * if there is no file to read. */
    Temperature(const std::string &source, const double period);
    Temperature(Temperature &&) noexcept;
    ~Temperature();

    /** @throw SceneError if the point is outside of what the file covers, or if
     * a formula has no finite value. */
    double
    value(const dealii::Point<dim> &point, const double t) const;

    bool
    is_zero() const;
    bool
    depends_on_time() const;
    bool
    depends_on_space() const;

    /** Whether [Loads] Temperature names a file. */
    static bool
    is_file(const std::string &source);

  private:
    std::unique_ptr<const Expression>           formula; ///< or
    std::unique_ptr<const TemperatureFile<dim>> file;
  };
} // namespace Crevasse

#endif
