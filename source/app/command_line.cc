// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/app/command_line.h>
#include <crevasse/app/script_command.h>
#include <crevasse/base/environment.h>
#include <crevasse/base/text.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <regex>

namespace Crevasse
{
  namespace
  {
    /** Text after the options in the output of --help, with the values of
     * ExitStatus. */
    constexpr const char *examples_and_statuses = R"(Examples:
  crevasse prm/raous1980.prm --set "Geometry/Crack length=0.3" --output results/short_crack
  crevasse prm/raous1980.prm --bars
  crevasse prm/raous1980.prm --accuracy 1e-3
  crevasse advise prm/raous1980.prm --error 1e-3
  crevasse report results/raous1980
  crevasse sweep --help

Exit status:
  0  done
  2  bad command line, parameter, expression or mesh, found before computing
  3  numerical failure (no convergence, unstable step, rigid motion);
     also if the stress is not periodic after Maximum periods; all
     results are written
  4  cannot read or write a file
  5  stopped on request (SIGTERM, SIGINT, SIGHUP, --wall-time, a file
     "stop" in the output directory), checkpoint written: continue with --resume)";



    /** Text for a call without arguments. */
    constexpr const char *what_to_do_next =
      R"(Crevasse computes periodic states of cracked viscoelastic solids, from a scene file:

