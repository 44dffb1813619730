// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Solvers of contact problems on the same matrices, in one process and one run:
// a plate whose lower edge lifts off a plane in parts, and with the argument
// "lips" off another plate, Q1 and Q2, from 10³ to 10⁶ unknowns, from zero
// (cold), from the solution under a slightly different load (warm), and where a
// pull opens the whole lip (open, warm too). Prints one table as Markdown;
// doc/contact_solvers.md has one with the machine that it was run on.
//
//     contact_duel [largest number of unknowns [seconds after which a solver
//     does not go on to larger problems [what the solver's name contains
//     [lips]]]]

#include <crevasse/contact/certificate.h>
#include <crevasse/discretisation/rigid_modes.h>
#include <crevasse/linear/amg_cg.h>
#include <crevasse/linear/cholesky.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <competitor.h>
#include <crevasse_tests/plate_on_plane.h>
#include <cstdio>
#include <cstdlib>
#include <limits>

using namespace Crevasse;

namespace
{
  /** The mean time of a back-solve, of several. */
  double
  seconds_of_back_solve(LinearSolver &solver, const Vector &b)
  {
    constexpr unsigned int n = 20;
    Vector                 q(b);
    solver.solve(q, b, 0.);
    const dealii::Timer timer;
    for (unsigned int k = 0; k < n; ++k)
      solver.solve(q, b, 0.);
    return timer.wall_time() / n;
  }

  struct Measurement
  {
    double       seconds;
    unsigned int iterations;
    double       certificate;
    double       difference; ///< from the first competitor's solution
  };

  Measurement
  measure(Competitor             &competitor,
          const SignoriniProblem &problem,
          const Vector           &b,
          Vector                 &q,
          Vector                 &reference)
  {
    const dealii::Timer timer;
    const unsigned int  iterations = competitor.solve(b, q);
    const double        seconds    = timer.wall_time();

    Scales              scales;
    Vector              residual(q);
    std::vector<double> forces;
    const Certificate   certificate =
      certify(problem, b, q, scales, residual, forces);
    if (reference.size() == 0)
      reference = q;
    Vector difference(q);
    difference -= reference;
    return {seconds,
            iterations,
            certificate.worst(),
            difference.linfty_norm() / reference.linfty_norm()};
  }

  void
  print(const Competitor  &competitor,
        const char        *start,
        const Measurement &m,
        const double       back_solve)
  {
    std::printf("| %-36s | %-4s | %9.4f | %5u | %8.1e | %8.1e | %8.1f |\n",
                competitor.name.c_str(),
                start,
                m.seconds,
                m.iterations,
                m.certificate,
                m.difference,
                m.seconds / back_solve);
    std::fflush(stdout);
  }

  /** Two plates, each clamped at both ends, one on the other: the unknowns with
   * bounds are the openings between two lips. */
  class PlateOnPlate : public ContactBody<2>
  {
  public:
    /** @param n numbers of cells along the lips, a multiple of 5. */
    PlateOnPlate(const unsigned int n, const unsigned int degree)
      : ContactBody<2>(mesh(n),
                       degree,
                       roles(),
                       {},
                       VolumetricStrain::full,
                       "0; 10*cos(5*pi*x)")
    {
      assemble_stiffness(space,
                         points,
                         PointValues<VoigtMatrix<2>>(
                           isotropic_stiffness<2>(13000., 0.2, true)),
                         matrix);
    }

    SparseMatrix matrix;

  private:
    static BoundaryRoles
    roles()
    {
      BoundaryRoles roles;
      roles.clamped = {0, 1};
      roles.crack   = {2};
      roles.loaded  = {3};
      return roles;
    }

    static std::shared_ptr<const Mesh<2>>
    mesh(const unsigned int n)
    {
      dealii::Triangulation<2> upper, lower;
      for (const auto &[part, height] :
           {std::make_pair(&upper, 0.1), std::make_pair(&lower, -0.1)})
        dealii::GridGenerator::subdivided_hyper_rectangle(
          *part,
          {n, n / 10},
          dealii::Point<2>(0., std::min(height, 0.)),
          dealii::Point<2>(1., std::max(height, 0.)));
      auto both = std::make_shared<Mesh<2>>(MPI_COMM_WORLD);
      dealii::GridGenerator::merge_triangulations(upper, lower, *both, 0.);
      for (const auto &face : both->active_face_iterators())
        if (face->at_boundary())
          {
            const auto [x, y] = std::pair(face->center()[0], face->center()[1]);
            face->set_boundary_id(x < 1e-9                   ? 0
                                  : x > 1. - 1e-9            ? 1
                                  : std::abs(y) < 1e-9       ? 2
                                  : std::abs(y - 0.1) < 1e-9 ? 3
                                                             : 4);
          }
      return both;
    }
  };

