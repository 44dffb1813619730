// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/parameters/catalogue.h>
#include <crevasse/parameters/scene_file.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** A bar would end the cell of a table. */
    std::string
    in_cell(const std::string &text)
    {
      std::string result;
      for (const char character : text)
        result += character == '|' ? "\\|" : std::string(1, character);
      return result;
    }



    void
    print_table(std::ostream &out, const Catalogue::Section &section)
    {
      out << "\n## " << (section.name.empty() ? "Top level" : section.name)
          << "\n\n| name | default | meaning | allowed |\n"
          << "|---|---|---|---|\n";
      for (const Catalogue::Parameter &parameter : section.parameters)
        {
          const std::string &value = parameter.default_value;
          out << "| " << in_cell(parameter.name) << " | "
              << (value.empty() ? "" : "`" + in_cell(value) + "`") << " | "
              << in_cell(parameter.meaning) << " | "
              << in_cell(parameter.allowed) << " |\n";
        }
    }



    void
    print_markdown(std::ostream &out, const ParameterHandler &prm)
    {
      out << "# Parameters\n\n"
             "Written by `crevasse --print-parameters markdown`. All "
             "quantities are in the user's own\nconsistent units of length, "
             "stress, time and temperature; values without a unit are pure "
             "numbers,\nchoices or texts. [Scenes](scenes.md) explains "
             "formulas: theta is the change of\ntemperature, material the "
             "material id of the cell in a mesh file.\n";
      for (const Catalogue::Section &section : Catalogue(prm).sections)
        print_table(out, section);
    }
  } // namespace



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
      throw SceneError("--print-parameters " + Text::shorten(format) +
                       ": must be prm, json or markdown");
  }
} // namespace Crevasse
