// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/app/failure.h>
#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/version.h>
#include <crevasse/linear/mumps_instance.h>
#include <crevasse/simulation/adaptive_run.h>
#include <crevasse/simulation/conclusion.h>
#include <crevasse/study/stress_writer.h>
#include <crevasse/study/sweep_run.h>

#include <filesystem>
#include <optional>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** @param status is "failed" as soon as the scene is not refused, and says
     * in the end whether there are results. */
    template <int dim>
    void
    compute(const Scene       &scene,
            const SweepFolder &folder,
            const bool         keep_stress,
            StopRequests      &requests,
            Log               &log,
            std::string       &status)
    {
      if (keep_stress && scene.refinement.readapt_every > 0)
        throw SceneError("[Refinement] Readapt every = " +
                         std::to_string(scene.refinement.readapt_every) +
                         ": stresses on changing meshes cannot be compared; "
                         "set it to 0, or let the sweep vary nothing that "
                         "needs them.");
      Checkpoints      none(requests, log);
      AdaptiveRun<dim> run(scene, MPI_COMM_WORLD, log, none);
      run.describe();
      status = "failed";

      std::optional<StressWriter<dim>> samples;
      std::vector<Observer *>          observers;
      if (keep_stress)
        {
          samples.emplace(run.discretised_body(), scene.loads.period);
          observers.push_back(&*samples);
        }
      const auto write_samples = [&]() {
        if (samples)
          samples->write(folder.file(SweepFolder::stress_file));
      };
      try
        {
          run.run(folder.path(), observers);
          write_samples();
          status = "done";
        }
      catch (const NotPeriodicError &)
        {
          write_samples();
          status = "not converged";
          throw;
        }
    }



    /** What is thrown on all ranks ends this run only. */
    void
    require_all_ranks(const std::exception &error, const MPI_Comm communicator)
    {
      if (Utilities::MPI::n_mpi_processes(communicator) > 1 &&
          !all_ranks_arrive(communicator))
        abort_all_ranks(error, communicator);
    }



    void
    read_costs(const SweepFolder &folder, SweepResult &result)
    {
      // Also of what failed, if it came so far as to write it.
      if (std::filesystem::exists(folder.file("summary.json")))
        result.costs = costs_in(folder.summary());
    }
  } // namespace



  SweepRun
  run_for_sweep(const Scene       &scene,
                const SweepFolder &folder,
                const bool         keep_stress,
                const MPI_Comm     for_failures,
                StopRequests      &requests)
  {
    const MPI_Comm communicator = MPI_COMM_WORLD;
    const bool first_rank = Utilities::MPI::this_mpi_process(communicator) == 0;
    collectively(communicator, [&]() {
      if (first_rank)
        folder.prepare();
    });

    Log log(communicator, true);
    log.open_file(folder.file("log.txt"));
    log.line("Crevasse " CREVASSE_VERSION ": a point of a sweep");
    SweepRun     run;
    std::string &status = run.result.status = "refused";
    try
      {
        if (scene.dimension == 2)
          compute<2>(scene, folder, keep_stress, requests, log, status);
        else
          compute<3>(scene, folder, keep_stress, requests, log, status);
      }
    catch (const FileError &)
      {
        throw;
      }
    catch (const StoppedOnRequest &)
      {
        throw;
      }
    catch (const std::exception &error)
      {
        require_all_ranks(error, for_failures);
        end_abandoned_factors();
        run.result.message = error.what();
        run.exception      = std::current_exception();
        log.line("crevasse: " + run.result.message);
      }
    collectively(communicator, [&]() {
      if (first_rank)
        read_costs(folder, run.result);
    });
    return run;
  }
} // namespace Crevasse
