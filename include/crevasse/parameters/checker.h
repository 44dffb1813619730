// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_checker_h
#define crevasse_parameters_checker_h

#include <crevasse/base/parsed.h>
#include <crevasse/base/text_file.h>

namespace Crevasse
{
  /** Adds problems about the parameters of one section. */
  class Checker
  {
  public:
    /** Both arguments of the constructor must outlive the Checker. */
    Checker(const char *section, Problems &problems)
      : section(section)
      , problems(problems)
    {
    }

    void
    demand(const bool         fulfilled,
           const char        *name,
           const std::string &allowed) const
    {
      if (!fulfilled)
        problems.add(section, name, allowed);
    }

    template <typename Value>
    void
    demand_valid(const char *name, const Parsed<Value> &parameter) const
    {
      demand(parameter.is_valid(), name, parameter.error());
    }

    /** Adds a problem unless a file can be read. @return whether it can.
     * @param advice what to do if it cannot. */
    bool
    demand_file(const char        *name,
                const std::string &file_name,
                const std::string &advice = "") const
    {
      const std::string why = why_unreadable(file_name);
      if (why.empty())
        return true;
      problems.add(section, name, file_name, why + advice);
      problems.last_is_unreadable();
      return false;
    }

    /** Adds a problem if a value cannot be read.
     *
     * @param read Throws a SceneError that says what is expected. */
    template <typename Read>
    void
    demand_readable(const char *name, const Read &read) const
    {
      try
        {
          read();
        }
      catch (const SceneError &error)
        {
          problems.add(section, name, error.what());
        }
    }

  private:
    const char *section;
    Problems   &problems;
  };
} // namespace Crevasse

#endif
