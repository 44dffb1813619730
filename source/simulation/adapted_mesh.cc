// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/discretisation/refinement.h>
#include <crevasse/model/contact_system_cache.h>
#include <crevasse/model/elastic_displacement.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/simulation/adapted_mesh.h>

#include <deal.II/base/timer.h>

#include <cmath>
#include <cstdio>
#include <iostream>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** How contact is solved for is of no importance here, but how fast. */
    Scene
    with_fast_solvers(Scene scene)
    {
      scene.contact.solver = ContactSolverType::automatic;
      scene.contact.relaxation_table.clear();
      return scene;
    }



    template <int dim>
    void
    clear_flags(const Mesh<dim> &mesh)
    {
      for (const auto &cell : mesh.active_cell_iterators())
        {
          cell->clear_refine_flag();
          cell->clear_coarsen_flag();
        }
    }
  } // namespace



  template <int dim>
  std::vector<double>
  instants_of_estimate(const Scene     &scene,
                       const Body<dim> &body,
                       const StepList  &steps)
  {
    std::vector<double> instants;
    for (const double t : scene.refinement.instants)
      instants.push_back(steps.within_period(t));
    if (!instants.empty())
      return instants;
    if (body.effects.has_free_strain())
      return instants_of_scale(body, steps);
    return instants_of_extreme_loads(body, steps);
  }



  template <int dim>
  AdaptedMesh<dim>::AdaptedMesh(const Scene   &scene,
                                const MPI_Comm communicator,
                                Log           &log,
                                Checkpoints   &checkpoints)
    : scene(with_fast_solvers(scene))
    , history([this, communicator]() {
      return make_scene_mesh<dim>(this->scene, communicator);
    })
  {
    if (checkpoints.is_resuming())
      {
        serialize(checkpoints.resumed());
        current = history.make();
        return;
      }
    current                                = history.make();
    const RefinementParameters &refinement = scene.refinement;
    if (refinement.strategy != RefinementStrategy::adaptive)
      return;
    require_affordable(*current, refinement, scene.discretisation.degree);
    Timer timer;
    Log   quiet(communicator, true);
    while (true)
      {
        checkpoints.requests().stop_if_asked();
        const dealii::Vector<float> squares = estimate(quiet);
        report(log);
        const bool is_good =
          refinement.tolerance > 0. && all.back().error <= refinement.tolerance;
        const bool is_last =
          refinement.cycles > 0 && all.size() > refinement.cycles;
        if (is_good || is_last || !advance(squares))
          break;
      }
    seconds_of_all = timer.wall_time();
  }



  template <int dim>
  void
  AdaptedMesh<dim>::serialize(StateArchive &archive)
  {
    archive.section("mesh");
    history.serialize(archive);
    archive.common_list(all);
    archive.common(seconds_of_all);
  }



  template <int dim>
  dealii::Vector<float>
  AdaptedMesh<dim>::estimate(Log &quiet)
  {
    Timer       timer;
    TimerOutput phases(std::cout, TimerOutput::never, TimerOutput::wall_times);
    const Body<dim> body(scene, current);
    const StepList  steps(scene.time_integration,
                         scene.loads.period,
                         scene.output.field_times);
    body.loads.validate_and_bound(steps.survey_instants({}),
                                  body.space.communicator());
    body.material.validate_and_bound(steps.survey_instants({}), steps.period());

    ContactSystemCache<dim> systems(scene,
                                    body,
                                    choose_solvers(scene, body),
                                    steps,
                                    largest_load(body, steps),
                                    quiet,
                                    phases);
    StressEstimator<dim>    estimator(body.space,
                                   body.points,
                                   body.lip,
                                   scene.loads);
    look_at_elastic_states(body,
                           systems,
                           instants_of_estimate(scene, body, steps),
                           estimator);
    if (estimator.largest_energy() == 0.)
      throw SceneError(
        "[Refinement] Instants: there is no stress at the instants that "
        "adaptive refinement looks at; name some at which the body is loaded.");
    all.push_back({body.space.mesh().n_global_active_cells(),
                   body.space.n_unknowns(),
                   estimator.relative_error(),
                   0.5 * estimator.largest_energy(),
                   timer.wall_time()});
    return estimator.squares();
  }



  template <int dim>
  void
  AdaptedMesh<dim>::report(Log &log) const
  {
    const MeshEstimate &last = all.back();
    char                text[160];
    std::snprintf(text,
                  sizeof(text),
                  "  adaptive mesh %u: %lu cells, %lu unknowns, estimated "
                  "error %.2e, %.2f s",
                  static_cast<unsigned int>(all.size() - 1),
                  static_cast<unsigned long>(last.cells),
                  static_cast<unsigned long>(last.unknowns),
                  last.error,
                  last.seconds);
    log.line(text);
  }



  template <int dim>
  bool
  AdaptedMesh<dim>::advance(const dealii::Vector<float> &squares)
  {
    // What is nearly as large as it may be is not worth another estimate.
    constexpr double   nearly    = 0.98;
    const unsigned int degree    = scene.discretisation.degree;
    const auto         available = scene.refinement.target_unknowns;
    if (available > 0 && count_unknowns(*current, degree) > nearly * available)
      return false;
    const Marks marks = affordable_marks(squares);
    if (marks.refined.empty())
      {
        clear_flags(*current);
        return false;
      }
    history.add(marks);
    current = history.make();
    return true;
  }



  template <int dim>
  bool
  AdaptedMesh<dim>::is_affordable(const Mesh<dim> &mesh) const
  {
    return scene.refinement.target_unknowns == 0 ||
           count_unknowns(mesh, scene.discretisation.degree) <=
             scene.refinement.target_unknowns;
  }



  template <int dim>
  Marks
  AdaptedMesh<dim>::affordable_marks(const dealii::Vector<float> &squares)
  {
    constexpr unsigned int most_attempts = 6;
    for (unsigned int attempt = 0; attempt < most_attempts; ++attempt)
      {
        clear_flags(*current);
        set_flags(*current, squares, scene.refinement, std::pow(0.5, attempt));
        const Marks marks = flagged_cells(*current);
        if (is_affordable(*history.make_with(marks)))
          return marks;
      }
    clear_flags(*current);
    return {};
  }



  template <int dim>
  void
  AdaptedMesh<dim>::flag(const dealii::Vector<float> &squares)
  {
    history.add(affordable_marks(squares));
  }



  template <int dim>
  void
  AdaptedMesh<dim>::keep()
  {
    clear_flags(*current);
    history.add(Marks());
  }



  template <int dim>
  std::shared_ptr<Mesh<dim>>
  AdaptedMesh<dim>::mesh() const
  {
    return current;
  }



  template <int dim>
  const std::vector<MeshEstimate> &
  AdaptedMesh<dim>::estimates() const
  {
    return all;
  }



  template <int dim>
  double
  AdaptedMesh<dim>::seconds() const
  {
    return seconds_of_all;
  }



  template <int dim>
  void
  AdaptedMesh<dim>::add_to(Summary &summary) const
  {
    for (const MeshEstimate &estimate : all)
      summary["refinement"]["meshes"].push_back(
        {{"cells", estimate.cells},
         {"unknowns", estimate.unknowns},
         {"estimated_error", estimate.error},
         {"energy", estimate.energy},
         {"seconds", estimate.seconds}});
  }



#define INSTANTIATE(dim)                                                    \
  template std::vector<double> instants_of_estimate<dim>(const Scene &,     \
                                                         const Body<dim> &, \
                                                         const StepList &); \
  template class AdaptedMesh<dim>

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
