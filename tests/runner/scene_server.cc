// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Runs the program many times without starting it: loading 200 shared libraries
// takes 0.4 s, which is most of what a small scene takes. This process loads
// them once and forks before anything is initialised, so that each run has a
// process of its own: an exit status, signals, memory, and no state of others.
//
// Reads a request a line from standard input,
//   {"arguments": ["a.prm"], "directory": ".", "seconds": 300}
// and answers with a line on standard output,
//   {"status": 0, "output": "...", "error": "...", "cpu": 0.05}
// where a status below zero is minus the number of the signal that ended the
// run. A run that takes longer than it may is killed.

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

// That of source/main.cc, which is compiled with this for "main".
int
crevasse_main(int argc, char **argv);

namespace
{
  using Json = nlohmann::json;



  /** A file without a name, removed when it is closed. */
  class TemporaryFile
  {
  public:
    TemporaryFile()
      : file(std::tmpfile())
    {
    }

    TemporaryFile(const TemporaryFile &) = delete;

    ~TemporaryFile()
    {
      std::fclose(file);
    }

    int
    descriptor() const
    {
      return fileno(file);
    }

    std::string
    text() const
    {
      std::string all;
      char        part[4096];
      std::rewind(file);
      while (const std::size_t n = std::fread(part, 1, sizeof(part), file))
        all.append(part, n);
      return all;
    }

  private:
    std::FILE *const file;
  };



  [[noreturn]] void
  run(const Json &request, const TemporaryFile &out, const TemporaryFile &error)
  {
    const std::string directory = request.value("directory", ".");
    if (chdir(directory.c_str()) != 0)
      {
        std::cerr << "Cannot change to " << directory << std::endl;
        std::_Exit(125);
      }
    dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(out.descriptor(), STDOUT_FILENO);
    dup2(error.descriptor(), STDERR_FILENO);
    alarm(request.value("seconds", 300u)); // SIGALRM ends the run

    std::vector<std::string> words = {"crevasse"};
    for (const auto &word : request.at("arguments"))
      words.push_back(word);
    std::vector<char *> pointers;
    for (std::string &word : words)
      pointers.push_back(word.data());
    pointers.push_back(nullptr);
    std::exit(crevasse_main(int(words.size()), pointers.data()));
  }



  Json
  answer(const Json &request)
  {
    const TemporaryFile out, error;
    const pid_t         child = fork();
    if (child == 0)
      run(request, out, error);

    int    status = 0;
    rusage usage  = {};
    wait4(child, &status, 0, &usage);
    const auto seconds = [](const timeval &time) {
      return time.tv_sec + 1e-6 * time.tv_usec;
    };
    return {{"status",
             WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status)},
            {"output", out.text()},
            {"error", error.text()},
            {"cpu", seconds(usage.ru_utime) + seconds(usage.ru_stime)}};
  }
} // namespace



int
main()
{
  for (std::string line; std::getline(std::cin, line);)
    std::cout << answer(Json::parse(line))
                   .dump(-1, ' ', false, Json::error_handler_t::replace)
              << std::endl;
}
