// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// All contact solvers give one answer: that of brute force on random
// symmetric positive definite problems with up to 10 bounds, at three scales,
// some with degenerate bounds; and each other's on a plate that lifts off a
// plane in parts, with hanging nodes, lips of one node and of none, and when
// all nodes switch at once.

#include <crevasse/contact/active_set.h>
#include <crevasse/contact/condensed_solver.h>
#include <crevasse/contact/lip_graph.h>
#include <crevasse/contact/no_contact.h>
#include <crevasse/contact/projected_newton.h>
#include <crevasse/contact/projected_sor.h>
#include <crevasse/discretisation/rigid_modes.h>
#include <crevasse/linear/amg_cg.h>
#include <crevasse/linear/cholesky.h>
#include <crevasse/linear/mumps.h>

#include <crevasse_tests/plate_on_plane.h>
#include <crevasse_tests/random_problem.h>
#include <crevasse_tests/tests.h>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>

using namespace Crevasse;

namespace
{
  double
  relative_difference(Vector q, const Vector &reference)
  {
    q -= reference;
    const double size = reference.linfty_norm();
    return size > 0. ? q.linfty_norm() / size : q.linfty_norm();
  }

  using Solvers = std::map<std::string, std::unique_ptr<ContactSolver>>;

  void
  random_problems(const double scale)
  {
    std::map<std::string, double> worst;
    for (unsigned int seed = 0; seed < (is_full() ? 1000 : 100); ++seed)
      {
        const unsigned int n_bounds = 1 + seed % 10;
        RandomProblem      random(seed, n_bounds + seed % 3, n_bounds, scale);
        if (seed % 5 == 0)
          random.make_degenerate(seed % n_bounds,
                                 random.solution_by_enumeration());
        const Vector           exact = random.solution_by_enumeration();
        const SignoriniProblem problem(random.matrix, random.bounds);
        Cholesky cholesky(random.matrix, problem.all_bounded_dofs());

        Solvers solvers;
        solvers["condensed active set"] =
          std::make_unique<CondensedSolver>(problem, cholesky, 1e-12);
        solvers["active set"] =
          std::make_unique<ActiveSet>(problem, cholesky, 1e-12, 1e-3, 100);
        solvers["projected SOR"] =
          std::make_unique<ProjectedSor>(problem, 1.3, 1e-13, 100000);
        for (auto &[name, solver] : solvers)
          {
            Vector              q(random.b.size());
            std::vector<double> forces;
            solver->solve(random.b, q, forces);
            const double difference = relative_difference(q, exact);
            if (!(difference <= worst[name])) // nan counts
              worst[name] = difference;
          }
      }
    section("random problems scaled by 1e" +
            std::to_string(std::lround(std::log10(scale))));
    for (const auto &[name, difference] : worst)
      check_below(name + ", difference from brute force", difference, 1e-10);
  }

  /** Plain active sets cycle on some ill-conditioned problems; that must be
   * noticed, and ended with the right answer. */
  void
  cycling_problems()
  {
    unsigned int cycles = 0;
    double       worst  = 0.;
    // In the default tier up to the first one.
    for (unsigned int seed = 0; seed < 3000 && (is_full() || cycles == 0);
         ++seed)
      {
        const RandomProblem    random(seed, 8, 8, 1., 1e-3);
        const SignoriniProblem problem(random.matrix, random.bounds);
        Cholesky               cholesky(random.matrix);
        ActiveSet              solver(problem, cholesky, 1e-12, 1e-3, 100);
        Vector                 q(random.b.size());
        std::vector<double>    forces;
        solver.solve(random.b, q, forces);
        if (solver.description().find("cycles") == std::string::npos)
          continue;
        ++cycles;
        worst =
          std::max(worst,
                   relative_difference(q, random.solution_by_enumeration()));
      }
    check("active sets cycled and were ended", cycles > 0);
    check_below("active sets that cycled, difference from brute force",
                worst,
                1e-10);
  }

  /** From the inside of the cone and from beyond it, without an active set's
   * help. */
  void
  projected_newton_alone()
  {
    double worst = 0.;
    for (unsigned int seed = 0; seed < (is_full() ? 300 : 60); ++seed)
      {
        const RandomProblem    random(seed, 8, 6, 1.);
        const SignoriniProblem problem(random.matrix, random.bounds);
        Cholesky               cholesky(random.matrix);
        SolverStatistics       counts;
        FaceSolver             face(problem, cholesky, counts);
        ProjectedNewton        newton(problem, face);

        std::mt19937                           generator(seed);
        std::uniform_real_distribution<double> uniform(-3., 3.);
        Vector                                 q(random.b.size());
        for (double &value : q)
          value = uniform(generator);
        newton.solve(
          random.b,
          q,
          1e-14,
          [&](const Vector &candidate) {
            Scales        scales;
            Vector        residual(candidate);
            ContactForces forces;
            return certify(
                     problem, {random.b, candidate}, scales, residual, forces)
                     .worst() < 1e-13;
          },
          200);
        const double difference =
          relative_difference(q, random.solution_by_enumeration());
        if (!(difference <= worst))
          worst = difference;
      }
    check_below("projected Newton, difference from brute force", worst, 1e-10);
  }

