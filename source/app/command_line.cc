// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/app/command_line.h>
#include <crevasse/app/command_line_mistake.h>
#include <crevasse/base/text.h>
#include <crevasse/base/version.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <optional>
#include <regex>
#include <sstream>

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
      "Examples:\n"
      "  crevasse prm/raous1980.prm --set \"Geometry/Crack length=0.3\" "
      "--output results/short_crack\n"
      "  crevasse advise prm/raous1980.prm --error 1e-3\n"
      "  crevasse sweep --help\n\n"
      "Exit status:\n"
      "  0  done\n"
      "  2  bad command line, parameter, expression or mesh, found before "
      "computing\n"
      "  3  numerical failure (no convergence, unstable step, rigid motion);\n"
      "     also if the stress is not periodic after Maximum periods; all\n"
      "     results are written\n"
      "  4  cannot read or write a file\n"
      "  5  stopped on request (SIGTERM, SIGINT, SIGHUP, --wall-time, a file\n"
      "     \"stop\" in the output directory), checkpoint written: --resume "
      "goes on";



    /** For who calls the program without anything. */
    constexpr const char *what_to_do_next =
      "Crevasse computes periodic states of cracked viscoelastic solids, from "
      "a "
      "scene file:\n\n"
      "  crevasse prm/raous1980.prm       run a scene, here the paper's "
      "example\n"
      "  crevasse --check SCENE.prm       what a scene asks for, before it "
      "runs\n"
      "  crevasse --print-parameters      all parameters with their defaults, "
      "for a scene\n"
      "                                   of your own\n"
      "  crevasse sweep --help            what accuracy costs\n"
      "  crevasse advise --help           the cheapest settings for an "
      "accuracy\n"
      "  crevasse --help                  all options\n\n"
      "doc/getting_started.md tells more.\n";



    constexpr const char *sweep_examples =
      "Quantities, for --error and --exact:\n"
      "  probe_NAME/COLUMN     a column of a probe's table: u_1, s_22, "
      "opening, "
      "...\n"
      "  probe_NAME/u, .../s   all its displacements, all its stresses\n"
      "  contact/COLUMN        of the lip's table: force, largest_pressure, "
      "closed_nodes\n"
      "  periods/stress_change, load_work/load_work\n"
      "  stress                at all quadrature points, in the last period\n"
      "  Without --error: stress, u and s of every probe, and "
      "contact/force.\n\n"
      "Examples:\n"
      "  crevasse sweep prm/raous1980.prm --set "
      "\"Contact/Solver=automatic\" \\\n"
      "    --vary \"Time integration/Scheme=heun,sdirk2\" \\\n"
      "    --vary \"Time integration/Steps per period=20,40,80\" \\\n"
      "    --reference \"Time integration/Steps per period=1280\"\n\n"
      "What is finished is not computed again: after an interruption the same "
      "command\ngoes on. doc/sweep.md explains errors, tables and folders.\n\n"
      "Exit status: as that of a run. Points that are refused or fail have "
      "rows "
      "that say\nso; the status is 3 only if no point has results.";



    constexpr const char *advise_examples =
      "The error is the largest of all quantities, each relative to its "
      "largest value.\nSchemes and steps, elements and meshes, and the search "
      "for the periodic state are\ntried; what the body is and bears never "
      "changes.\n\n"
      "Files in DIR:\n"
      "  advised.prm   the scene with the settings found: crevasse "
      "advised.prm\n"
      "  advice.md     what was chosen and all that was measured, for people\n"
      "  advice.json   the same for scripts\n"
      "  runs/         the runs\n\n"
      "Example:\n"
      "  crevasse advise prm/raous1980.prm --error 1e-2\n\n"
      "What is finished is not computed again: after an interruption the same "
      "command\ngoes on. doc/advise.md explains the method.\n\n"
      "Exit status: as that of a run; 3 if the error is not reached with the "
      "largest\nmeshes that are tried: what comes nearest is written then.";



    void
    add_overrides(CLI::App                 &app,
                  const std::string        &name,
                  const std::string        &type,
                  const std::string        &meaning,
                  std::vector<std::string> &texts)
    {
      // One value each: the scene may follow.
      app.add_option(name, texts, meaning)
        ->type_name(type)
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    }



    /** "3600", "1:00:00", "2-12:00:00" (days first, as batch systems have
     * it); nothing if it is none of these. */
    std::optional<double>
    seconds_in(const std::string &text)
    {
      static const std::regex clock(
        "(?:(\\d{1,4})-)?(\\d{1,4}):([0-5]?\\d):([0-5]?\\d)");
      std::smatch parts;
      if (std::regex_match(text, parts, clock))
        {
          const auto part = [&parts](const unsigned int k) {
            return parts[k].matched ? std::stod(parts[k]) : 0.;
          };
          return ((24. * part(1) + part(2)) * 60. + part(3)) * 60. + part(4);
        }
      std::istringstream number(text);
      double             seconds = 0.;
      number >> seconds;
      if (!number || !number.eof())
        return {};
      return seconds;
    }



    std::string
    wall_time_problem(const std::string &text)
    {
      if (seconds_in(text).value_or(0.) > 0.)
        return "";
      return "\"" + Text::shorten(text) +
             "\" is no time: seconds, hours:minutes:seconds, or days before "
             "these are, as 3600, 1:00:00 or 2-12:00:00.";
    }



    /** What runs and sweeps have in common. */
    void
    add_common_options(CLI::App                 &app,
                       const std::string        &default_directory,
                       Command                  &command,
                       std::vector<std::string> &overrides)
    {
      add_overrides(app,
                    "--set",
                    "ASSIGNMENT",
                    "\"Section/Name=value\": overrides a parameter of the "
                    "scene; may be repeated",
                    overrides);
      app
        .add_option("--output",
                    command.output_directory,
                    "Output directory (default: " + default_directory +
                      " in the working directory)")
        ->type_name("DIR");
      app.add_flag("--quiet", command.quiet, "Print nothing but errors");
      app
        .add_option_function<std::string>(
          "--wall-time",
          [&command](const std::string &text) {
            command.wall_time = *seconds_in(text);
          },
          "Stop early enough to be done after this time: seconds, "
          "hours:minutes:seconds, or days-hours:minutes:seconds")
        ->type_name("TIME")
        ->check(wall_time_problem);
    }



    CLI::App *
    add_sweep(CLI::App                 &app,
              Command                  &command,
              std::vector<std::string> &overrides)
    {
      SweepRequest &request = command.sweep_request;
      CLI::App     *sweep =
        app.add_subcommand("sweep",
                           "Run a scene for all combinations of some "
                           "parameters; tabulate errors and costs");
      sweep
        ->add_option("scene",
                     command.scene_file,
                     "The scene: a .prm or .json file")
        ->required();
      add_overrides(
        *sweep,
        "--vary",
        "LIST",
        "\"Section/Name=a,b,c\": the values of a parameter, "
        "separated by \";\" if they contain commas, by \" | \" if both. May be "
        "repeated: all combinations are computed. "
        "\"S/N=a,b & S/M=c,d\" changes two together",
        request.vary);
      add_overrides(*sweep,
                    "--reference",
                    "ASSIGNMENT",
                    "\"Section/Name=value\": the run that errors are measured "
                    "against is the scene with this; may be repeated",
                    request.reference);
      add_overrides(*sweep,
                    "--exact",
                    "FORMULA",
                    "\"QUANTITY=formula of t\": what a quantity is compared "
                    "with instead; may be repeated",
                    request.exact);
      sweep
        ->add_option("--error",
                     request.error,
                     "Quantities whose errors are wanted, separated by commas: "
                     "stress, or TABLE/COLUMN of probe_NAME, contact, "
                     "crack_tip, periods or load_work, as crack_tip/K_I")
        ->type_name("LIST");
      add_common_options(*sweep,
                         "results/<scene name>_sweep",
                         command,
                         overrides);
      sweep->footer(sweep_examples);
      return sweep;
    }



    std::string
    target_problem(const std::string &text)
    {
      // Rounding and the contact solvers' tolerance are not far below 1e-8.
      const double error = Text::to_number(text).value_or(0.);
      if (error >= 1e-8 && error < 1.)
        return "";
      return "\"" + Text::shorten(text) +
             "\" is no relative error that could be reached: a number of at "
             "least 1e-8 and less than 1, as 1e-3.";
    }



    CLI::App *
    add_advise(CLI::App                 &app,
               Command                  &command,
               std::vector<std::string> &overrides)
    {
      CLI::App *advise =
        app.add_subcommand("advise",
                           "Find the cheapest settings of a scene that reach "
                           "an error; write them as a scene");
      advise
        ->add_option("scene",
                     command.scene_file,
                     "The scene: a .prm or .json file")
        ->required();
      advise
        ->add_option("--error",
                     command.target_error,
                     "The relative error of the histories that is to be "
                     "reached, as 1e-3")
        ->type_name("NUMBER")
        ->required()
        ->check(target_problem);
      advise
        ->add_option("--quantities",
                     command.quantities,
                     "Quantities that are to have it, separated by commas, as "
                     "probe_mouth/u, crack_tip/K_I; without it u and s of all "
                     "probes")
        ->type_name("LIST");
      add_common_options(*advise,
                         "results/<scene name>_advice",
                         command,
                         overrides);
      advise->footer(advise_examples);
      return advise;
    }



    /** Options of a run, beside those of the studies. */
    void
    add_run(CLI::App                 &app,
            Command                  &command,
            std::vector<std::string> &overrides)
    {
      app.add_option("scene",
                     command.scene_file,
                     "The scene: a .prm or .json file");
      add_common_options(app, "results/<scene name>", command, overrides);
      app.add_flag(
        "--check",
        command.check,
        "Check the scene and report effects, boundaries, sizes, memory "
        "and output directory; compute and write nothing");
      app
        .add_flag("--resume",
                  command.resume,
                  "Go on from the newest checkpoint of the output directory")
        ->excludes("--check");
      app
        .add_flag(
          "--force",
          command.force,
          "Replace the results of an earlier run, which are otherwise "
          "moved into a folder earlier_1, earlier_2, ... beside the new "
          "ones")
        ->excludes("--check")
        ->excludes("--resume");
      app
        .add_option("--print-parameters",
                    command.print_format,
                    "Print all parameters with their defaults and "
                    "meanings: prm (the default), json or markdown")
        ->type_name("FORMAT")
        ->expected(0, 1)
        ->check(print_format_problem);
    }



    /** What was asked for, of several things that exclude each other.
     * @throw CLI::ParseError if it is none of them, or more than one. */
    void
    decide(const CLI::App &app,
           const CLI::App &sweep,
           const CLI::App &advise,
           Command        &command)
    {
      const CLI::Option &scene = *app.get_option("scene");
      const CLI::Option &print = *app.get_option("--print-parameters");
      command.sweep            = sweep.parsed();
      command.advise           = advise.parsed();
      const bool study         = command.sweep || command.advise;
      if ((command.sweep && command.advise) ||
          (study && (!scene.empty() || !print.empty() || command.check ||
                     command.resume || command.force)))
        throw CLI::ParseError(
          "\"sweep\" or \"advise\" comes first, and all else after it.",
          CLI::ExitCodes::ExtrasError);
      if (!print.empty() && command.print_format.empty())
        command.print_format = "prm";
      if (scene.empty() && print.empty() && !study)
        throw CLI::RequiredError("A scene file");
    }
  } // namespace



  Command
  parse_command_line(const int argc, const char *const *argv)
  {
    Command                  command;
    std::vector<std::string> overrides;
    CLI::App                 app(
      "Crevasse: periodic states of cracked viscoelastic solids "
                      "with one-sided contact on the crack lips.");
    app.set_version_flag("--version", "crevasse " CREVASSE_VERSION);
    app.footer(examples_and_statuses);
    add_run(app, command, overrides);
    const CLI::App *sweep  = add_sweep(app, command, overrides);
    const CLI::App *advise = add_advise(app, command, overrides);
    if (argc <= 1)
      {
        std::cerr << what_to_do_next;
        command.exit   = true;
        command.status = bad_input;
        return command;
      }
    try
      {
        app.parse(argc, argv);
        decide(app, *sweep, *advise, command);
        for (const std::string &text : overrides)
          command.overrides.push_back({text, "--set"});
      }
    catch (const CLI::ParseError &error)
      {
        command.exit   = true;
        command.status = tell(error, app) == 0 ? done : bad_input;
      }
    return command;
  }
} // namespace Crevasse
