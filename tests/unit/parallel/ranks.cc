// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// One, two and four ranks give the same solution: the one that this rank finds
// for itself, with everything on it.

#include <crevasse/base/problems.h>
#include <crevasse/contact/active_set.h>
#include <crevasse/contact/condensed_solver.h>
#include <crevasse/discretisation/rigid_modes.h>
#include <crevasse/linear/amg_cg.h>
#include <crevasse/linear/cholesky.h>
#include <crevasse/linear/mumps.h>
#include <crevasse/linear/mumps_instance.h>

#include <deal.II/dofs/dof_tools.h>

#include <array>
#include <crevasse_tests/plate_on_plane.h>
#include <crevasse_tests/tests.h>
#include <map>

using namespace Crevasse;

namespace
{
  /** Rounded coordinates, and the component. */
  using PointOrder = std::pair<std::array<long, 3>, unsigned int>;

  /** The locally owned entries without constraints, by place and component:
   * numberings differ between ranks. */
  template <int dim>
  std::map<PointOrder, double>
  by_place(const PlateOnPlane<dim> &plate, const Vector &q)
  {
    std::map<dealii::types::global_dof_index, dealii::Point<dim>> points;
    const auto &dofs = plate.space.dof_handler;
    dealii::DoFTools::map_dofs_to_support_points(plate.space.mapping,
                                                 dofs,
                                                 points);
    std::map<PointOrder, double> entries;
    for (unsigned int component = 0; component < dim; ++component)
      {
        dealii::ComponentMask mask(dim, false);
        mask.set(component, true);
        for (const auto dof : dealii::DoFTools::extract_dofs(dofs, mask))
          if (!plate.space.constraints.is_constrained(dof))
            {
              std::array<long, 3> place{};
              for (unsigned int d = 0; d < dim; ++d)
                place[d] = std::lround(1e6 * points[dof][d]);
              entries[{place, component}] = q(dof);
            }
      }
    return entries;
  }

  Vector
  solve(ContactSolver &solver, const Vector &b, double &total_force)
  {
    std::vector<double> forces;
    Vector              q(b);
    q = 0.;
    solver.solve(b, q, forces);
    Vector opposite(b);
    opposite *= -1.;
    solver.solve(opposite, q, forces);
    solver.solve(b, q, forces); // from a wrong set
    total_force = 0.;
    for (const double force : forces)
      total_force += force;
    total_force =
      dealii::Utilities::MPI::sum(total_force, b.get_mpi_communicator());
    return q;
  }

  template <int dim>
  void
  compare(const unsigned int degree, const bool hanging_nodes)
  {
    constexpr unsigned int  n         = dim == 2 ? 12 : 10;
    constexpr double        tolerance = 1e-12;
    double                  force_alone;
    const PlateOnPlane<dim> plate_alone(MPI_COMM_SELF,
                                        n,
                                        degree,
                                        hanging_nodes);
    const SignoriniProblem  problem_alone(plate_alone.matrix,
                                         plate_alone.bounds);
    Cholesky cholesky(plate_alone.matrix, problem_alone.all_bounded_dofs());
    CondensedSolver alone(problem_alone, cholesky, tolerance);
    const auto      reference =
      by_place(plate_alone, solve(alone, plate_alone.loads(), force_alone));

    const PlateOnPlane<dim> plate(MPI_COMM_WORLD, n, degree, hanging_nodes);
    const SignoriniProblem  problem(plate.matrix, plate.bounds);
    Mumps                   mumps(plate.matrix, problem.all_bounded_dofs());
    AmgCg amg(plate.matrix, rigid_modes(plate.space), dim, degree > 1);
    CondensedSolver condensed(problem, mumps, tolerance);
    ActiveSet       with_mumps(problem, mumps, tolerance, 1e-3, 100);
    ActiveSet       with_amg(problem, amg, tolerance, 1e-3, 100);

    section(std::to_string(dim) + "D, degree " + std::to_string(degree) +
            (hanging_nodes ? ", hanging nodes" : ""));
    const auto check_solver = [&](const std::string &name,
                                  ContactSolver     &solver) {
      double force, difference = 0., size = 0.;
      for (const auto &[place, value] :
           by_place(plate, solve(solver, plate.loads(), force)))
        {
          const double expected = reference.at(place);
          difference = std::max(difference, std::abs(value - expected));
          size       = std::max(size, std::abs(expected));
        }
      difference = dealii::Utilities::MPI::max(difference, MPI_COMM_WORLD);
      size       = dealii::Utilities::MPI::max(size, MPI_COMM_WORLD);
      check_below(name + ", displacement", difference / size, 1e-9);
      check_below(name + ", contact force",
                  std::abs(force / force_alone - 1.),
                  1e-9);
    };
    check_solver("condensed active set, MUMPS", condensed);
    check_solver("active set, MUMPS", with_mumps);
    check_solver("active set, AMG", with_amg);
  }

  /** What works on one rank only says so, and what to do. */
  void
  refusals()
  {
    const bool several =
      dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1;
    const PlateOnPlane<2> plate(MPI_COMM_WORLD, 10, 1);
    const auto            refuses = [](const auto &action) {
      try
        {
          action();
        }
      catch (const SceneError &error)
        {
          return std::string(error.what()).find("automatic") !=
                 std::string::npos;
        }
      return false;
    };
    check("Cholesky is refused on several ranks only",
          refuses([&]() { Cholesky solver(plate.matrix); }) == several);
  }

  /** MUMPS numbers its instances, and gives a number again when it is free. */
  void
  factors_left_by_exceptions()
  {
    const auto begin = [](int &number) {
      const MumpsInstance<double> instance(MPI_COMM_WORLD, 1, {}, "", "", "");
      number = instance.data.instance_number;
      throw NumericalError("on all ranks");
    };
    int abandoned = 0, next = 0;
    for (int *number : {&abandoned, &next})
      try
        {
          begin(*number);
        }
      catch (const NumericalError &)
        {
          end_abandoned_factors();
        }
    check("A factor left by an exception is freed", abandoned == next);
  }
} // namespace

void
ranks()
{
  for (const unsigned int degree : {1, 2})
    for (const bool hanging_nodes : {false, true})
      {
        compare<2>(degree, hanging_nodes);
        compare<3>(degree, hanging_nodes);
      }
  section("MUMPS and Cholesky");
  refusals();
  factors_left_by_exceptions();
}
