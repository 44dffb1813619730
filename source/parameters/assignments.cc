// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/parameters/assignments.h>
#include <crevasse/parameters/catalogue.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <set>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** The part of a path of sections that is not known any more: "Materail"
     * of "Materail/Creep". */
    std::string
    unknown_part(const std::string &path, const Catalogue &catalogue)
    {
      for (std::size_t slash = path.find('/'); slash != std::string::npos;
           slash             = path.find('/', slash + 1))
        if (catalogue.find(path.substr(0, slash)) == nullptr)
          return path.substr(0, slash);
      return path;
    }



    std::string
    describe_unknown_section(const std::string &section,
                             const Catalogue   &catalogue)
    {
      const std::size_t slash     = section.rfind('/');
      const std::string last_name = section.substr(slash + 1);
      std::string       message =
        "unknown section \"" + Text::shorten(section) + "\"";
      if (slash != std::string::npos && catalogue.find(last_name) != nullptr)
        return message +
               "; sections do not nest, so an \"end\" may be missing "
               "before it";
      return message +
             "; sections are: " + Text::join(catalogue.names(), ", ") +
             Text::did_you_mean(section, catalogue.names());
    }



    std::string
    describe_unknown_parameter(const Catalogue::Section &section,
                               const std::string        &name,
                               const Catalogue          &catalogue)
    {
      std::string message =
        "unknown parameter \"" + Text::shorten(name) +
        "\"; allowed here: " + Text::join(section.names(), ", ");
      if (section.name.empty())
        message += ", and the sections " + Text::join(catalogue.names(), ", ");

      const std::string guess = Text::did_you_mean(name, section.names());
      if (!guess.empty())
        return message + guess;
      for (const Catalogue::Section &other : catalogue.sections)
        if (other.find(name) != nullptr)
          return message + "; a parameter of this name is " +
                 (other.name.empty() ? "at the top level"
                                     : "in the section " + other.name);
      return message;
    }



    /** Why a value cannot be written into a scene file and read again, or
     * nothing. */
    std::string
    describe_unwritable(const std::string &value)
    {
      if (!Text::is_utf8(value))
        return "must be text in UTF-8";
      if (std::any_of(value.begin(), value.end(), Text::is_control))
        return "must not contain control characters";
      if (value.find('#') != std::string::npos)
        return "must not contain \"#\", which begins a comment in a scene file";
      if (!value.empty() && value.back() == '\\')
        return "must not end in a backslash, which continues a line in a scene "
               "file";
      return "";
    }



    /** Whether the value has the declared type. */
    bool
    set_value(const Assignment &assignment, ParameterHandler &prm)
    {
      if (!assignment.section.empty())
        prm.enter_subsection(assignment.section);
      bool is_valid = true;
      try
        {
          prm.set(assignment.name, assignment.value);
        }
      catch (const std::exception &)
        {
          is_valid = false;
        }
      if (!assignment.section.empty())
        prm.leave_subsection();
      return is_valid;
    }



    void
    apply_one(const Assignment         &assignment,
              const Catalogue::Section &section,
              const Catalogue          &catalogue,
              ParameterHandler         &prm,
              Problems                 &problems)
    {
      const Catalogue::Parameter *parameter = section.find(assignment.name);
      if (parameter == nullptr)
        {
          const std::string where =
            section.name.empty() ? "" : "[" + section.name + "] ";
          problems.add(
            assignment.place + ": " + where +
            describe_unknown_parameter(section, assignment.name, catalogue));
          return;
        }

      problems.locate(section.name, parameter->name, assignment.place);
      std::string problem = describe_unwritable(assignment.value);
      if (problem.empty() && !set_value(assignment, prm))
        problem = "must be " + parameter->allowed;
      if (!problem.empty())
        problems.add(section.name, parameter->name, assignment.value, problem);
    }
  } // namespace



  void
  read_override(const std::string       &text,
                std::vector<Assignment> &assignments,
                Problems                &problems)
  {
    Assignment assignment;
    assignment.place = "--set \"" + Text::shorten(text) + "\"";

    const std::size_t equals = text.find('=');
    const std::string path   = text.substr(0, equals);
    const std::size_t slash  = path.rfind('/');
    if (slash != std::string::npos)
      assignment.section = Text::squeeze(path.substr(0, slash));
    assignment.name = Text::squeeze(path.substr(slash + 1));

    if (equals == std::string::npos || assignment.name.empty())
      {
        problems.add(assignment.place +
                     ": must have the form \"Section/Name=value\", or "
                     "\"Name=value\" for the top level");
        return;
      }
    assignment.value = Text::squeeze(text.substr(equals + 1));
    assignments.push_back(assignment);
  }



  void
  apply(const std::vector<Assignment> &assignments,
        ParameterHandler              &prm,
        Problems                      &problems)
  {
    const Catalogue       catalogue(prm);
    std::set<std::string> reported;
    for (const Assignment &assignment : assignments)
      {
        const Catalogue::Section *section = catalogue.find(assignment.section);
        if (section == nullptr)
          {
            const std::string unknown =
              unknown_part(assignment.section, catalogue);
            if (reported.insert(unknown).second)
              problems.add(assignment.place + ": " +
                           describe_unknown_section(unknown, catalogue));
          }
        else if (!assignment.name.empty())
          apply_one(assignment, *section, catalogue, prm, problems);
      }
  }
} // namespace Crevasse
