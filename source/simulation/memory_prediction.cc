// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/linear/point_moduli.h>
#include <crevasse/model/linear_choice.h>
#include <crevasse/model/solver_memory.h>
#include <crevasse/simulation/memory_prediction.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    constexpr double mebibyte = 1024. * 1024.;

    /** What A without a matrix keeps of K where points share no values. */
    template <int dim>
    double
    bytes_of_packed_stiffness(const Body<dim>          &body,
                              const LinearSolverChoice &solver)
    {
      const auto stiffness = body.material.at(0.).stiffness;
      if (solver.type != LinearSolverType::gmg || !stiffness->is_individual())
        return 0.;
      const auto &K            = stiffness->distinct();
      const bool  is_isotropic = std::all_of(K.begin(), K.end(), [](auto &of) {
        return IsotropicModuli<dim>::represents(of, true);
      });
      return double(sizeof(double)) * body.points.n_local_points() *
             (is_isotropic ? IsotropicModuli<dim>::n_values
                           : GeneralModuli<dim>::n_values);
    }



    /** What the parts of a prediction depend on. */
    template <int dim>
    struct Scale
    {
      Scale(const Body<dim> &body, const Scene &scene)
        : n_ranks(Utilities::MPI::n_mpi_processes(body.space.communicator()))
        , degree(body.space.finite_element().degree)
        , unknowns(body.space.n_unknowns())
        , own_unknowns(body.space.locally_owned_unknowns().n_elements())
        , own_cells(body.space.mesh().n_locally_owned_active_cells())
        , own_points(body.points.n_local_points())
        , strain(double(body.law.branches().size()) * n_stress_components<dim> *
                 own_points)
        , solver(choose_linear_solver(scene, body))
        , packed_stiffness(bytes_of_packed_stiffness(body, solver))
        , coarsest(n_unknowns_of_first_mesh(body))
      {
      }

      const unsigned int       n_ranks;
      const unsigned int       degree;
      const double             unknowns; ///< of all ranks
      const double             own_unknowns;
      const double             own_cells;
      const double             own_points;
      const double             strain; ///< numbers of r
      const LinearSolverChoice solver;
      const double             packed_stiffness; ///< bytes
      const double             coarsest;         ///< unknowns of the first mesh
    };



    /** Of geometric multigrid's coarsest mesh: its matrix and what solves with
     * it. */
    template <int dim>
    double
    bytes_of_coarsest(const Scale<dim> &scale)
    {
      const double own = scale.coarsest / scale.n_ranks;
      const auto   solver =
        choose_matrix_solver(dim, scale.coarsest, scale.n_ranks);
      return bytes_per_entry * n_matrix_entries<dim>(own, scale.degree) +
             bytes_of_matrix_solver<dim>(
               solver.type, scale.coarsest, own, scale.degree, scale.n_ranks);
    }



    /** Of what solves with one stiffness. */
    template <int dim>
    double
    bytes_of_solver(const Scale<dim> &scale)
    {
      if (scale.solver.type != LinearSolverType::gmg)
        return bytes_of_matrix_solver<dim>(scale.solver.type,
                                           scale.unknowns,
                                           scale.own_unknowns,
                                           scale.degree,
                                           scale.n_ranks);
      return bytes_of_gmg_vectors(scale.own_unknowns, scale.degree) +
             scale.packed_stiffness + bytes_of_coarsest(scale);
    }



    /** How many stiffnesses there are with what solves with them: more than one
     * if those of instants are kept. */
    template <int dim>
    double
    n_systems(const Body<dim> &body,
              const StepList  &steps,
              const Scene     &scene,
              const double     bytes_of_one)
    {
      if (!body.material.stiffness_varies())
        return 1.;
      // Two stages a step, of which one may be another step's.
      return 1. + std::min(2. * steps.n_steps(),
                           scene.linear_solver.memory_for_instants * mebibyte /
                             bytes_of_one);
    }



    /** The stress of all samples of a period is kept to compare with the next;
     * the integrator keeps r, a stage and a rate for each stage, the search r
     * at the beginning of the period. What solvers and observers need besides
     * is measured. */
    template <int dim>
    double
    bytes_of_fields(const Scale<dim> &scale,
                    const Body<dim>  &body,
                    const StepList   &steps)
    {
      const double     stress  = n_stress_components<dim> * scale.own_points;
      const bool       creeps  = body.effects.viscosity.on;
      constexpr double vectors = 30.;
      return sizeof(double) *
             ((steps.n_steps() + (creeps ? 8. : 2.)) * stress +
              (creeps ? 5. : 0.) * scale.strain + vectors * scale.own_unknowns);
    }



    template <int dim>
    double
    bytes_of_search(const Scale<dim>     &scale,
                    const StepList       &steps,
                    const Scene          &scene,
                    const PeriodicChoice &choice)
    {
      double values = 0.;
      // Images and residuals, and their differences while they are combined;
      // besides start and image, the next start and the best image.
      if (choice.method == PeriodicMethodType::anderson)
        values +=
          4. * (scene.periodic_state.anderson_depth + 2.) * scale.strain;
      if (choice.uses_fourier())
        values += steps.n_steps() * (scale.strain + 2. * scale.own_unknowns);
      return sizeof(double) * values;
    }



    template <int dim>
    double
    bytes_of_output(const Scale<dim> &scale,
                    const Body<dim>  &body,
                    const StepList   &steps,
                    const Scene      &scene)
    {
      if (!body.effects.field_output.on)
        return 0.;
      std::set<unsigned int> instants = {steps.n_steps()};
      for (const double t : scene.output.field_times)
        instants.insert(steps.nearest(t));

      // Displacement, stress and, with viscosity, r of each.
      const double fields = body.effects.viscosity.on ? 2. : 1.;
      const double kept   = scale.own_unknowns +
                          fields * n_stress_components<dim> * scale.own_points;
      // Two tensors, displacement, principal stresses with directions, J₂ and
      // pressure at the nodes of each cell, twice: as patches and as text.
      const double columns =
        2. * n_stress_components<dim> + dim * (2. + dim) + 2.;
      const double nodes =
        scale.own_cells * Utilities::fixed_power<dim>(scale.degree + 1.);
      return sizeof(double) * (instants.size() * kept + 2. * columns * nodes);
    }
  } // namespace



  double
  MemoryPrediction::total() const
  {
    return libraries + mesh + fields + matrix + solver + search + output;
  }



  template <int dim>
  MemoryPrediction
  predict_memory(const Body<dim>      &body,
                 const StepList       &steps,
                 const Scene          &scene,
                 const PeriodicChoice &choice)
  {
    const Scale<dim> scale(body, scene);
    MemoryPrediction bytes;
    bytes.libraries = scale.n_ranks > 1 ? 195e6 : 180e6;
    bytes.mesh      = body.space.mesh().memory_consumption() +
                 body.space.dof_handler().memory_consumption();
    bytes.fields = bytes_of_fields(scale, body, steps);
    const double matrix =
      scale.solver.type == LinearSolverType::gmg
        ? 0.
        : bytes_per_entry *
            n_matrix_entries<dim>(scale.own_unknowns, scale.degree);
    const double solver = bytes_of_solver(scale);
    const double n      = n_systems(body, steps, scene, matrix + solver);
    bytes.matrix        = n * matrix;
    bytes.solver        = n * solver;
    bytes.search        = bytes_of_search(scale, steps, scene, choice);
    bytes.output        = bytes_of_output(scale, body, steps, scene);
    return bytes;
  }



#define INSTANTIATE(dim)                                           \
  template MemoryPrediction predict_memory<dim>(const Body<dim> &, \
                                                const StepList &,  \
                                                const Scene &,     \
                                                const PeriodicChoice &)

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
