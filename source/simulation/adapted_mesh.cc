// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/stress_estimator.h>
#include <crevasse/model/elastic_displacement.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/parameters/automatic.h>
#include <crevasse/simulation/adapted_mesh.h>

#include <deal.II/distributed/grid_refinement.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Scene with the fastest contact solver: mesh adaptation does not depend
     * on it. */
    Scene
    with_fast_solvers(Scene scene)
    {
      scene.contact.solver = ContactSolverType::automatic;
      scene.contact.relaxation_table.clear();
      return scene;
    }



    /** The mesh of the scene before all refinement. */
    template <int dim>
    std::shared_ptr<Mesh<dim>>
    make_coarse_mesh(Scene scene, const MPI_Comm communicator)
    {
      scene.geometry.refinements = 0;
      scene.refinement.strategy  = RefinementStrategy::none;
      // Without automatic ones there is no automatic grading of the mesh.
      scene.discretisation.singular_functions = SingularFunctionNumber::none;
      return make_scene_mesh<dim>(scene, communicator);
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



    /** Flags cells by the parameters: those with the largest part of the
     * squared errors are divided, those with the smallest joined where all
     * siblings are. Cells at the finest level stay. Collective.
     *
     * @param squares squared errors by active cell index.
     * @param share of Refine fraction.
     * @return how many cells are to be divided. */
    template <int dim>
    std::size_t
    set_flags(Mesh<dim>                   &mesh,
              const dealii::Vector<float> &squares,
              const RefinementParameters  &parameters,
              const double                 share)
    {
      namespace Refinement = parallel::distributed::GridRefinement;
      const double refine  = share * parameters.refine_fraction;
      const double coarsen = parameters.coarsen_fraction;
      clear_flags(mesh);
      if (parameters.marking == Marking::bulk)
        // The norm is of squares as they are, because squares add up.
        Refinement::refine_and_coarsen_fixed_fraction(
          mesh, squares, refine, coarsen, VectorTools::L1_norm);
      else
        Refinement::refine_and_coarsen_fixed_number(mesh,
                                                    squares,
                                                    refine,
                                                    coarsen);
      std::size_t n_flagged = 0;
      for (const auto &cell : owned_cells(mesh))
        {
          if (static_cast<unsigned int>(cell->level()) >= finest_level<dim>)
            cell->clear_refine_flag();
          n_flagged += cell->refine_flag_set();
        }
      return Utilities::MPI::sum(n_flagged, mesh.get_communicator());
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
    if (Effects::first_on(body.effects.free_strains) != nullptr)
      return instants_of_scale(body, steps);
    return instants_of_extreme_loads(body, steps);
  }



  template <int dim>
  AdaptedMesh<dim>::AdaptedMesh(const Scene   &scene,
                                const MPI_Comm communicator,
                                Log           &log,
                                Checkpoints   &checkpoints)
    : scene(with_fast_solvers(scene))
  {
    if (checkpoints.is_resuming())
      {
        serialize(checkpoints.resumed());
        current = make_coarse_mesh<dim>(this->scene, communicator);
        current->load(checkpoints.resumed_mesh());
        return;
      }
    current = make_scene_mesh<dim>(scene, communicator, &log);
    const RefinementParameters &refinement = scene.refinement;
    const auto n = count_unknowns(*current, scene.discretisation.degree);
    if (refinement.target_unknowns > 0 && n > refinement.target_unknowns)
      log.line("  [Refinement] Target unknowns = " +
               std::to_string(refinement.target_unknowns) + ": the mesh has " +
               std::to_string(n) + " before refinement, and is not refined");
    if (refinement.strategy != RefinementStrategy::adaptive)
      return;
    const Stopwatch watch("mesh adaptation");
    Log             quiet(communicator, true);
    while (true)
      {
        checkpoints.requests.stop_if_asked();
        const dealii::Vector<float> squares = estimate(quiet);
        report(log);
        const bool is_good =
          refinement.tolerance > 0. && all.back().error <= refinement.tolerance;
        const bool is_last =
          refinement.cycles > 0 ? all.size() > refinement.cycles : repeats();
        if (is_good || is_last || !advance(squares))
          break;
      }
    renew(); // numbered as in a resumed run
  }



  template <int dim>
  void
  AdaptedMesh<dim>::serialize(StateArchive &archive)
  {
    archive.section("mesh");
    archive.common_list(all);
    archive.common(scene.geometry.crack_length);
  }



  template <int dim>
  dealii::Vector<float>
  AdaptedMesh<dim>::estimate(Log &quiet)
  {
    Timer                   timer;
    const Body<dim>         body(scene, current);
    const StepList          steps(scene);
    ContactSystemCache<dim> systems(scene,
                                    body,
                                    choose_solvers(scene, body),
                                    steps,
                                    largest_load(body, steps),
                                    quiet);
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
        "[Refinement] Instants: the stress is zero at the instants of adaptive "
        "refinement; name instants at which the body is loaded.");
    all.push_back({body.space.mesh().n_global_active_cells(),
                   body.space.n_independent_unknowns(),
                   estimator.relative_error(),
                   0.5 * estimator.largest_energy(),
                   timer.wall_time()});
    return estimator.squares();
  }



  template <int dim>
  bool
  AdaptedMesh<dim>::repeats() const
  {
    const MeshEstimate &last = all.back();
    return std::any_of(
      all.begin(), all.end() - 1, [&last](const MeshEstimate &one) {
        return one.cells == last.cells && one.unknowns == last.unknowns &&
               std::abs(one.error - last.error) < 1e-9 * last.error;
      });
  }



  template <int dim>
  void
  AdaptedMesh<dim>::report(Log &log) const
  {
    const MeshEstimate &last = all.back();
    log.line(
      Text::format("  adaptive mesh %u: %lu cells, %lu unknowns, estimated "
                   "error %.2e, %.2f s",
                   static_cast<unsigned int>(all.size() - 1),
                   static_cast<unsigned long>(last.cells),
                   static_cast<unsigned long>(last.unknowns),
                   last.error,
                   last.seconds));
  }



  template <int dim>
  bool
  AdaptedMesh<dim>::advance(const dealii::Vector<float> &squares)
  {
    // The prediction is trusted up to twice the unknowns; with a limit, up to
    // half of the rest, unless the rest is not worth another estimate.
    constexpr double   growth = 2., nearly = 0.95, little = 0.05;
    const unsigned int degree = scene.discretisation.degree;
    const double       now    = all.back().unknowns;
    const double       limit  = nearly * scene.refinement.target_unknowns;
    const double       wanted = scene.refinement.tolerance;
    double             enough = growth * now;
    if (limit > 0.)
      enough = std::min(
        {enough, limit, now + std::max(0.5 * (limit - now), little * limit)});
    // The squares exclude what singular functions describe.
    const CrackFront<dim> front =
      singular_functions(scene).n > 0 && boundary_roles(scene).crack.empty()
        ? CrackFront<dim>()
        : crack_front<dim>(*current, boundary_roles(scene));
    bool                  divides   = false;
    dealii::Vector<float> predicted = squares;
    // Joining may remove as many cells as dividing adds.
    double before = 0., n = count_unknowns(*current, degree);
    while (before < n && n <= enough && flag(predicted, n))
      {
        do
          divide_and_predict(*current, front, degree, predicted);
        while (flag_unmatched_lips(*current, boundary_roles(scene)));
        divides = true;
        before  = std::exchange(n, count_unknowns(*current, degree));
        if (scene.refinement.cycles > 0 ||
            Utilities::MPI::sum(predicted.l1_norm(),
                                current->get_communicator()) <= wanted * wanted)
          break;
      }
    return divides;
  }



  template <int dim>
  bool
  AdaptedMesh<dim>::flag(const dealii::Vector<float> &squares,
                         const double                 n_unknowns)
  {
    // If the change is too large, fewer cells are divided.
    constexpr unsigned int most_attempts = 6;
    const auto             available     = scene.refinement.target_unknowns;
    // Neighbours of a divided cell may have to be divided as well; the factor
    // is several times that of tested scenes.
    const double of_each = 3. * GeometryInfo<dim>::max_children_per_cell *
                           n_unknowns / current->n_global_active_cells();
    for (unsigned int attempt = 0; attempt < most_attempts; ++attempt)
      {
        const double      share = std::pow(0.5, attempt);
        const std::size_t n_flagged =
          set_flags(*current, squares, scene.refinement, share);
        if (n_flagged == 0)
          return false;
        if (available == 0 || n_unknowns + of_each * n_flagged < available)
          return true;
        clear_flags(*current); // copies include flags
        Mesh<dim> trial(current->get_communicator());
        trial.copy_triangulation(*current);
        set_flags(trial, squares, scene.refinement, share);
        do
          trial.execute_coarsening_and_refinement();
        while (flag_unmatched_lips(trial, boundary_roles(scene)));
        if (count_unknowns(trial, scene.discretisation.degree) <= available)
          {
            set_flags(*current, squares, scene.refinement, share);
            return true;
          }
      }
    return false;
  }



  template <int dim>
  void
  AdaptedMesh<dim>::renew()
  {
    auto mesh = make_coarse_mesh<dim>(scene, current->get_communicator());
    mesh->load(current->get_p4est());
    current = mesh;
  }



  template <int dim>
  void
  AdaptedMesh<dim>::grow(const double crack_length)
  {
    const auto vertices = [this]() {
      return make_coarse_mesh<dim>(scene, current->get_communicator())
        ->get_vertices();
    };
    const std::vector<Point<dim>> before = vertices();
    const double                  former =
      std::exchange(scene.geometry.crack_length, crack_length);
    const std::vector<Point<dim>> after    = vertices();
    constexpr double              rounding = 1e-12;
    bool                          is_same  = before.size() == after.size();
    for (unsigned int i = 0; is_same && i < after.size(); ++i)
      is_same = before[i].distance(after[i]) <= rounding * scene.geometry.width;
    if (!is_same)
      throw SceneError(
        "[Geometry] Crack growth: a crack of length " +
        Text::from_number(crack_length) + " needs other cells than one of " +
        Text::from_number(former) +
        ". Choose Subdivisions with lines between cells at all its tips.");
    renew();
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



  template decltype(instants_of_estimate<2>) instants_of_estimate<2>;
  template decltype(instants_of_estimate<3>) instants_of_estimate<3>;
  template class AdaptedMesh<2>;
  template class AdaptedMesh<3>;
} // namespace Crevasse
