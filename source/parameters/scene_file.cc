// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/parameters/mesh_conversion.h>
#include <crevasse/parameters/physical_names.h>
#include <crevasse/parameters/scene_file.h>
#include <crevasse/temperature/temperature.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace Crevasse
{
  using dealii::ParameterHandler;

  namespace
  {
    std::string
    describe_unknown_section(const std::string &section,
                             const Catalogue   &catalogue)
    {
      const std::size_t slash = section.rfind('/');
      const std::string message =
        "unknown section \"" + Text::shorten(section) + "\"";
      if (slash != std::string::npos &&
          catalogue.contains(section.substr(slash + 1)))
        return message +
               "; sections do not nest, so an \"end\" may be missing "
               "before it";
      return message +
             "; sections are: " + Text::join(names_in(catalogue), ", ") +
             Text::did_you_mean(section, names_in(catalogue));
    }



    std::string
    describe_unknown_parameter(const std::string &section,
                               const std::string &name,
                               const Catalogue   &catalogue)
    {
      const auto  names   = names_in(catalogue[section]);
      std::string message = Text::parameter(section, "") +
                            "unknown parameter \"" + Text::shorten(name) +
                            "\"; allowed here: " + Text::join(names, ", ");
      if (section.empty())
        message +=
          ", and the sections " + Text::join(names_in(catalogue), ", ");

      const std::string guess = Text::did_you_mean(name, names);
      if (!guess.empty())
        return message + guess;
      for (const auto &[other, parameters] : catalogue.items())
        if (parameters.contains(name))
          return message + "; a parameter of this name is " +
                 (other.empty() ? "at the top level"
                                : "in the section " + other);
      return message;
    }



    /** Why a value cannot be written to a scene file and read again; empty if
     * it can. */
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



    void
    set(const std::string &section,
        const std::string &name,
        const std::string &value,
        ParameterHandler  &prm)
    {
      if (section.empty())
        return prm.set(name, value);
      prm.enter_subsection(section);
      try
        {
          prm.set(name, value);
        }
      catch (...)
        {
          prm.leave_subsection();
          throw;
        }
      prm.leave_subsection();
    }



    void
    apply(const Assignment &assignment,
          const Catalogue  &catalogue,
          ParameterHandler &prm,
          Problems         &problems)
    {
      const auto &[origin, section, name, value] = assignment;
      if (!catalogue[section].contains(name))
        return problems.add(
          describe_unknown_parameter(section, name, catalogue), origin);

      problems.note(section, name, value, origin);
      std::string problem = describe_unwritable(value);
      if (problem.empty())
        try
          {
            set(section, name, value, prm);
          }
        catch (const std::exception &)
          {
            const std::string one_of  = "one of: ";
            const std::string allowed = catalogue[section][name]["allowed"];
            problem                   = "must be " + allowed;
            if (allowed.rfind(one_of, 0) == 0)
              problem += Text::did_you_mean(
                value, Text::split(allowed.substr(one_of.size()), ','));
          }
      if (!problem.empty())
        problems.add(section, name, problem);
    }



    /** Sets the assigned parameters. Reports unknown parameters and values that
     * are not allowed, and leaves their entries unchanged. */
    void
    apply(const std::vector<Assignment> &assignments,
          const Catalogue               &catalogue,
          ParameterHandler              &prm,
          Problems                      &problems)
    {
      std::set<std::string> reported;
      for (const Assignment &assignment : assignments)
        if (!catalogue.contains(assignment.section))
          {
            const std::string &path  = assignment.section;
            const std::string  first = path.substr(0, path.find('/'));
            const std::string &unknown =
              catalogue.contains(first) ? path : first;
            if (reported.insert(unknown).second)
              problems.add(describe_unknown_section(unknown, catalogue),
                           assignment.origin);
          }
        else if (!assignment.name.empty())
          apply(assignment, catalogue, prm, problems);
    }



    /** Replaces the name of a file next to the scene by its full path, so that
     * it is found from any directory, and from used.prm. */
    void
    resolve_file(const std::string &scene_file_name,
                 const char        *section,
                 const char        *name,
                 const std::string &value,
                 ParameterHandler  &prm)
    {
      set(section, name, find_file(scene_file_name, value), prm);
    }



    /** Finds the converted mesh file, which must exist if one is needed. */
    void
    find_converted_mesh(GeometryParameters &geometry, Problems &problems)
    {
      const std::string name = geometry.shape == Shape::mesh_file
                                 ? Crevasse::converted_mesh(geometry.mesh_file)
                                 : "";
      std::error_code   unknown;
      geometry.converted_mesh_file = name;
      if (!name.empty() && !std::filesystem::exists(name, unknown))
        problems.add(GeometryParameters::section,
                     "Mesh file",
                     "must be converted before mpirun starts: run \"crevasse "
                     "mesh " +
                       geometry.mesh_file + ' ' + name + '"');
    }



    /** Escapes "|", which would end a cell of a Markdown table. */
    std::string
    in_cell(const std::string &text)
    {
      std::string result;
      for (const char character : text)
        result += character == '|' ? "\\|" : std::string(1, character);
      return result;
    }



    void
    print_table(std::ostream      &out,
                const std::string &section,
                const Catalogue   &parameters)
    {
      out << "\n## " << (section.empty() ? "Top level" : section)
          << "\n\n| name | default | meaning | allowed |\n"
          << "|---|---|---|---|\n";
      for (const auto &[name, entry] : parameters.items())
        {
          const std::string value = in_cell(entry["default_value"]);
          out << "| " << in_cell(name) << " | "
              << (value.empty() ? "" : "`" + value + "`") << " | "
              << in_cell(entry["documentation"]) << " | "
              << in_cell(entry["allowed"]) << " |\n";
        }
    }



    void
    print_markdown(std::ostream &out, const ParameterHandler &prm)
    {
      out
        << "# Parameters\n\n"
           "Written by `crevasse --print-parameters markdown`. All "
           "quantities are in the user's own\nconsistent units of length, "
           "stress, time and temperature; values without a unit are pure "
           "numbers,\nchoices or texts. [Scenes](scenes.md) explains "
           "formulas: theta is the temperature\nthat Loads gives, material the "
           "material id of the cell in a mesh file.\n";
      const Catalogue catalogue = make_catalogue(prm);
      for (const auto &[section, parameters] : catalogue.items())
        print_table(out, section, parameters);
    }
  } // namespace



  Scene
  read_scene(const std::string              &file_name,
             const std::vector<std::string> &overrides,
             ParameterHandler               &prm,
             Problems                       &problems)
  {
    Scene scene;
    scene.add_parameters(prm);
    const Catalogue catalogue = make_catalogue(prm);
    for (const auto &[section, parameters] : catalogue.items())
      for (const auto &[name, entry] : parameters.items())
        problems.note(section, name, entry["default_value"]);
    // Formulas call the functions of tables.
    std::vector<Assignment> of_tables, others;
    for (Assignment &each : read_assignments(file_name, overrides, problems))
      (each.section == TableParameters::section ? of_tables : others)
        .push_back(std::move(each));
    apply(of_tables, catalogue, prm, problems);
    for (std::string &name : scene.tables.files)
      name = find_file(file_name, name);
    set(TableParameters::section,
        "Files",
        Text::join(scene.tables.files, ", "),
        prm);
    scene.tables.read(problems);
    apply(others, catalogue, prm, problems);

    resolve_file(file_name,
                 GeometryParameters::section,
                 "Mesh file",
                 scene.geometry.mesh_file,
                 prm);
    if (Temperature<2>::is_file(scene.loads.temperature.text()))
      resolve_file(file_name,
                   LoadParameters::section,
                   "Temperature",
                   scene.loads.temperature.text(),
                   prm);
    if (!scene.crack_tip.growth_table.empty())
      resolve_file(file_name,
                   CrackTipParameters::section,
                   "Growth table",
                   scene.crack_tip.growth_table,
                   prm);
    scene.crack_tip.read_table(problems);
    find_converted_mesh(scene.geometry, problems);
    replace_boundary_names(scene, problems);
    for (const auto &[name, text] :
         named_materials(scene, catalogue, prm, problems))
      set(MaterialParameters::section, name, text, prm);
    scene.tables.find_calls(prm);
    return scene;
  }



  std::string
  used_parameters(ParameterHandler &prm)
  {
    std::ostringstream text;
    prm.print_parameters(text, ParameterHandler::PRM);
    return text.str();
  }



  void
  print_parameters(std::ostream &out, const std::string &format)
  {
    Scene            scene;
    ParameterHandler prm;
    scene.add_parameters(prm);

    if (format == "prm")
      prm.print_parameters(out,
                           ParameterHandler::PRM |
                             ParameterHandler::KeepDeclarationOrder);
    else if (format == "json")
      prm.print_parameters(out,
                           ParameterHandler::ShortJSON |
                             ParameterHandler::KeepDeclarationOrder);
    else if (format == "markdown")
      print_markdown(out, prm);
    else
      out << make_scene_schema(make_catalogue(prm)).dump(2) << '\n';
  }
} // namespace Crevasse
