// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// The lip on several ranks. Eight cells in a row put the crack tip, whose node
// a support holds, where the cells of two ranks meet: its neighbour on the lip
// belongs to the other rank.

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/contact/condensed_solver.h>
#include <crevasse/discretisation/external_loads.h>
#include <crevasse/discretisation/stiffness.h>
#include <crevasse/grid/geometry.h>
#include <crevasse/linear/mumps.h>
#include <crevasse/material/voigt_matrix.h>
#include <crevasse/model/body.h>
#include <crevasse/parameters/built_in_boundary.h>
#include <crevasse/postprocess/field_writer.h>
#include <crevasse/postprocess/probe.h>

#include <deal.II/dofs/dof_tools.h>

#include <crevasse_tests/distorted_cube.h>
#include <crevasse_tests/probe_row.h>
#include <crevasse_tests/tests.h>

using namespace Crevasse;

namespace
{
  constexpr unsigned int dim = 2;

  std::shared_ptr<const Mesh<dim>>
  make_mesh(const GeometryParameters &geometry)
  {
    auto mesh = std::make_shared<Mesh<dim>>(MPI_COMM_WORLD);
    Crevasse::make_mesh(geometry, *mesh);
    return mesh;
  }



  /** u = (x, 2 + x) with no regard to supports: the opening is 2 + x − gap. */
  void
  set_displacement(const Space<dim> &space, Vector &displacement)
  {
    std::map<dealii::types::global_dof_index, dealii::Point<dim>> points;
    dealii::DoFTools::map_dofs_to_support_points(space.mapping,
                                                 space.dof_handler,
                                                 points);
    const auto                                  &fe = space.finite_element;
    std::vector<dealii::types::global_dof_index> indices(fe.n_dofs_per_cell());
    for (const auto &cell : space.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell->get_dof_indices(indices);
          for (unsigned int i = 0; i < indices.size(); ++i)
            if (displacement.in_local_range(indices[i]))
              displacement(indices[i]) =
                points[indices[i]][0] +
                2. * fe.system_to_component_index(i).first;
        }
    space.constraints.set_zero(displacement);
    displacement.update_ghost_values();
    displacement.zero_out_ghost_values(); // as after a sweep of D
  }



  /** Under the pressure 10, with an opening u_N − gap = 2 + x + 1 + x where the
   * lip is free. */
  void
  show_lip(const unsigned int degree)
  {
    GeometryParameters geometry;
    geometry.subdivisions = "8, 1";
    const Space<dim> space(
      make_mesh(geometry),
      degree,
      built_in_roles(geometry),
      built_in_fixed_points<dim>(geometry, built_in_roles(geometry)));
    const QuadratureField<dim> points(space);
    const StressRecovery<dim>  recovery(space, points);
    const ContactBoundary<dim> lip(space.lip,
                                   space.dof_handler,
                                   space.locally_owned_unknowns,
                                   Expression("-1-x"));

    State state;
    state.displacement = space.ghosted_vector();
    set_displacement(space, state.displacement);
    for (const LipNode<dim> &node : lip.nodes)
      state.contact_forces.normal.push_back(10. * node.weight);
    const LipTotals now = lip.totals(state.displacement, state.contact_forces);
    const std::string name = "Q" + std::to_string(degree);
    std::cout << name << ": force " << now.force << ", largest pressure "
              << now.largest_pressure << std::endl;

    const Vector field = lip.pressure(state.contact_forces);
    std::cout << name << ": sum of the nodal pressures: " << field.l1_norm()
              << std::endl;

    for (const char *place : {"tip: 0.5, 0",
                              "near: 0.53125, 0",
                              "mid: 0.78125, 0",
                              "mouth: 1, 0",
                              "ligament: 0.46875, 0",
                              "inside: 0.5, 0.3"})
      {
        const auto probes =
          make_probes(parse_probes(place), space, recovery, lip);
        const auto &probe  = probes.front();
        const auto  row    = probe_row(probe, space, points, state);
        const bool  on_lip = probe.on_lip;
        std::cout << name << ", " << place << (on_lip ? " on the lip" : "")
                  << ": u_1 " << row[1] << ", opening "
                  << (on_lip ? row[row.size() - 2] : 0.) << ", pressure "
                  << (on_lip ? row.back() : 0.) << std::endl;
      }
  }



