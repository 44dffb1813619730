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

#include <CLI/CLI.hpp>

namespace Crevasse
{
  Command
  parse_command_line(const int argc, const char *const *argv)
  {
    Command  command;
    CLI::App app(
      "Crevasse: periodic states of cracked viscoelastic solids "
      "with one-sided contact on the crack lips.");
    app.set_version_flag("--version", "crevasse " CREVASSE_VERSION);
    auto *scene = app.add_option("scene",
                                 command.scene_file,
                                 "The scene: a .prm or .json file");
    app
      .add_option("--set",
                  command.overrides,
                  "\"Section/Name=value\": overrides a parameter of the scene; "
                  "may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--output",
                   command.output_directory,
                   "Output directory (default: results/<scene name>)");
    app.add_flag("--check",
                 command.check,
                 "Check the scene and report effects, sizes and memory; "
                 "compute nothing");
    app.add_flag("--quiet", command.quiet, "Print nothing but errors");
    auto *print = app
                    .add_option("--print-parameters",
                                command.print_format,
                                "Print all parameters: prm, json or markdown")
                    ->expected(0, 1)
                    ->check(CLI::IsMember({"prm", "json", "markdown"}));
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
