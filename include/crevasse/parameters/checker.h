// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_checker_h
#define crevasse_parameters_checker_h

#include <crevasse/base/parsed.h>
#include <crevasse/base/problems.h>

#include <functional>
#include <string>

namespace Crevasse
{
  /** Adds problems about the parameters of one section. */
  class Checker
  {
  public:
    /** Both arguments must outlive this object. */
    Checker(const char *section, Problems &problems);

    void
    demand(const bool         fulfilled,
           const char        *name,
           const std::string &value,
           const std::string &allowed) const;

    /** Neither NaN nor infinity fulfil anything. */
    void
    demand(const bool         fulfilled,
           const char        *name,
           const double       value,
           const std::string &allowed) const;

    /** A quantity with a unit. */
    void
    demand_positive(const char *name, const double value) const;

    template <typename Value>
    void
    demand_valid(const char *name, const Parsed<Value> &parameter) const
    {
      demand(parameter.is_valid(), name, parameter.text(), parameter.error());
    }

    /** A value that can be read.
     *
     * @param read throws a SceneError that says what is expected. */
    void
    demand_readable(const char                  *name,
                    const std::string           &value,
                    const std::function<void()> &read) const;

    /** A file that is there and not empty. */
    void
    demand_file(const char *name, const std::string &file_name) const;

  private:
    const char *section;
    Problems   &problems;
  };
} // namespace Crevasse

#endif
