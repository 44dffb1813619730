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

#include <crevasse/run/sizes.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <cstdio>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Entries of the stiffness: on average 3 (Q1) or 4 (Q2) nodes along each
     * direction share a cell with a node, each with dim components. */
    template <int dim>
    double
    matrix_entries(const Sizes &sizes, const unsigned int degree)
    {
      return double(sizes.unknowns) * dim *
             Utilities::fixed_power<dim>(double(degree + 2));
    }



    /** What the program and its libraries need for the smallest scene. */
    constexpr double bytes_of_libraries = 150e6;



    /** Entries of the Cholesky factor in two dimensions: 5.3 n log₂ n measured
     * with CHOLMOD's default ordering at 116 162 unknowns (Q1). */
    double
    factor_entries(const Sizes &sizes)
    {
      return 5.3 * sizes.unknowns * std::log2(double(sizes.unknowns));
    }



    /** Bytes of these, and of what is stored per quadrature point and per
     * unknown while a period is computed. */
    template <int dim>
    double
    predicted_memory(const Sizes       &sizes,
                     const Body<dim>   &body,
                     const unsigned int n_steps)
    {
      // The stress of all samples of a period is kept to compare with the
      // next; the integrator keeps r, a stage and a rate for each stage.
      const double fields  = n_steps + 8.;
      const double vectors = 12.;
      const double entries =
        matrix_entries<dim>(sizes, body.space.finite_element().degree);
      constexpr double bytes_per_entry = sizeof(double) + sizeof(int);
      return bytes_of_libraries +
             sizeof(double) *
               (fields * n_stress_components<dim> * sizes.quadrature_points +
                vectors * sizes.unknowns) +
             bytes_per_entry * (entries + factor_entries(sizes)) +
             body.space.mesh().memory_consumption() +
             body.space.dof_handler().memory_consumption();
    }
  } // namespace



  template <int dim>
  Sizes::Sizes(const Body<dim> &body)
    : cells(body.space.mesh().n_global_active_cells())
    , unknowns(body.space.dof_handler().n_dofs())
    , quadrature_points(body.points.n_points())
    , contact_nodes(
        Utilities::MPI::sum(body.lip.nodes().size(), body.space.communicator()))
  {
  }



  void
  Sizes::add_to(Summary &summary) const
  {
    summary["cells"]             = cells;
    summary["unknowns"]          = unknowns;
    summary["quadrature_points"] = quadrature_points;
    summary["contact_nodes"]     = contact_nodes;
  }



  template <int dim>
  void
  describe_sizes(const Body<dim> &body, const StepList &steps, Log &log)
  {
    const Sizes sizes(body);
    log.line("  mesh: " + std::to_string(sizes.cells) + " cells, " +
             std::to_string(sizes.unknowns) + " unknowns, " +
             std::to_string(sizes.quadrature_points) + " quadrature points, " +
             std::to_string(sizes.contact_nodes) + " contact nodes");
    char text[80];
    std::snprintf(text,
                  sizeof(text),
                  "  memory: about %.0f MB",
                  predicted_memory(sizes, body, steps.n_steps()) * 1e-6);
    log.line(text);
  }



  template Sizes::Sizes(const Body<2> &);
  template void
  describe_sizes<2>(const Body<2> &, const StepList &, Log &);
} // namespace Crevasse
