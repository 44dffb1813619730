// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/simulation/adaptive_run.h>
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
  {
    this->scene.geometry.crack_length = adapted.crack_length();
    on_mesh                           = std::make_unique<Run<dim>>(
      this->scene, adapted.mesh(), log, checkpoints, state);
    if (checkpoints.is_resuming())
      serialize_summary(checkpoints.resumed());
    else
      adapted.add_to(summary);
    checkpoints.begin_with([this](StateArchive &archive) {
      adapted.serialize(archive);
      serialize_summary(archive);
    });
    describe(*on_mesh);
  }



  template <int dim>
  void
  AdaptiveRun<dim>::run()
  {
    if (checkpoints.is_resuming())
      {
        state.serialize(checkpoints.resumed());
        state.was_resumed = true;
      }
    for (on_mesh->prepare(); !on_mesh->search(); on_mesh->prepare())
      if (scene.refinement.readapt_every > 0)
        readapt();
      else
        grow();
    on_mesh->conclude(summary);
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
  AdaptiveRun<dim>::change_mesh(
    const std::function<void(StateTransfer<dim> &)> &change)
  {
    const Body<dim>   &old        = on_mesh->body;
    const unsigned int n_branches = old.law.branches.size();
    // The mesh of the transfer; the runs get another one.
    const std::shared_ptr<Mesh<dim>> mesh = adapted.mesh();
    StateTransfer<dim>               transfer(*mesh,
                                old.space,
                                old.points,
                                state.displacement,
                                state.viscous_strain,
                                n_branches);
    on_mesh.reset(); // the mesh changes next
    change(transfer);
    state.method_failed = false;
    state.was_resumed   = false;
    on_mesh             = std::make_unique<Run<dim>>(
      scene, adapted.mesh(), log, checkpoints, state);
    const Body<dim> &body = on_mesh->body;
    body.strain_operator.initialize(state.displacement);
    body.points.initialize(state.viscous_strain, n_branches);
    transfer.take(body.space,
                  body.points,
                  state.displacement,
                  state.viscous_strain);
  }



  template <int dim>
  void
  AdaptiveRun<dim>::grow()
  {
    const Stopwatch    watch("mesh adaptation");
    const unsigned int periods = state.result.periods;
    const double       length  = scene.geometry.crack_growth->at(periods);
    on_mesh->body.material.convert(&CreepPoint<dim>::strains,
                                   state.viscous_strain);
    change_mesh([&](StateTransfer<dim> &transfer) {
      transfer.adapt();
      adapted.grow(length);
      scene.geometry.crack_length = length;
    });
    on_mesh->body.material.convert(&CreepPoint<dim>::state,
                                   state.viscous_strain);
    log.line(Text::Message() << "  the crack grows to a length of " << length);
    summary["crack_growth"].push_back(
      {{"after_period", periods}, {"crack_length", length}});
  }



  template <int dim>
  void
  AdaptiveRun<dim>::readapt()
  {
    const Stopwatch             watch("mesh adaptation");
    const Body<dim>            &old        = on_mesh->body;
    const unsigned int          n_branches = old.law.branches.size();
    const StressEstimator<dim> &estimator  = on_mesh->estimate->estimator;
    const double                error      = estimator.relative_error();

    old.material.convert(&CreepPoint<dim>::strains, state.viscous_strain);
    const FieldNorms<dim> before =
      field_norms(old.space, state.viscous_strain, n_branches);
    if (scene.refinement.tolerance == 0. || error > scene.refinement.tolerance)
      adapted.flag(estimator.squares(), old.space.n_independent_unknowns());
    const double moved_before =
      old.space.nodal_values(state.displacement).linfty_norm();
    change_mesh([this](StateTransfer<dim> &transfer) {
      do
        transfer.adapt();
      while (flag_unmatched_lips(*adapted.mesh(), boundary_roles(scene)));
      adapted.renew();
    });
    const Body<dim>      &body = on_mesh->body;
    const FieldNorms<dim> after =
      field_norms(body.space, state.viscous_strain, n_branches);
    body.material.convert(&CreepPoint<dim>::state, state.viscous_strain);

    const Summary sizes = sizes_of(body);
    log.line(
      Text::Message()
      << "  mesh adapted: " << sizes["cells"] << " cells, " << sizes["unknowns"]
      << Text::format(" unknowns; estimated error before %.2e; viscous strain: "
                      "norm %.6e before, %.6e after",
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
