// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/linear/cholesky.h>
#include <crevasse/model/linear_choice.h>

#include <deal.II/base/utilities.h>

#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  double
  n_unknowns_of_first_mesh(const Body<dim> &body)
  {
    return double(dim) *
           Utilities::pow(body.space.finite_element().degree, dim) *
           body.space.mesh().n_cells(0);
  }



  template <int dim>
  double
  n_matrix_entries(const double n_rows, const unsigned int degree)
  {
    return n_rows * dim * Utilities::fixed_power<dim>(degree + 2.);
  }



  namespace
  {
    /** ML counts with 32 bits: where a process had 0.9e9 entries it wrote
     * beyond its arrays (Trilinos 13.2), with 0.5e9 it worked. */
    constexpr double most_entries_of_ml = 0.5e9;
  } // namespace



  template <int dim>
  void
  require_work_for_ml(const double       n_own_unknowns,
                      const double       n_unknowns,
                      const unsigned int degree,
                      const unsigned int n_ranks)
  {
    const double entries = n_matrix_entries<dim>(n_own_unknowns, degree);
    if (entries <= most_entries_of_ml)
      return;
    throw SceneError(
      "[Linear solver] Type: amg is at its end with about " +
      std::to_string(std::lround(1e-6 * entries)) +
      " million entries of the stiffness on a process (at most " +
      std::to_string(std::lround(1e-6 * most_entries_of_ml)) +
      " million; the mesh has " + Text::from_number(n_unknowns) +
      " unknowns). Take Type = gmg with fewer [Geometry] Subdivisions and "
      "more Refinements, or at least " +
      std::to_string(
        std::lround(std::ceil(n_ranks * entries / most_entries_of_ml))) +
      " processes.");
  }



  template <int dim>
  bool
  may_use_gmg(const Scene &scene, const Body<dim> &body)
  {
    return scene.discretisation.singular_functions == 0 &&
           !traits(scene.contact.solver).relaxes &&
           scene.contact.relaxation_table.empty() &&
           body.space.mesh().n_global_levels() > 1 &&
           n_unknowns_of_first_mesh(body) <= largest_factorised(dim);
  }



  template <int dim>
  LinearSolverChoice
  choose_linear_solver(const Scene &scene, const Body<dim> &body)
  {
    const MPI_Comm           communicator = body.space.communicator();
    const LinearSolverChoice choice =
      choose_linear_solver(scene.linear_solver,
                           dim,
                           scene.discretisation.degree,
                           body.space.n_unknowns(),
                           Utilities::MPI::n_mpi_processes(communicator),
                           may_use_gmg(scene, body));
    if (choice.type == LinearSolverType::cholesky)
      Cholesky::require_one_process(communicator);
    if (choice.type == LinearSolverType::amg)
      require_work_for_ml<dim>(
        Utilities::MPI::max(double(
                              body.space.locally_owned_unknowns().n_elements()),
                            communicator),
        body.space.n_unknowns(),
        body.space.finite_element().degree,
        Utilities::MPI::n_mpi_processes(communicator));
    if (choice.is_multigrid() && body.space.singular_shapes() != nullptr)
      throw SceneError(
        "[Discretisation] Singular functions: must be 0 on a mesh that is too "
        "large for a direct solver (" +
        std::to_string(body.space.n_unknowns()) +
        " unknowns), or set [Linear solver] Type = cholesky or mumps.");
    return choice;
  }



  template <int dim>
  ContactSolverChoice
  choose_contact_solver(const Scene              &scene,
                        const Body<dim>          &body,
                        const LinearSolverChoice &linear_solver)
  {
    const MPI_Comm    communicator = body.space.communicator();
    const std::size_t n_bounds =
      Utilities::MPI::sum(body.lip.nodes().size(), communicator);
    const ContactSolverChoice choice =
      choose_contact_solver(scene.contact, linear_solver, n_bounds);
    if (Utilities::MPI::n_mpi_processes(communicator) > 1)
      {
        if (choice.type == ContactSolverType::projected_sor && n_bounds > 0)
          throw SceneError(
            "[Contact] Solver = projected sor works on one process only, from "
            "unknown to unknown. Set Solver = automatic, or start the program "
            "without mpirun.");
        if (!scene.contact.relaxation_table.empty())
          throw SceneError(
            "[Contact] Relaxation table: projected SOR, whose iterations it "
            "counts, works on one process only. Leave the table empty, or "
            "start the program without mpirun.");
      }
    return choice;
  }



  template <int dim>
  SolverChoice
  choose_solvers(const Scene &scene, const Body<dim> &body)
  {
    const LinearSolverChoice linear = choose_linear_solver(scene, body);
    return {linear, choose_contact_solver(scene, body, linear)};
  }



#define INSTANTIATE(dim)                                                     \
  template double n_unknowns_of_first_mesh<dim>(const Body<dim> &);          \
  template double n_matrix_entries<dim>(const double, const unsigned int);   \
  template void   require_work_for_ml<dim>(const double,                     \
                                         const double,                     \
                                         const unsigned int,               \
                                         const unsigned int);              \
  template bool   may_use_gmg<dim>(const Scene &, const Body<dim> &);        \
  template LinearSolverChoice  choose_linear_solver<dim>(const Scene &,      \
                                                        const Body<dim> &); \
  template ContactSolverChoice choose_contact_solver<dim>(                   \
    const Scene &, const Body<dim> &, const LinearSolverChoice &)

  template SolverChoice
  choose_solvers<2>(const Scene &, const Body<2> &);
  template SolverChoice
  choose_solvers<3>(const Scene &, const Body<3> &);
  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
