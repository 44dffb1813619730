// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/app/output_choice.h>
#include <crevasse/app/picture.h>
#include <crevasse/app/run_command.h>
#include <crevasse/base/collectively.h>
#include <crevasse/base/expression.h>
#include <crevasse/base/single_process.h>
#include <crevasse/base/stop_request.h>
#include <crevasse/base/text_file.h>
#include <crevasse/base/version.h>
#include <crevasse/checkpoint/scene_difference.h>
#include <crevasse/crack_tip/growth_law.h>
#include <crevasse/parameters/scene_file.h>
#include <crevasse/simulation/adaptive_run.h>
#include <crevasse/simulation/mesh_picture.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <thread>

namespace Crevasse
{
  namespace
  {
    /** Exit status of the program for an exception. */
    int
    exit_status_of(const std::exception &error)
    {
      if (dynamic_cast<const SceneError *>(&error) != nullptr)
        return bad_input;
      if (dynamic_cast<const FileError *>(&error) != nullptr)
        return file_failure;
      return numerical_failure;
    }



    /** Whether all ranks arrive within some seconds; if only one rank has an
     * error, the others wait elsewhere. */
    bool
    all_ranks_arrive(const MPI_Comm communicator)
    {
      using namespace std::chrono;
      constexpr std::chrono::seconds patience(10);

      // A nonblocking barrier, apart from communication of the other ranks.
      MPI_Request request;
      int         arrived = 0;
      MPI_Ibarrier(communicator, &request);
      const auto start = steady_clock::now();
      while (arrived == 0 && steady_clock::now() - start < patience)
        {
          std::this_thread::sleep_for(milliseconds(10));
          MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
        }
      return arrived != 0;
    }



    /**
     * Ends a run by an exception: writes its message and returns its exit
     * status.
     *
     * Most errors are thrown on all ranks at once. If only one rank has an
     * error, e.g. if the first rank cannot write a table, the others would wait
     * for it forever: after some seconds the rank ends all ranks by MPI_Abort,
     * with the same status.
     */
    int
    report_failure(const std::exception &error,
                   const MPI_Comm        communicator,
                   Log                  &log)
    {
      const std::string message = std::string("crevasse: ") + error.what();
      const int         status  = exit_status_of(error);
      log.error(message);

      int n_ranks, rank;
      MPI_Comm_size(communicator, &n_ranks);
      MPI_Comm_rank(communicator, &rank);
      if (n_ranks > 1 && !all_ranks_arrive(communicator))
        {
          if (rank != 0) // only rank 0 logs
            std::cerr << message << " (rank " << rank << ')' << std::endl;
          MPI_Abort(communicator, status);
        }
      return status;
    }



    /** Whether the run has finished, which is then logged. */
    bool
    has_finished(const OutputChoice &output,
                 const Scene        &scene,
                 const Summary      &parameters,
                 const MPI_Comm      communicator,
                 Log                &log)
    {
      std::string why;
      collectively(communicator, [&]() {
        if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
          why = output.why_finished(scene, parameters);
      });
      if (!why.empty())
        log.line("--resume: " + why);
      return dealii::Utilities::MPI::broadcast(communicator, !why.empty(), 0);
    }



    /** Checks a scene, and draws its mesh if that is asked for; after a mistake
     * the mesh before refinement by solutions, if there is one.
     * @return exit status of the scene's mistake, or else of the page's. */
    template <int dim>
    int
    check_scene(const Command      &command,
                const Scene        &scene,
                const OutputChoice &output,
                Checkpoints        &checkpoints,
                const MPI_Comm      for_failures,
                Log                &log)
    {
      std::shared_ptr<const Mesh<dim>> mesh;
      std::string                      mistake;
      int                              status = done;
      try
        {
          const AdaptiveRun<dim> run(scene, MPI_COMM_WORLD, log, checkpoints);
          mesh = run.mesh();
          log.line("  output directory: " + output.directory);
          output.require_usable();
          log.line(scene.refinement.strategy == RefinementStrategy::adaptive
                     ? "The scene is in order; only elastic states were "
                       "computed, for the mesh."
                     : "The scene is in order; nothing was computed.");
        }
      catch (const StoppedOnRequest &)
        {
          throw;
        }
      catch (const std::exception &error)
        {
          mistake = error.what();
          status  = report_failure(error, for_failures, log);
        }
      if (command.picture.empty())
        return status;
      try
        {
          require_place_of_picture(command, MPI_COMM_WORLD);
          if (mesh == nullptr)
            mesh = make_scene_mesh<dim>(scene, MPI_COMM_WORLD);
          Summary picture    = mesh_picture(scene, *mesh);
          picture["mistake"] = mistake;
          draw_picture(command, picture, log);
        }
      catch (const std::exception &error)
        {
          if (mistake == error.what()) // without a mesh there is no page
            log.error("crevasse: The picture " + command.picture +
                      " was not made.");
          else
            {
              const int of_page = report_failure(error, for_failures, log);
              status            = status == done ? of_page : status;
            }
        }
      return status;
    }



