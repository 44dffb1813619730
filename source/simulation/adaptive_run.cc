// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/format.h>
#include <crevasse/model/state_transfer.h>
#include <crevasse/simulation/adaptive_run.h>
#include <crevasse/simulation/compute_periods.h>
#include <crevasse/simulation/conclusion.h>
#include <crevasse/simulation/observers.h>
#include <crevasse/simulation/period_estimate.h>
#include <crevasse/simulation/relaxation_table.h>
#include <crevasse/simulation/setup_report.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    Summary
    as_summary(const FieldNorms<dim> &norms)
    {
      Summary summary;
      summary["norm"] = norms.l2;
      for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
        summary["integral"].push_back(norms.integral[c]);
      return summary;
    }



    /**
     * Computes a stage of a run on one mesh, and writes its results to the
     * directory of @p output, which must exist; final results at the end of the
     * run. Collective.
     *
     * @param others further observers.
     * @param state at the start, then the end.
     * @param summary to add to and to write.
     * @throw NumericalError; after all that was computed has been written if
     * the periodic state was not reached. */
    template <int dim>
    void
    run_stage(const RunSetup<dim>           &setup,
              const RunOutput               &output,
              const std::vector<Observer *> &others,
              RunState                      &state,
              Summary                        summary)
    {
      const Scene   &scene = setup.scene;
      Workspace<dim> work(setup, output, state);
      const bool     any_periods = scene.periodic_state.maximum_periods > 0;
      if (!state.has_tables()) // later stages: at a checkpoint
        output.checkpoints.requests.stop_if_asked();
      if (any_periods)
        find_periodic_start(work);
      if (!scene.contact.relaxation_table.empty() && !state.has_tables())
        write_relaxation_table(work);
      // Without periods no tables are begun.
      std::vector<std::unique_ptr<Observer>> observers;
      state.stage.ends_run = true;
      if (any_periods)
        {
          observers = make_observers(work);
          std::vector<Observer *> all;
          for (const auto &observer : observers)
            all.push_back(observer.get());
          all.insert(all.end(), others.begin(), others.end());
          compute_periods(work, all);
        }
      if (state.stage.ends_run)
        {
          summarise_run(work, summary);
          for (const auto &observer : observers)
            observer->summarise(summary);
        }
      state.solvers = work.systems.statistics();
      if (!state.stage.ends_run)
        return;
      write_summary(work, summary);
      conclude(work, summary);
    }
  } // namespace



  template <int dim>
  AdaptiveRun<dim>::AdaptiveRun(const Scene   &scene,
                                const MPI_Comm communicator,
                                Log           &log,
                                Checkpoints   &checkpoints)
    : scene(scene)
    , log(log)
    , checkpoints(checkpoints)
    , adapted(scene, communicator, log, checkpoints)
    , setup(std::make_unique<const RunSetup<dim>>(scene, adapted.mesh()))
  {
    if (checkpoints.is_resuming())
      serialize_summary(checkpoints.resumed());
    else
      adapted.add_to(summary);
    checkpoints.begin_with([this](StateArchive &archive) {
      adapted.serialize(archive);
      serialize_summary(archive);
    });
  }



  template <int dim>
  void
  AdaptiveRun<dim>::describe() const
  {
    Crevasse::describe(*setup, log);
  }



  template <int dim>
  void
  AdaptiveRun<dim>::run(const std::string &directory, const bool stress_record)
  {
    const unsigned int n = scene.refinement.readapt_every;
    const RunOutput    output{log, checkpoints, directory, stress_record};
    if (checkpoints.is_resuming())
      {
        state.serialize(checkpoints.resumed());
        state.was_resumed = true;
      }
    if (n == 0)
      {
        run_stage(*setup, output, {}, state, summary);
        return;
      }
    while (true)
      {
        state.stage             = MeshStage();
        state.stage.last_period = state.result.periods + n;
        auto estimate           = std::make_unique<PeriodEstimate<dim>>(
          scene, setup->body, setup->steps, state.stage.last_period);
        run_stage(*setup, output, {estimate.get()}, state, summary);
        if (state.stage.ends_run)
          return;
        const dealii::Vector<float> squares = estimate->estimator.squares();
        const double error = estimate->estimator.relative_error();
        estimate.reset(); // destroy before its space
        readapt(squares, error);
        state.fourier_failed = false;
        state.was_resumed    = false;
      }
  }



  template <int dim>
  void
  AdaptiveRun<dim>::serialize_summary(StateArchive &archive)
  {
    std::string text = summary.dump();
    archive.common(text);
    if (archive.is_loading())
      summary = Summary::parse(text);
  }



  template <int dim>
  void
  AdaptiveRun<dim>::readapt(const dealii::Vector<float> &squares,
                            const double                 error)
  {
    const Stopwatch    watch("mesh adaptation");
    const Body<dim>   &old        = setup->body;
    const unsigned int n_branches = old.law.branches.size();

    const FieldNorms<dim> before =
      field_norms(old.space, state.viscous_strain, n_branches);
    if (scene.refinement.tolerance == 0. || error > scene.refinement.tolerance)
      adapted.flag(squares, old.space.n_independent_unknowns());
    const std::shared_ptr<Mesh<dim>> mesh = adapted.mesh();
    StateTransfer<dim>               transfer(*mesh,
                                old.space,
                                old.points,
                                state.displacement,
                                state.viscous_strain,
                                n_branches);
    const double                     moved_before =
      old.space.nodal_values(state.displacement).linfty_norm();
    setup.reset(); // the mesh changes next
    do
      transfer.adapt();
    while (flag_unmatched_lips(*mesh, boundary_roles(scene)));
    adapted.renew();
    setup = std::make_unique<const RunSetup<dim>>(scene, adapted.mesh());

    const Body<dim> &body = setup->body;
    body.strain_operator.initialize(state.displacement);
    body.points.initialize(state.viscous_strain, n_branches);
    transfer.take(body.space,
                  body.points,
                  state.displacement,
                  state.viscous_strain);
    const FieldNorms<dim> after =
      field_norms(body.space, state.viscous_strain, n_branches);

    const Summary sizes = sizes_of(body);
    log.line(
      Text::format("  mesh adapted: %lu cells, %lu unknowns; estimated error "
                   "before %.2e; viscous strain: norm %.6e before, %.6e after",
                   sizes["cells"].get<unsigned long>(),
                   sizes["unknowns"].get<unsigned long>(),
                   error,
                   before.l2,
                   after.l2));
    summary["refinement"]["readaptations"].push_back(
      {{"after_period", state.result.periods},
       {"cells", sizes["cells"]},
       {"unknowns", sizes["unknowns"]},
       {"estimated_error", error},
       {"viscous_strain_before", as_summary(before)},
       {"viscous_strain_after", as_summary(after)},
       {"largest_displacement_before", moved_before},
       {"largest_displacement_after",
        body.space.nodal_values(state.displacement).linfty_norm()}});
  }



  template class AdaptiveRun<2>;
  template class AdaptiveRun<3>;
} // namespace Crevasse
