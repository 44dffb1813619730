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
  /** Something the user gave is wrong: command line, parameter, expression or
   * mesh, found before computing. The program ends with exit status 2. */
  struct SceneError : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  /** A numerical failure: no convergence, unstable step, rigid-body motion left
   * free. The program ends with exit status 3. */
  struct NumericalError : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  /** A file cannot be read or written. The program ends with exit status 4. */
  struct FileError : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  /** Where something was set: in a file, or by an option of the command line.
   */
  struct Origin
  {
    std::string  source;   ///< "scene.prm", "--set \"Section/Name=value\""
    unsigned int line = 0; ///< 0: none

    /** "scene.prm:12" */
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
    /** A free-standing message. */
    void
    add(const std::string &message, const Origin &origin = {});

    /** A parameter with its value and what would be allowed: "[Section] Name =
     * value: allowed", after the place where it was set, if that is known. */
    void
    add(const std::string &section,
        const std::string &name,
        const std::string &value,
        const std::string &allowed);

    /** The same with the value that was noted. */
    void
    add(const std::string &section,
        const std::string &name,
        const std::string &allowed);

    /** The problem that was added last is a file that cannot be read. */
    void
    last_is_unreadable()
    {
      ++n_unreadable;
    }

    /** Remembers the value of a parameter and where it was set, for what is
     * added about it from now on. */
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

    /** Whether something was reported about this parameter, so that a
     * comparison with others would only confuse. */
    bool
    concern(const std::string &section, const std::string &name) const
    {
      return concerned.count({section, name}) > 0;
    }

    /** Throws one SceneError with all messages, one a line in the order of the
     * lines that they are about, if there are any; a FileError if there is
     * nothing to mend but files that cannot be read. */
    void
    throw_if_any() const;

  private:
    using Parameter = std::pair<std::string, std::string>;

    std::vector<std::pair<Origin, std::string>> messages;
    std::size_t                                 n_unreadable = 0; ///< of these
    std::set<Parameter>                         concerned;
    std::map<Parameter, Origin>                 origins;
    std::map<Parameter, std::string>            values;
  };
} // namespace Crevasse

#endif
