// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/app/command_line.h>
#include <crevasse/app/script_command.h>
#include <crevasse/base/text.h>
#include <crevasse/base/version.h>
#include <crevasse/parameters/mesh_conversion.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sys/wait.h>
#include <unistd.h>

namespace Crevasse
{
  namespace fs = std::filesystem;

  namespace
  {
    /** The directory of the Python package; empty if there is none. */
    fs::path
    find_package(const fs::path &program)
    {
      for (const char *place : {"python", "../share/crevasse/python"})
        {
          const fs::path directory = program.parent_path() / place;
          if (fs::exists(directory / "crevasse" / "__main__.py"))
            return directory;
        }
      return {};
    }
  } // namespace



  const std::vector<ScriptCommand> &
  script_commands()
  {
    static const std::vector<ScriptCommand> commands = {
      {"sweep",
       "Run a scene for all combinations of some parameters; tabulate results, "
       "errors and costs"},
      {"advise",
       "Find the cheapest settings of a scene that reach an error; write them "
       "as a scene"},
      {"life",
       "Compute how a crack grows: its length over the number of periods, with "
       "the error"},
      {"report", "Make one page of the results of a run, a sweep or a life"},
      {"figures", "Draw the figures of a run or a sweep"},
      {"mesh",
       "Convert a mesh file of another program, with its groups, to a Gmsh "
       "file"},
      {"temperature",
       "Convert temperatures of another program for [Loads] Temperature"}};
    return commands;
  }



  bool
  is_script_command(const std::vector<std::string> &words)
  {
    const auto &commands = script_commands();
    return words.size() > 1 && std::any_of(commands.begin(),
                                           commands.end(),
                                           [&words](const auto &command) {
                                             return command.name == words[1];
                                           });
  }



  int
  run_script_command(const std::vector<std::string> &words)
  {
    std::error_code    error;
    const fs::path     program   = fs::read_symlink("/proc/self/exe", error);
    const fs::path     directory = find_package(program);
    const std::string &name      = words[1];
    if (directory.empty())
      {
        std::cerr << "crevasse " << name
                  << ": the Python package is missing: there is neither "
                  << program.parent_path() / "python/crevasse"
                  << " nor "
                  << program.parent_path() / "../share/crevasse/python/crevasse"
                  << ". Build or install the program again.\n";
        return file_failure;
      }
    std::string path = directory.string();
    if (const char *others = std::getenv("PYTHONPATH"))
      path += std::string(":") + others;
    setenv("PYTHONPATH", path.c_str(), 1);
    setenv("CREVASSE_PROGRAM", program.c_str(), 1);
    setenv("CREVASSE_VERSION", CREVASSE_VERSION, 1);

    // -B: Python writes no bytecode beside the scripts.
    std::vector<const char *> arguments = {CREVASSE_PYTHON,
                                           "-B",
                                           "-m",
                                           "crevasse"};
    for (std::size_t i = 1; i < words.size(); ++i)
      arguments.push_back(words[i].c_str());
    arguments.push_back(nullptr);
    execv(arguments[0], const_cast<char *const *>(arguments.data()));
    std::cerr << "crevasse " << name << ": cannot start "
              << CREVASSE_PYTHON
      ". Install Debian's packages python3-jinja2, "
      "python3-matplotlib, python3-meshio and python3-scipy.\n";
    return file_failure;
  }



  namespace
  {
    /** Runs a script command on the scene of a command. */
    int
    run_with_scene(std::vector<std::string>    words,
                   const Command              &command,
                   const std::optional<double> seconds)
    {
      words.push_back(command.scene_file);
      for (const std::string &assignment : command.overrides)
        words.insert(words.end(), {"--set", assignment});
      if (command.quiet)
        words.emplace_back("--quiet");
      if (seconds)
        words.insert(words.end(),
                     {"--wall-time", std::to_string(std::max(*seconds, 1e-3))});
      std::cout << std::flush;
      return run_script_command(words);
    }
  } // namespace



  int
  add_bars(const Command              &command,
           const std::string          &directory,
           const std::optional<double> seconds)
  {
    return run_with_scene({"crevasse", "bars", directory}, command, seconds);
  }



  int
  repeat_until_accurate(const Command &command)
  {
    std::vector<std::string> words = {"crevasse",
                                      "accuracy",
                                      "--accuracy",
                                      Text::from_number(command.accuracy)};
    if (!command.quantities.empty())
      words.insert(words.end(), {"--for", command.quantities});
    if (!command.output_directory.empty())
      words.insert(words.end(), {"--output", command.output_directory});
    return run_with_scene(words,
                          command,
                          command.wall_time > 0.
                            ? std::optional<double>(command.wall_time)
                            : std::nullopt);
  }



  int
  wait_for_script(const std::vector<std::string> &words,
                  const bool                      quiet,
                  const std::string              &input)
  {
    int ends[2];
    if (pipe(ends) != 0)
      return file_failure;
    std::cout << std::flush;
    const pid_t child = fork();
    if (child == 0)
      {
        dup2(ends[0], STDIN_FILENO);
        close(ends[0]);
        close(ends[1]);
        if (quiet && freopen("/dev/null", "w", stdout) == nullptr)
          std::_Exit(file_failure);
        std::_Exit(run_script_command(words));
      }
    close(ends[0]);
    std::FILE *to_child = fdopen(ends[1], "w");
    std::fwrite(input.data(), 1, input.size(), to_child);
    std::fclose(to_child);
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child)
      return file_failure;
    return WIFEXITED(status) ? WEXITSTATUS(status) : file_failure;
  }



  int
  convert_mesh(const Command &command)
  {
    for (const char *of_mpirun : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
      if (const char *size = std::getenv(of_mpirun);
          size != nullptr && std::string(size) != "1")
        return done;
    try
      {
        const std::string from =
          mesh_file_of(command.scene_file, command.overrides);
        const std::string to = converted_mesh(from);
        std::error_code   unknown;
        if (to.empty() || (fs::exists(to, unknown) && !command.trust_mesh))
          return done;
        std::vector<std::string> words = {"crevasse", "mesh", from, to};
        if (command.trust_mesh) // files that it reads may have changed
          words.emplace_back("--trust-mesh");
        return wait_for_script(words,
                               command.quiet || !command.print_format.empty());
      }
    catch (const std::exception &) // reported when the scene is read
      {
        return done;
      }
  }
} // namespace Crevasse