  /** Edges that are wrong by layers of nodes move to where the asymptotics put
   * them; others stay. */
  void
  extrapolation()
  {
    // A chain of 40 nodes.
    constexpr unsigned int         n = 40;
    dealii::DynamicSparsityPattern pattern(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = i > 0 ? i - 1 : 0; j <= std::min(i + 1, n - 1); ++j)
        pattern.add(i, j);
    SparseMatrix matrix;
    matrix.reinit(pattern);
    UnilateralBounds bounds;
    for (unsigned int i = 0; i < n; ++i)
      {
        matrix.set(i, i, 2.);
        if (i > 0)
          {
            matrix.set(i, i - 1, -1.);
            matrix.set(i - 1, i, -1.);
            bounds.faces.push_back({i - 1, i});
          }
        bounds.dofs.push_back(i);
        bounds.sign.push_back(1.);
        bounds.gap.push_back(0.);
      }
    matrix.compress(dealii::VectorOperation::insert);
    const SignoriniProblem problem(matrix, bounds);
    const LipGraph         lip(problem);

    // Sets from node 0 up to, but without, another one.
    const auto up_to = [](const unsigned int end) {
      std::vector<bool> set(n, false);
      std::fill(set.begin(), set.begin() + end, true);
      return set;
    };
    const auto leads_to = [&](const unsigned int active,
                              const unsigned int plain,
                              const unsigned int expected) {
      std::vector<bool> next = up_to(plain);
      lip.extrapolate(up_to(active), next);
      return next == up_to(expected);
    };
    check("six layers leave: six more do", leads_to(30, 24, 18));
    check("nine layers enter: six do", leads_to(10, 19, 16));
    check("two layers change: no more do",
          leads_to(30, 28, 28) && leads_to(10, 12, 12));
    check("without an edge nothing is known", leads_to(0, 20, 20));

    const PlateOnPlane<2>  plate(MPI_COMM_WORLD, 400, 1);
    const SignoriniProblem on_plane(plate.matrix, plate.bounds);
    Cholesky               cholesky(plate.matrix, on_plane.all_bounded_dofs());
    CondensedSolver        solver(on_plane, cholesky, 1e-12);
    Vector                 q(plate.loads());
    q = 0.;
    std::vector<double> forces;
    solver.solve(plate.loads(), q, forces);
    check("at most 8 sets on a lip of 400 cells",
          solver.statistics().vi_iterations <= 8);
  }

  /** Calls a test with each solver, and compares the solutions. */
  template <int dim>
  void
  compare_solvers(const PlateOnPlane<dim>                      &plate,
                  const UnilateralBounds                       &bounds,
                  const std::function<Vector(ContactSolver &)> &solution_of)
  {
    const SignoriniProblem problem(plate.matrix, bounds);
    Cholesky               cholesky(plate.matrix, problem.all_bounded_dofs());
    Mumps                  mumps(plate.matrix, problem.all_bounded_dofs());
    AmgCg                  amg(plate.matrix,
              rigid_modes(plate.space),
              dim,
              plate.space.finite_element.degree > 1);
    const double           tolerance = 1e-12;

    Solvers solvers;
    if (bounds.dofs.empty())
      {
        solvers["no contact, AMG"] =
          std::make_unique<NoContact>(problem, amg, tolerance);
        solvers["no contact, Cholesky"] =
          std::make_unique<NoContact>(problem, cholesky, tolerance);
        solvers["no contact, MUMPS"] =
          std::make_unique<NoContact>(problem, mumps, tolerance);
      }
    else
      {
        solvers["condensed active set, Cholesky"] =
          std::make_unique<CondensedSolver>(problem, cholesky, tolerance);
        solvers["condensed active set, MUMPS"] =
          std::make_unique<CondensedSolver>(problem, mumps, tolerance);
      }
    solvers["active set, Cholesky"] =
      std::make_unique<ActiveSet>(problem, cholesky, tolerance, 1e-3, 100);
    solvers["active set, AMG"] =
      std::make_unique<ActiveSet>(problem, amg, tolerance, 1e-3, 100);
    solvers["projected SOR"] =
      std::make_unique<ProjectedSor>(problem, 1.9, tolerance, 100000);

    const Vector reference = solution_of(*solvers["projected SOR"]);
    double       worst     = 0.;
    for (auto &[name, solver] : solvers)
      {
        const double difference =
          relative_difference(solution_of(*solver), reference);
        if (!(difference <= 1e-10))
          check(name + " agrees", false);
        worst = std::max(worst, difference);
      }
    check_below("largest difference between solvers", worst, 1e-10);
  }