  /** A block is pressed on its crack plane, with hanging nodes in between: the
   * pressure is that of the load at every node. */
  template <int dim>
  void
  press_block(const unsigned int degree)
  {
    BoundaryRoles roles;
    roles.symmetry = {0};
    if (dim == 3)
      roles.symmetry.insert(4);
    roles.contact = {2};
    roles.loaded  = {3};
    FixedPoint<dim> foot;
    foot.components.fill(false);
    foot.components[1] = true;
    const Space<dim> space(distorted_cube_with_hanging_nodes<dim>(6 - dim, 0.2),
                           degree,
                           roles,
                           {foot});
    const QuadratureField<dim> points(space);
    const StrainOperator<dim>  strain_operator(space, points);
    const StressRecovery<dim>  recovery(space, points);
    const ContactBoundary<dim> lip(space.lip,
                                   space.dof_handler,
                                   space.locally_owned_unknowns,
                                   Expression("0"));
    SparseMatrix               matrix;
    assemble_stiffness(space,
                       points,
                       PointValues<VoigtMatrix<dim>>(
                         isotropic_stiffness<dim>(13000., 0.3, false)),
                       matrix);
    LoadParameters parameters;
    parameters.traction = dim == 2 ? "0; -10" : "0; -10; 0";
    Vector b, q;
    strain_operator.initialize(b);
    strain_operator.initialize(q);
    ExternalLoads<dim>(space, strain_operator, parameters).evaluate(0., b);

    const UnilateralBounds bounds = unilateral_bounds(lip, space);
    const SignoriniProblem problem(matrix, bounds);
    Mumps                  mumps(matrix, problem.all_bounded_dofs());
    CondensedSolver        solver(problem, mumps, 1e-12);
    State                  state;
    solver.solve(b, q, state.contact_forces.normal);
    state.displacement = q;

    double least_weight = 1.;
    for (const LipNode<dim> &node : lip.nodes)
      least_weight = std::min(least_weight, node.weight);
    const std::string name =
      std::to_string(dim) + "D, Q" + std::to_string(degree);
    check(name + ": positive weights",
          dealii::Utilities::MPI::min(least_weight, MPI_COMM_WORLD) > 0.);
    check_below(name + ": force - load, relative",
                std::abs(lip.totals(q, state.contact_forces).force / 10. - 1.),
                1e-10);

    const Vector pressure   = lip.pressure(state.contact_forces);
    double       difference = 0.;
    for (const double value : pressure)
      if (value != 0.)
        difference = std::max(difference, std::abs(value / 10. - 1.));
    check_below(name + ": nodal pressure - load, relative",
                dealii::Utilities::MPI::max(difference, MPI_COMM_WORLD),
                1e-10);
    // On a hanging node, beside the held one.
    const auto probe =
      make_probes(parse_probes(dim == 2 ? "P: 0.125, 0"
                                        : "P: 0.1666666667, 0, 0.01"),
                  space,
                  recovery,
                  lip);
    check_below(name + ": pressure at a probe, relative",
                std::abs(
                  probe_row(probe[0], space, points, state).back() / 10. - 1.),
                1e-8);

    bool thrown = false;
    try
      {
        mumps.solve_with_lip(q, b, [](DirectSolver::LipVector &) {
          if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
            throw NumericalError("the first rank cannot solve it");
        });
      }
    catch (const NumericalError &)
      {
        thrown = true;
      }
    check(name + ": what fails on the lip of one rank fails on all",
          dealii::Utilities::MPI::min(thrown ? 1 : 0, MPI_COMM_WORLD) == 1);
  }



  /** What one rank alone finds is thrown on all. */
  void
  show_errors()
  {
    const auto rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const auto last =
      dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) - 1;
    bool thrown = false;
    try
      {
        collectively(MPI_COMM_WORLD, [&]() {
          if (rank == last)
            throw SceneError("the last rank says so");
        });
      }
    catch (const SceneError &error)
      {
        thrown = (std::string(error.what()) == "the last rank says so");
      }
    check("thrown on all ranks",
          dealii::Utilities::MPI::min(thrown ? 1 : 0, MPI_COMM_WORLD) == 1);

    GeometryParameters geometry;
    geometry.subdivisions = "8, 1";
    const Space<dim> space(make_mesh(geometry),
                           1,
                           built_in_roles(geometry),
                           {});
    try
      {
        // Positive at the mouth only.
        const ContactBoundary<dim> lip(space.lip,
                                       space.dof_handler,
                                       space.locally_owned_unknowns,
                                       Expression("x-0.9"));
        check("a positive gap is refused", false);
      }
    catch (const SceneError &error)
      {
        std::cout << error.what() << std::endl;
      }
  }
} // namespace

void
lip()
{
  show_lip(1);
  show_lip(2);
  for (const unsigned int degree : {1, 2})
    {
      press_block<2>(degree);
      press_block<3>(degree);
    }
  show_errors();
}