  crevasse prm/raous1980.prm       run a scene, here the paper's example
  crevasse --check SCENE.prm       effects, sizes and memory of a scene, without a run
  crevasse --print-parameters      all parameters with their defaults
  crevasse report DIR              one page of the results
  crevasse sweep --help            results over parameters; what accuracy costs
  crevasse advise --help           the cheapest settings for an accuracy
  crevasse life --help             how a crack grows, with the error
  crevasse --help                  all options

doc/getting_started.md tells more.
)";



    /** Seconds in "3600", "1:00:00", "2-12:00:00" (days-hours:minutes:seconds).
     * @throw CLI::ValidationError */
    double
    seconds_in(const std::string &text)
    {
      static const std::regex clock(
        "(?:(\\d{1,4})-)?(\\d{1,4}):([0-5]?\\d):([0-5]?\\d)");
      double      seconds = Text::to_number(text).value_or(0.);
      std::smatch parts;
      if (std::regex_match(text, parts, clock))
        {
          const auto part = [&parts](const unsigned int k) {
            return parts[k].matched ? std::stod(parts[k]) : 0.;
          };
          seconds = ((24. * part(1) + part(2)) * 60. + part(3)) * 60. + part(4);
        }
      if (seconds > 0.)
        return seconds;
      throw CLI::ValidationError(
        "--wall-time",
        "\"" + Text::shorten(text) +
          "\" is not a time: write seconds, hours:minutes:seconds, or "
          "days-hours:minutes:seconds, such as 3600, 1:00:00 or 2-12:00:00.");
    }



    void
    add_options(CLI::App &app, Command &command)
    {
      app.add_option("scene",
                     command.scene_file,
                     "The scene: a .prm or .json file");
      // Each --set has one value, as the scene may follow.
      app
        .add_option("--set",
                    command.overrides,
                    "\"Section/Name=value\": overrides a parameter of the "
                    "scene; may be repeated")
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
      app.add_flag("--quiet", command.quiet, "Print nothing but errors");
      app.add_flag("--verbose",
                   command.verbose,
                   "Print at the end the time that each part of the run took");
      app
        .add_option_function<std::string>(
          "--wall-time",
          [&command](const std::string &text) {
            command.wall_time = seconds_in(text);
          },
          "Stop early enough to end within this time: seconds, "
          "hours:minutes:seconds, or days-hours:minutes:seconds")
        ->type_name("TIME");
      app.add_flag("--check",
                   command.check,
                   "Check the scene and report effects, boundaries, materials, "
                   "sizes, memory and output directory; compute and write "
                   "nothing");
      app
        .add_option("--picture",
                    command.picture,
                    "With --check: draw the mesh with its boundaries, "
                    "materials, supports and worst cells as a page for a "
                    "browser")
        ->type_name("FILE.html");
      app.add_flag(
        "--trust-mesh",
        command.trust_mesh,
        "Let a .geo file as [Geometry] Mesh file start programs, and "
        "read and write files");
      app
        .add_flag("--resume",
                  command.resume,
                  "Resume from the newest checkpoint of the output directory")
        ->excludes("--check");
      app
        .add_flag("--force",
                  command.force,
                  "Replace the results of an earlier run, which are otherwise "
                  "moved into a folder earlier_1, earlier_2, ... beside the "
                  "new ones")
        ->excludes("--check")
        ->excludes("--resume");
      app
        .add_flag_function(
          "--bars,!--no-bars",
          [&command](const std::int64_t count) { command.bars = count > 0; },
          "Give the results error bars, by companion runs; --no-bars: not, "
          "whatever [Output] Error bars is")
        ->excludes("--check");
      app
        .add_option_function<std::string>(
          "--accuracy",
          [&command](const std::string &text) {
            command.accuracy = Text::to_number(text).value_or(0.);
            if (!(command.accuracy >= 1e-8 && command.accuracy < 1.))
              throw CLI::ValidationError("--accuracy",
                                         "\"" + Text::shorten(text) +
                                           "\" must be a number of at least "
                                           "1e-8 and less than 1, such as "
                                           "1e-3.");
          },
          "Repeat the scene on finer meshes and with shorter steps until the "
          "error bar of K_I, or else of the opening, is at most this part of "
          "the value, such as 1e-3")
        ->type_name("NUMBER")
        ->excludes("--check", "--resume", "--bars");
      app
        .add_option("--for",
                    command.quantities,
                    "Quantities that --accuracy is for, separated by commas, "
                    "named as in the table of error bars")
        ->type_name("LIST")
        ->needs("--accuracy");
      app
        .add_option(
          "--print-parameters",
          command.print_format,
          "Print all parameters with their defaults and meanings: prm (the "
          "default), json, markdown or schema (a JSON schema for editors); "
          "with a scene its values, as prm or json")
        ->type_name("FORMAT")
        ->expected(0, 1)
        ->check(CLI::IsMember({"prm", "json", "markdown", "schema"}));
      // The option is for sweeps only, and not in the help.
      app.add_flag("--stress-record", command.stress_record)->group("");
    }



    /** CLI11's message, and the option or command that was probably meant. */
    std::string
    failure_message(const CLI::App *app, const CLI::Error &error)
    {
      const auto      chosen  = app->get_subcommands();
      const CLI::App &command = chosen.empty() ? *app : *chosen.front();
      std::vector<std::string> options, commands;
      for (const CLI::Option *option : command.get_options())
        for (const std::string &name : option->get_lnames())
          options.push_back("--" + name);
      for (const CLI::App *other : app->get_subcommands({}))
        commands.push_back(other->get_name());

      std::string hint;
      for (const std::string &word : app->remaining(true))
        if (hint.empty() && word.front() == '-')
          hint = Text::did_you_mean(word.substr(0, word.find('=')), options);
      if (const CLI::Option *scene = app->get_option("scene");
          hint.empty() && !scene->empty())
        hint = scene->as<std::string>() == "run"
                 ? "; a scene is run without a command: crevasse SCENE.prm"
                 : Text::did_you_mean(scene->as<std::string>(), commands);
      return error.what() + hint + "\nRun with --help for more information.\n";
    }



    /** Determines which of several exclusive actions is requested.
     * @throw CLI::ParseError if there is none, or more than one. */
    void
    decide(const CLI::App &app, Command &command)
    {
      const bool scene  = !app.get_option("scene")->empty();
      const bool print  = !app.get_option("--print-parameters")->empty();
      const auto chosen = app.get_subcommands();
      if (!chosen.empty()) // not the first word
        throw CLI::ParseError("\"" + chosen.front()->get_name() +
                                "\" must be the first argument.",
                              CLI::ExitCodes::ExtrasError);
      const std::string &picture = command.picture;
      const bool         draws   = !app.get_option("--picture")->empty();
      if (draws && !command.check)
        throw CLI::ValidationError(
          "--picture",
          "it shows a scene before a run: write crevasse --check SCENE.prm "
          "--picture " +
            picture + ".");
      if (draws && Text::suffix(picture) != ".html")
        throw CLI::ValidationError("--picture",
                                   "\"" + picture +
                                     "\" must be a file name that ends in "
                                     ".html.");
      if (print && command.print_format.empty())
        command.print_format = "prm";
      if (!scene && (!print || !command.overrides.empty()))
        throw CLI::RequiredError(print ? "A scene file for --set"
                                       : "A scene file");
    }
  } // namespace



  std::string
  similar_to(const std::string &scene_file)
  {
    namespace fs                    = std::filesystem;
    const fs::path           wanted = scene_file;
    std::vector<std::string> candidates;
    for (const ScriptCommand &command : script_commands())
      candidates.push_back(command.name);
    for (const fs::path &folder : {wanted.parent_path(), fs::path("prm")})
      {
        std::error_code unreadable;
        const fs::path  place = folder.empty() ? "." : folder;
        for (const auto &entry : fs::directory_iterator(place, unreadable))
          if (const fs::path file = folder / entry.path().filename();
              file.extension() == ".prm" || file.extension() == ".json")
            {
              if (file.stem() == wanted.filename())
                return "; did you mean \"" + file.string() + "\"?";
              candidates.push_back(file.string());
            }
      }
    return Text::did_you_mean(scene_file, candidates);
  }



  Command
  parse_command_line(const std::vector<std::string> &words)
  {
    Command command;
    command.words = words;
    CLI::App app(
      "Crevasse: periodic states of cracked viscoelastic solids "
      "with one-sided contact on the crack lips.",
      words.front());
    app.set_version_flag("--version", version_text);
    app.footer(examples_and_statuses);
    app.failure_message(failure_message);
    add_options(app, command);
    for (const ScriptCommand &script : script_commands())
      app.add_subcommand(script.name, script.meaning)->allow_extras();
    if (words.size() <= 1)
      {
        std::cerr << what_to_do_next;
        command.exit   = true;
        command.status = bad_input;
        return command;
      }
    try
      {
        // CLI11 takes the last argument first.
        app.parse(std::vector<std::string>(words.rbegin(), words.rend() - 1));
        decide(app, command);
      }
    catch (const CLI::ParseError &error)
      {
        command.exit   = true;
        command.status = app.exit(error) == 0 ? done : bad_input;
      }
    return command;
  }
} // namespace Crevasse
