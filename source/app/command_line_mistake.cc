// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/app/command_line_mistake.h>
#include <crevasse/base/text.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <string>
#include <vector>

namespace Crevasse
{
  namespace
  {
    std::vector<std::string>
    options_of(const CLI::App &app)
    {
      std::vector<std::string> names;
      for (const CLI::Option *option : app.get_options())
        for (const std::string &name : option->get_lnames())
          names.push_back("--" + name);
      return names;
    }



    /** "--error" without a command, say. */
    std::string
    commands_with(const std::string &option, const CLI::App &app)
    {
      std::vector<std::string> names;
      for (const CLI::App *command : app.get_subcommands({}))
        if (command->get_option_no_throw(option) != nullptr)
          names.push_back("\"" + command->get_name() + "\"");
      return Text::join(names, " and ");
    }



    std::string
    about_option(const std::string &option, const CLI::App &app)
    {
      const auto        chosen  = app.get_subcommands();
      const CLI::App   &command = chosen.empty() ? app : *chosen.front();
      const std::string of =
        chosen.empty() ? "" : " of \"" + command.get_name() + "\"";
      std::string hint = Text::did_you_mean(option, options_of(command));
      if (const std::string owners = commands_with(option, app);
          hint.empty() && chosen.empty() && !owners.empty())
        hint = "; it is one of " + owners + ", which comes first";
      return "There is no option \"" + Text::shorten(option) + "\"" + of +
             (hint.empty() ? "." : hint + (hint.back() == '?' ? "" : "."));
    }



    /** Which option or command there is none of, and which one may have been
     * meant. Empty if neither is the matter. */
    std::string
    unknown_word(const CLI::App &app)
    {
      for (const std::string &word : app.remaining(true))
        if (word.size() > 1 && word.front() == '-')
          return about_option(word.substr(0, word.find('=')), app);
      const CLI::Option *scene = app.get_option("scene");
      const std::string  first = scene->empty() ? "" : scene->as<std::string>();
      const std::string  suffix = Text::suffix(first);
      if (suffix == ".prm" || suffix == ".json")
        return "";
      std::vector<std::string> commands;
      for (const CLI::App *command : app.get_subcommands({}))
        commands.push_back(command->get_name());
      const std::string hint = Text::did_you_mean(first, commands);
      return hint.empty()
               ? ""
               : "There is no command \"" + Text::shorten(first) + "\"" + hint;
    }
  } // namespace



  int
  tell(const CLI::ParseError &error, const CLI::App &app)
  {
    const std::string unknown =
      error.get_exit_code() == 0 ? "" : unknown_word(app);
    if (unknown.empty())
      return app.exit(error);
    std::cerr << unknown << "\nRun with --help for more information.\n";
    return error.get_exit_code();
  }
} // namespace Crevasse