  unsigned int
  n_closed(const UnilateralBounds &bounds, const Vector &q)
  {
    unsigned int n = 0;
    for (unsigned int k = 0; k < bounds.dofs.size(); ++k)
      n += bounds.sign[k] * q(bounds.dofs[k]) <= bounds.gap[k] ? 1 : 0;
    return n;
  }

  template <int dim>
  void
  plates(const unsigned int degree, const bool hanging_nodes)
  {
    const PlateOnPlane<dim> plate(MPI_COMM_WORLD,
                                  dim == 2 ? 20 : 10,
                                  degree,
                                  hanging_nodes);
    const Vector            loads = plate.loads();
    const auto solve = [&](ContactSolver &solver, const Vector &b, Vector &q) {
      std::vector<double> forces;
      solver.solve(b, q, forces);
    };
    const std::string name = std::to_string(dim) + "D, plate of degree " +
                             std::to_string(degree) +
                             (hanging_nodes ? ", hanging nodes" : "");
    section(name);

    compare_solvers(plate, plate.bounds, [&](ContactSolver &solver) {
      Vector q(loads);
      q = 0.;
      solve(solver, loads, q);
      const unsigned int closed = n_closed(plate.bounds, q);
      if (closed == 0 || closed == plate.bounds.dofs.size())
        check("the lip is closed in part", false);
      return q;
    });

    section(name + ", all nodes switch at once");
    compare_solvers(plate, plate.bounds, [&](ContactSolver &solver) {
      // A uniform pull opens the whole lip, a push closes it, warm-started.
      Vector pull(loads);
      pull = 0.;
      for (const auto dof : plate.bounds.dofs)
        pull(dof) = 1.;
      Vector push(pull), q(pull);
      push *= -2.;
      q = 0.;
      Vector sum(q);
      for (unsigned int k = 0; k < 3; ++k)
        {
          solve(solver, pull, q);
          sum += q;
          if (n_closed(plate.bounds, q) != 0)
            check("the pull opens all", false);
          solve(solver, push, q);
          sum += q;
          if (n_closed(plate.bounds, q) != plate.bounds.dofs.size())
            check("the push closes all", false);
        }
      return sum;
    });

    for (const unsigned int n_nodes : {1, 0})
      {
        section(name + ", a lip of " + std::to_string(n_nodes) + " nodes");
        UnilateralBounds few;
        if (n_nodes == 1)
          {
            const unsigned int middle = plate.bounds.dofs.size() / 2;
            few.dofs                  = {plate.bounds.dofs[middle]};
            few.sign                  = {plate.bounds.sign[middle]};
            few.gap                   = {0.};
          }
        compare_solvers(plate, few, [&](ContactSolver &solver) {
          Vector q(loads), b(loads);
          q = 0.;
          solve(solver, b, q);
          b *= -1.;
          solve(solver, b, q);
          return q;
        });
      }
  }

  /** k A costs no new factor: b / k does it. */
  void
  scaled_stiffness()
  {
    const PlateOnPlane<2>  plate(MPI_COMM_WORLD, 20, 1);
    const SignoriniProblem problem(plate.matrix, plate.bounds);
    SparseMatrix           stiffer;
    stiffer.copy_from(plate.matrix);
    stiffer *= 7.;
    const SignoriniProblem stiffer_problem(stiffer, plate.bounds);
    const auto            &lip = problem.all_bounded_dofs();
    Cholesky        cholesky(plate.matrix, lip), stiffer_cholesky(stiffer, lip);
    CondensedSolver solver(problem, cholesky, 1e-12);
    CondensedSolver reference(stiffer_problem, stiffer_cholesky, 1e-12);

    const Vector        b = plate.loads();
    Vector              q(b), q_reference(b);
    std::vector<double> forces, forces_reference;
    solver.solve(b, q, forces, 7.);
    reference.solve(b, q_reference, forces_reference);
    double difference = 0., largest = 0.;
    for (unsigned int k = 0; k < forces.size(); ++k)
      {
        difference =
          std::max(difference, std::abs(forces[k] - forces_reference[k]));
        largest = std::max(largest, std::abs(forces[k]));
      }
    section("stiffness factor");
    check_below("displacement", relative_difference(q, q_reference), 1e-12);
    check_below("forces", difference / largest, 1e-12);
  }
} // namespace

void
contact_solvers()
{
  for (const double scale : {1., 1e12, 1e-12})
    random_problems(scale);
  section("other methods");
  cycling_problems();
  projected_newton_alone();
  extrapolation();
  for (const unsigned int degree : {1, 2})
    for (const bool hanging_nodes : {false, true})
      plates<2>(degree, hanging_nodes);
  for (const bool hanging_nodes : {false, true})
    plates<3>(1, hanging_nodes);
  scaled_stiffness();
}
