// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_problems_h
#define crevasse_base_problems_h

#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace Crevasse
{
  /** Exception for wrong input: command line, parameter, expression or mesh,
   * found before computing. The program ends with exit status 2. */
  struct SceneError : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  /** Exception for a numerical failure: no convergence, unstable step,
   * unconstrained rigid-body motion. The program ends with exit status 3. */
  struct NumericalError : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  /** Exception for a file that cannot be read or written. The program ends with
   * exit status 4. */
  struct FileError : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  /** Where a parameter was set: in a file, or by a command-line option. */
  struct Origin
  {
    std::string  source;   ///< file, or --set "Section/Name=value"
    unsigned int line = 0; ///< line; 0: none

    /** The origin as text, "scene.prm:12". */
    std::string
    text() const;
  };

  /**
   * Collects everything that is wrong with a scene, so that all of it is
   * reported at once.
   */
  class Problems
  {
  public:
    /** Adds a message that concerns no single parameter. */
    void
    add(const std::string &message, const Origin &origin = {});

    /** Adds a message about a parameter, its value and the allowed values:
     * "[Section] Name = value: allowed", after its origin if known. */
    void
    add(const std::string &section,
        const std::string &name,
        const std::string &value,
        const std::string &allowed);

    /** Adds a message about a parameter whose value was noted by note(). */
    void
    add(const std::string &section,
        const std::string &name,
        const std::string &allowed);

    /** Marks the last added problem as an unreadable file. */
    void
    last_is_unreadable()
    {
      ++n_unreadable;
    }

    /** Notes the value of a parameter and where it was set, for later messages
     * about it. */
    void
    note(const std::string &section,
         const std::string &name,
         const std::string &value,
         const Origin      &origin = {})
    {
      values[{section, name}]  = value;
      origins[{section, name}] = origin;
    }

    bool
    empty() const
    {
      return messages.empty();
    }

    /** Whether a problem of this parameter was reported, so that comparing it
     * with other parameters would only confuse. */
    bool
    concern(const std::string &section, const std::string &name) const
    {
      return concerned.count({section, name}) > 0;
    }

    /** Throws one SceneError with all messages, if any, one a line in the order
     * of the lines in the scene; a FileError if all problems are unreadable
     * files. */
    void
    throw_if_any() const;

  private:
    using Parameter = std::pair<std::string, std::string>;

    std::vector<std::pair<Origin, std::string>> messages;
    std::size_t                      n_unreadable = 0; ///< messages about files
    std::set<Parameter>              concerned;
    std::map<Parameter, Origin>      origins;
    std::map<Parameter, std::string> values;
  };
} // namespace Crevasse

#endif
