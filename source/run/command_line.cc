// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/run/command_line.h>
#include <crevasse/run/version.h>
#include <crevasse/scene/text.h>

#include <CLI/CLI.hpp>

namespace Crevasse
{
  namespace
  {
    /** Its message is all that someone reads who takes the option for one that
     * wants a scene. */
    std::string
    print_format_problem(const std::string &format)
    {
      if (format == "prm" || format == "json" || format == "markdown")
        return "";
      return "prints all parameters with their defaults and meanings, as prm, "
             "json or markdown, and reads no scene; \"" +
             Text::shorten(format) +
             "\" is none of these formats. A run writes the parameters of its "
             "scene to used.prm.";
    }



    /** What follows the options in the help text. The exit statuses are those
     * of ExitStatus. */
    constexpr const char *examples_and_statuses =
      "Example:\n"
      "  crevasse prm/raous1980.prm --set \"Geometry/Crack length=0.3\" "
      "--output results/short_crack\n\n"
      "Exit status:\n"
      "  0  done\n"
      "  2  bad command line, parameter, expression or mesh, found before "
      "computing\n"
      "  3  numerical failure (no convergence, unstable step, rigid motion "
      "left "
      "free);\n"
      "     also if the stress is not periodic after Maximum periods: all "
      "results are\n"
      "     written then\n"
      "  4  cannot read or write a file";
  } // namespace



  Command
  parse_command_line(const int argc, const char *const *argv)
  {
    Command  command;
    CLI::App app(
      "Crevasse: periodic states of cracked viscoelastic solids "
      "with one-sided contact on the crack lips.");
    app.set_version_flag("--version", "crevasse " CREVASSE_VERSION);
    app.footer(examples_and_statuses);
    auto *scene = app.add_option("scene",
                                 command.scene_file,
                                 "The scene: a .prm or .json file");
    // One value each: the scene may follow.
    app
      .add_option("--set",
                  command.overrides,
                  "\"Section/Name=value\": overrides a parameter of the scene; "
                  "may be repeated")
      ->type_name("ASSIGNMENT")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app
      .add_option("--output",
                  command.output_directory,
                  "Output directory (default: results/<scene name> in the "
                  "working directory)")
      ->type_name("DIR");
    app.add_flag(
      "--check",
      command.check,
      "Check the scene and report effects, boundaries, sizes, memory "
      "and output directory; compute and write nothing");
    app.add_flag("--quiet", command.quiet, "Print nothing but errors");
    auto *print = app
                    .add_option("--print-parameters",
                                command.print_format,
                                "Print all parameters with their defaults and "
                                "meanings: prm (the default), json or markdown")
                    ->type_name("FORMAT")
                    ->expected(0, 1)
                    ->check(print_format_problem);
    try
      {
        app.parse(argc, argv);
        if (print->count() > 0 && command.print_format.empty())
          command.print_format = "prm";
        if (scene->empty() && print->empty())
          throw CLI::RequiredError("A scene file");
      }
    catch (const CLI::ParseError &error)
      {
        command.exit   = true;
        command.status = app.exit(error) == 0 ? done : bad_input;
      }
    return command;
  }
} // namespace Crevasse
