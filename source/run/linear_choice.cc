// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/run/linear_choice.h>

#include <deal.II/base/utilities.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  bool
  may_use_gmg(const Scene &scene, const Body<dim> &body)
  {
    const double first_unknowns =
      double(dim) * Utilities::pow(scene.discretisation.degree, dim) *
      body.space.mesh().n_cells(0);
    return scene.discretisation.singular_functions == 0 &&
           scene.contact.solver != "projected sor" &&
           scene.contact.relaxation_table.empty() &&
           body.space.mesh().n_global_levels() > 1 &&
           first_unknowns <= largest_factorised(dim);
  }



  template <int dim>
  LinearSolverChoice
  choose_linear_solver(const Scene &scene, const Body<dim> &body)
  {
    return choose_linear_solver(scene.linear_solver,
                                dim,
                                scene.discretisation.degree,
                                body.space.n_unknowns(),
                                Utilities::MPI::n_mpi_processes(
                                  body.space.communicator()),
                                may_use_gmg(scene, body));
  }



#define INSTANTIATE(dim)                                               \
  template bool may_use_gmg<dim>(const Scene &, const Body<dim> &);    \
  template LinearSolverChoice choose_linear_solver<dim>(const Scene &, \
                                                        const Body<dim> &)

  INSTANTIATE(2);
  INSTANTIATE(3);
} // namespace Crevasse
