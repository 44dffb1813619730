// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/app/command_line.h>
#include <crevasse/app/server.h>

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace Crevasse
{
  namespace
  {
    using Json = nlohmann::json;



    void
    redirect(const int   descriptor,
             const Json &request,
             const char *name,
             const int   flags)
    {
      const std::string file   = request.value(name, "/dev/null");
      const int         opened = open(file.c_str(), flags);
      if (opened < 0 || dup2(opened, descriptor) < 0)
        {
          std::cerr << "Cannot open " << file << std::endl;
          std::_Exit(file_failure);
        }
    }



    /** Prepares the process of a run. @return the words of its command. */
    std::vector<std::string>
    begin_run(const Json &request)
    {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      redirect(STDIN_FILENO, request, "input", O_RDONLY);
      redirect(STDOUT_FILENO, request, "output", O_WRONLY);
      redirect(STDERR_FILENO, request, "error", O_WRONLY);
      const std::string directory = request.value("directory", ".");
      if (chdir(directory.c_str()) != 0)
        {
          std::cerr << "Cannot change to " << directory << std::endl;
          std::_Exit(file_failure);
        }
      for (const auto &name : request.value("unset", Json::array()))
        unsetenv(name.get<std::string>().c_str());
      alarm(request.value("seconds", 0u)); // SIGALRM ends the run

      std::vector<std::string> words = {"crevasse"};
      for (const auto &word : request.at("arguments"))
        words.push_back(word);
      return words;
    }



    /** Writes an answer in one piece, as other processes answer as well. */
    void
    answer(const Json &json)
    {
      const std::string line = json.dump() + '\n';
      if (write(STDOUT_FILENO, line.data(), line.size()) < 0)
        std::_Exit(file_failure);
    }



    /** Runs a request in a child process, and waits for its end.
     * @return the words of the request in the child process alone. */
    std::vector<std::string>
    watch(const std::string &line)
    {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      std::signal(SIGCHLD, SIG_DFL);
      Json       request, id;
      const auto report = [](const Json::exception &error) {
        std::cerr << "crevasse serve: " << error.what() << std::endl;
      };
      try
        {
          request = Json::parse(line);
          id      = request.at("id");
        }
      catch (const Json::exception &error)
        {
          report(error);
          answer({{"id", nullptr}, {"status", bad_input}, {"cpu", 0.}});
          std::_Exit(bad_input);
        }
      const pid_t child = fork();
      if (child == 0)
        try
          {
            return begin_run(request);
          }
        catch (const Json::exception &error)
          {
            report(error);
            std::_Exit(bad_input);
          }

      if (child > 0)
        answer({{"id", id}, {"process", child}});
      int    status = W_EXITCODE(file_failure, 0); // if fork() failed
      rusage usage  = {};
      wait4(child, &status, 0, &usage);
      const auto seconds = [](const timeval &time) {
        return time.tv_sec + 1e-6 * time.tv_usec;
      };
      answer({{"id", id},
              {"status",
               WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status)},
              {"cpu", seconds(usage.ru_utime) + seconds(usage.ru_stime)}});
      std::_Exit(done);
    }
  } // namespace



  std::vector<std::string>
  serve()
  {
    setsid(); // terminal signals are for others
    std::signal(SIGCHLD, SIG_IGN);
    for (std::string line; std::getline(std::cin, line);)
      {
        const pid_t child = fork();
        if (child == 0)
          return watch(line);
        if (child < 0)
          std::_Exit(file_failure);
      }
    std::_Exit(done);
  }



  std::optional<std::vector<std::string>>
  leave_server()
  {
    // A pipe must not get the descriptor of a closed standard stream.
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
      if (fcntl(stream, F_GETFD) < 0)
        open("/dev/null", O_RDWR);
    int requests[2], answers[2];
    if (pipe(requests) != 0 || pipe(answers) != 0)
      return {};
    const pid_t child = fork();
    if (child == 0)
      {
        dup2(requests[0], STDIN_FILENO);
        dup2(answers[1], STDOUT_FILENO);
        for (const int end : {requests[0], requests[1], answers[0], answers[1]})
          close(end);
        return serve();
      }
    close(requests[0]);
    close(answers[1]);
    if (child < 0)
      {
        close(requests[1]);
        close(answers[0]);
        return {};
      }
    setenv(
      "CREVASSE_SERVER",
      (std::to_string(requests[1]) + ',' + std::to_string(answers[0])).c_str(),
      1);
    return {};
  }
} // namespace Crevasse
