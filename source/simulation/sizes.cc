// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/simulation/memory_report.h>
#include <crevasse/simulation/sizes.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>

#include <cstdio>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  Sizes::Sizes(const Body<dim> &body)
    : cells(body.space.mesh().n_global_active_cells())
    , unknowns(body.space.n_unknowns())
    , quadrature_points(body.points.n_points())
    , contact_nodes(
        Utilities::MPI::sum(body.lip.nodes().size(), body.space.communicator()))
    , cells_of_ranks(Utilities::MPI::gather(
        body.space.communicator(),
        body.space.mesh().n_locally_owned_active_cells()))
    , levels(body.space.mesh().n_global_levels())
    , smallest_cell(GridTools::minimal_cell_diameter(body.space.mesh()))
    , largest_cell(GridTools::maximal_cell_diameter(body.space.mesh()))
  {
  }



  void
  Sizes::add_to(Summary &summary) const
  {
    summary["cells"]             = cells;
    summary["unknowns"]          = unknowns;
    summary["quadrature_points"] = quadrature_points;
    summary["contact_nodes"]     = contact_nodes;
    summary["cells_of_ranks"]    = cells_of_ranks;
    summary["levels"]            = levels;
    summary["smallest_cell"]     = smallest_cell;
    summary["largest_cell"]      = largest_cell;
  }



  template <int dim>
  void
  describe_sizes(const RunSetup<dim> &setup, Log &log)
  {
    const Sizes sizes(setup.body);
    log.line("  mesh: " + std::to_string(sizes.cells) + " cells, " +
             std::to_string(sizes.unknowns) + " unknowns, " +
             std::to_string(sizes.quadrature_points) + " quadrature points, " +
             std::to_string(sizes.contact_nodes) + " contact nodes");
    char text[120];
    if (setup.scene.refinement.strategy != RefinementStrategy::none)
      {
        std::snprintf(text,
                      sizeof(text),
                      "  refinement: %s, %u levels, cells from %.3g to %.3g",
                      traits(setup.scene.refinement.strategy).name,
                      sizes.levels,
                      sizes.smallest_cell,
                      sizes.largest_cell);
        log.line(text);
      }
    report_memory(setup, log);
  }



  template Sizes::Sizes(const Body<2> &);
  template Sizes::Sizes(const Body<3> &);
  template void
  describe_sizes<2>(const RunSetup<2> &, Log &);
  template void
  describe_sizes<3>(const RunSetup<3> &, Log &);
} // namespace Crevasse