    /** @return exit status. */
    template <int dim>
    int
    run_scene(const Command            &command,
              const Scene              &scene,
              dealii::ParameterHandler &prm,
              StopRequests             &requests,
              const MPI_Comm            for_failures,
              Log                      &log)
    {
      const Summary      parameters   = scene_as_json(prm);
      const std::string  used         = used_parameters(prm);
      const MPI_Comm     communicator = MPI_COMM_WORLD;
      const OutputChoice output(command, scene);
      Checkpoints        checkpoints(requests,
                              log,
                              output.directory,
                              parameters,
                              scene.output.checkpoint_every);
      if (command.check)
        return check_scene<dim>(
          command, scene, output, checkpoints, for_failures, log);
      if (command.resume)
        {
          if (has_finished(output, scene, parameters, communicator, log))
            return done;
          checkpoints.resume(communicator);
        }
      else
        collectively(communicator, [&]() {
          if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
            output.require_nothing_to_resume(used);
        });
      requests.look_in(output.directory);
      AdaptiveRun<dim>               run(scene, communicator, log, checkpoints);
      std::unique_ptr<DirectoryLock> lock;
      collectively(communicator, [&]() {
        if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
          lock = command.resume ? output.resume(used, checkpoints)
                                : output.prepare(used, log);
      });
      log.open_file(output.directory + "/log.txt", command.resume);
      run.run();
      log.line("  results in " + output.directory);
      log.line("  to see them in a browser: crevasse report " +
               output.directory);
      return done;
    }



    /** Reads the scene of a command.
     * @throw SceneError with all mistakes; FileError */
    Scene
    read_scene(const Command &command, dealii::ParameterHandler &prm)
    {
      if (std::error_code unknown;
          !std::filesystem::exists(command.scene_file, unknown))
        {
          const std::string guess = similar_to(command.scene_file);
          throw FileError("The file \"" + command.scene_file +
                          "\" does not exist" + (guess.empty() ? "." : guess));
        }
      Problems problems;
      Scene    scene =
        read_scene(command.scene_file, command.overrides, prm, problems);
      scene.check(problems);
      problems.throw_if_any();
      scene.output.stress_record = command.stress_record;
      scene.output.command_line  = command.words;
      if (command.stress_record && scene.refinement.readapt_every > 0)
        throw SceneError(
          "[Refinement] Readapt every = " +
          std::to_string(scene.refinement.readapt_every) +
          ": stresses on changing meshes cannot be compared; set "
          "it to 0, or leave stress out of the errors of the "
          "sweep.");
      return scene;
    }



    /** Prints the parameters of the scene, or else the defaults. */
    void
    print_parameters_of(const Command &command)
    {
      std::ostringstream text;
      if (command.scene_file.empty())
        print_parameters(text, command.print_format);
      else if (command.print_format != "prm" && command.print_format != "json")
        throw SceneError("--print-parameters " + command.print_format +
                         " describes all parameters; for the values of a scene "
                         "use prm or json.");
      else
        {
          dealii::ParameterHandler prm;
          const Scene              scene = read_scene(command, prm);
          Summary                  json  = scene_as_json(prm);
          json.erase(checksums_of_files);
          text << (command.print_format == "prm" ? used_parameters(prm)
                                                 : json.dump(2) + '\n');
        }
      std::cout << text.str() << std::flush;
      if (!std::cout)
        throw FileError("Cannot write to the standard output.");
    }
  } // namespace



  int
  show_parameters(const Command &command)
  {
    if (!is_first_process())
      return done;
    try
      {
        print_parameters_of(command);
        return done;
      }
    catch (const std::exception &error)
      {
        std::cerr << "crevasse: " << error.what() << std::endl;
        return exit_status_of(error);
      }
  }



  int
  evaluate(const std::vector<std::string> &words)
  {
    try
      {
        const Expression formula(words.at(3),
                                 Expression::Variables::space_and_time,
                                 words[2]);
        if (formula.depends_on_space())
          throw SceneError("a formula may depend on t, but not on x, y, z");
        for (std::size_t i = 4; i < words.size(); ++i)
          std::cout << Text::from_number(
                         formula.value(dealii::Point<2>(), std::stod(words[i])))
                    << '\n';
        return done;
      }
    catch (const std::exception &error) // also if T is no number
      {
        std::cerr << error.what() << std::endl;
        return bad_input;
      }
  }



  int
  print_growth(const std::vector<std::string> &words)
  {
    try
      {
        std::vector<std::string> of_scene = words; // "growth", FILE
        of_scene.erase(of_scene.begin() + 1, of_scene.begin() + 3);
        dealii::ParameterHandler prm;
        const Scene scene = read_scene(parse_command_line(of_scene), prm);
        const CrackTipParameters &law = scene.crack_tip;
        for (const CrackGrowth &growth :
             growth_of_histories(law, scene.loads.period, words.at(2)))
          std::cout << Text::from_number(growth.fatigue) << ' '
                    << Text::from_number(growth.creep) << '\n';
        return done;
      }
    catch (const std::exception &error)
      {
        std::cerr << "crevasse: " << error.what() << std::endl;
        return exit_status_of(error);
      }
  }



  int
  run_command(const Command &command, std::string &with_bars)
  {
    // Failures have a communicator of their own.
    MPI_Comm for_failures;
    MPI_Comm_dup(MPI_COMM_WORLD, &for_failures);
    Log log(MPI_COMM_WORLD, command.quiet, command.verbose);
    int status = done;
    try
      {
        StopRequests             requests(MPI_COMM_WORLD, command.wall_time);
        dealii::ParameterHandler prm;
        const Scene              scene = read_scene(command, prm);
        log.line("Crevasse " CREVASSE_VERSION ": " +
                 std::filesystem::path(command.scene_file).filename().string());
        status =
          (scene.dimension == 2
             ? run_scene<2>
             : run_scene<3>)(command, scene, prm, requests, for_failures, log);
        if (status == done && !command.check &&
            command.bars.value_or(scene.output.error_bars))
          with_bars = OutputChoice(command, scene).directory;
      }
    catch (const StoppedOnRequest &request)
      {
        log.line(std::string("crevasse: ") + request.what());
        status = stopped;
      }
    catch (const std::exception &error)
      {
        status = report_failure(error, for_failures, log);
      }
    MPI_Comm_free(&for_failures);
    return status;
  }
} // namespace Crevasse