  template <class Body>
  void
  duel(const Body        &plate,
       const unsigned int degree,
       const double       longest,
       Competitors       &competitors)
  {
    const SignoriniProblem    problem(plate.matrix, plate.bounds);
    const std::vector<Vector> modes    = rigid_modes(plate.space);
    const Vector              b        = plate.loads();
    const Vector              b_before = plate.loads("0; 10*cos(5*pi*x) + 0.2");
    const Vector              b_pull   = plate.loads("0; 10");
    const Vector              b_open   = plate.loads("0; 10.1");

    double back_solve, factor_seconds;
    {
      const dealii::Timer timer;
      Cholesky            cholesky(plate.matrix);
      factor_seconds = timer.wall_time();
      back_solve     = seconds_of_back_solve(cholesky, b);
    }
    const dealii::Timer timer;
    AmgCg               amg(plate.matrix, modes, 2, degree > 1);
    const double        setup_seconds = timer.wall_time();
    Vector              q(b);
    q = 0.;
    amg.solve(q, b, 1e-8 * b.l2_norm());
    std::printf(
      "\nQ%u, %u unknowns, %zu contact nodes; CHOLMOD: factor %.3f s, "
      "back-solve %.4f s; without contact CG with ML: set-up %.3f s, "
      "%zu iterations to 1e-8 in %.4f s\n\n",
      degree,
      static_cast<unsigned int>(problem.matrix().m()),
      plate.bounds.dofs.size(),
      factor_seconds,
      back_solve,
      setup_seconds,
      amg.n_iterations(),
      meters["linear solves"].seconds);
    std::printf(
      "| solver | start | seconds | iterations | certificate | "
      "difference | back-solves |\n|---|---|---|---|---|---|---|\n");

    Vector reference_cold, reference_warm, reference_before, reference_pull,
      reference_open;
    for (const auto &competitor : competitors)
      {
        if (competitor->has_given_up)
          continue;
        try
          {
            const dealii::Timer timer;
            competitor->prepare(problem, modes, degree);
            std::printf("| %-36s | set-up | %.4f | | | | %.1f |\n",
                        competitor->name.c_str(),
                        timer.wall_time(),
                        timer.wall_time() / back_solve);
            Vector q(b);
            q = 0.;
            const Measurement cold =
              measure(*competitor, problem, b, q, reference_cold);
            print(*competitor, "cold", cold, back_solve);
            if (cold.seconds > longest)
              {
                competitor->has_given_up = true;
                continue;
              }
            // Once under the other load, then back: what a step of time does.
            measure(*competitor, problem, b_before, q, reference_before);
            print(*competitor,
                  "warm",
                  measure(*competitor, problem, b, q, reference_warm),
                  back_solve);
            // A step of time in which the whole lip is open.
            measure(*competitor, problem, b_pull, q, reference_pull);
            print(*competitor,
                  "open",
                  measure(*competitor, problem, b_open, q, reference_open),
                  back_solve);
          }
        catch (const std::exception &error)
          {
            const std::string what(error.what());
            std::printf("| %-36s | failed: %s |\n",
                        competitor->name.c_str(),
                        what.substr(0, 100).c_str());
            competitor->has_given_up = true;
          }
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  const double      largest = argc > 1 ? std::atof(argv[1]) : 1.1e6;
  const double      longest = argc > 2 ? std::atof(argv[2]) : 60.;
  const std::string who     = argc > 3 ? argv[3] : "";
  const bool        lips    = argc > 4;
  for (const unsigned int degree : {1, 2})
    {
      Competitors competitors;
      add_our_competitors(competitors);
      add_petsc_competitors(competitors);
      add_rol_competitor(competitors);
      for (const auto &competitor : competitors)
        competitor->has_given_up =
          competitor->name.find(who) == std::string::npos;
      for (const unsigned int n : {50, 160, 500, 1580})
        if (2. * (n + 1) * (n / 5 + 1) > largest)
          continue;
        else if (lips)
          duel(PlateOnPlate(n / degree, degree), degree, longest, competitors);
        else
          duel(PlateOnPlane<2>(MPI_COMM_WORLD, n / degree, degree),
               degree,
               longest,
               competitors);
    }
}
