// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// What contact costs: variational inequalities of two cycles of 40 loads, which
// close and open the lip, against single solves of CHOLMOD with the same matrix
// in its own best ordering, in alternation. All that is done for the lip is
// counted: the condensed stiffness, its factors and the sets; not the
// certificate.
//
//   ninja -C build lip_last && OMP_NUM_THREADS=1
//   build/tests/benchmarks/lip_last

#include <crevasse/contact/condensed_solver.h>
#include <crevasse/linear/cholesky.h>
#include <crevasse/linear/matrix_operator.h>

#include <cholmod.h>
#include <crevasse_tests/plate_on_plane.h>
#include <crevasse_tests/tests.h>
#include <cstdio>
#include <utility>

using namespace Crevasse;

namespace
{
  /** CHOLMOD's factor in whichever of its orderings has the fewest entries. */
  class Reference
  {
  public:
    explicit Reference(const SparseMatrix &matrix)
    {
      cholmod_start(&common);
      const MatrixRows rows(matrix);
      cholmod_sparse   A{};
      A.nrow = A.ncol = rows.n;
      A.nzmax         = rows.starts[rows.n];
      A.p             = rows.starts;
      A.i             = rows.columns;
      A.x             = rows.values;
      A.stype = A.sorted = A.packed = 1;
      A.itype                       = CHOLMOD_INT;
      A.xtype                       = CHOLMOD_REAL;
      A.dtype                       = CHOLMOD_DOUBLE;
      common.nmethods               = 3;
      common.method[0].ordering     = CHOLMOD_AMD;
      common.method[1].ordering     = CHOLMOD_METIS;
      common.method[2].ordering     = CHOLMOD_NESDIS;
      L                             = cholmod_analyze(&A, &common);
      n_entries                     = common.lnz;
      cholmod_factorize(&A, L, &common);
    }

    ~Reference()
    {
      for (cholmod_dense **vector : {&x, &work_1, &work_2})
        cholmod_free_dense(vector, &common);
      cholmod_free_factor(&L, &common);
      cholmod_finish(&common);
    }

    void
    solve(const Vector &right_hand_side)
    {
      cholmod_dense b{};
      b.nrow = b.d = b.nzmax = L->n;
      b.ncol                 = 1;
      b.x                    = const_cast<double *>(right_hand_side.begin());
      b.xtype                = CHOLMOD_REAL;
      b.dtype                = CHOLMOD_DOUBLE;
      cholmod_solve2(
        CHOLMOD_A, L, &b, nullptr, &x, nullptr, &work_1, &work_2, &common);
    }

    double n_entries;

  private:
    cholmod_common  common;
    cholmod_factor *L;
    cholmod_dense  *x = nullptr, *work_1 = nullptr, *work_2 = nullptr;
  };



  /** Without the certificate. */
  class Uncertified : public CondensedSolver
  {
  public:
    using CondensedSolver::CondensedSolver;
    using CondensedSolver::iterate;
  };



  void
  measure(const unsigned int n_along,
          const unsigned int n_across,
          const unsigned int degree)
  {
    const PlateOnPlane<2> plate(
      MPI_COMM_WORLD, n_along, degree, false, n_across);
    const SignoriniProblem problem(plate.matrix, plate.bounds);
    Reference              reference(plate.matrix);
    Cholesky               cholesky(plate.matrix, problem.all_bounded_dofs());

    const Vector waves = plate.loads(), pull = plate.loads("0; 10");
    Vector       b(waves), q(waves);

    double        of_reference = 0., of_inequalities = 0.;
    std::size_t   n_sets = 0, most_closed = 0, fewest_closed = -1;
    dealii::Timer timer;
    Uncertified   contact(problem, cholesky, 1e-12);
    const double  set_up = timer.wall_time();
    of_inequalities += set_up;
    constexpr unsigned int n_steps = 40, n_solves = 2 * n_steps;
    for (unsigned int k = 0; k < n_solves; ++k)
      {
        b = waves;
        b.add(1.1 * std::sin(2. * M_PI * k / n_steps), pull);
        timer.restart();
        reference.solve(b);
        of_reference += timer.wall_time();
        timer.restart();
        n_sets += contact.iterate(b, q);
        of_inequalities += timer.wall_time();
        std::size_t n_closed = 0;
        for (std::size_t i = 0; i < plate.bounds.dofs.size(); ++i)
          n_closed += q(plate.bounds.dofs[i]) == 0. ? 1 : 0;
        most_closed   = std::max(most_closed, n_closed);
        fewest_closed = std::min(fewest_closed, n_closed);
      }
    std::printf(
      "Q%u  %8u  %5zu  %4zu..%4zu  %4.1f  %8.2f  %8.2f  %7.2f  %5.2f "
      " %5.2f\n",
      degree,
      unsigned(plate.matrix.m()),
      plate.bounds.dofs.size(),
      fewest_closed,
      most_closed,
      double(n_sets) / n_solves,
      1e3 * of_reference / n_solves,
      1e3 * of_inequalities / n_solves,
      1e3 * set_up,
      of_inequalities / of_reference,
      std::stod(
        cholesky.description().substr(cholesky.description().find(", ") + 2)) /
        reference.n_entries);
    std::fflush(stdout);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::printf(
    "    unknowns  lip  closed  sets  CHOLMOD, ms  VI, ms  set-up, ms "
    " ratio  entries' ratio\n");
  constexpr unsigned int cases[][3] = {{100, 500, 1},
                                       {500, 100, 1},
                                       {50, 250, 2},
                                       {250, 50, 2},
                                       {1000, 50, 1},
                                       {100, 5000, 1},
                                       {1000, 500, 1},
                                       {3000, 166, 1},
                                       {500, 250, 2},
                                       {1500, 83, 2}};
  for (const auto &[along, across, degree] : cases)
    if (argc == 1 || along * across * degree * degree < 100000)
      measure(along, across, degree);
}
