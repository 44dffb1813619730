// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Conjugate gradients with matrix-free geometric multigrid, and with ML
// on the assembled one: iterations, time and memory for a cracked block.
//
//     multigrid_study iterations gmg|ml [LARGEST]
//     multigrid_study DIMENSION DEGREE UNIFORM TIP JUMP gmg|ml
//     [contact|ACCURACY]
//
// The first prints the iterations for blocks of up to LARGEST unknowns as
// Markdown; the second the row of one block, with the peak memory of its
// process. Both are in doc/scaling.md. With "contact" the lip closes in part;
// with an ACCURACY the residual is reduced by so much instead of by 1e8.

#include <crevasse/contact/active_set.h>
#include <crevasse/discretisation/rigid_modes.h>
#include <crevasse/discretisation/stiffness.h>
#include <crevasse/linear/amg_cg.h>
#include <crevasse/linear/gmg_cg.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>
#include <deal.II/base/utilities.h>

#include <crevasse_tests/cracked_block.h>
#include <cstdio>
#include <cstdlib>

using namespace Crevasse;

namespace
{
  constexpr double usual_accuracy = 1e-8;

  struct Measurement
  {
    double      unknowns, bytes;
    double      set_up, solve, contact = 0.; ///< seconds
    double      imbalance = 1.;              ///< of a V-cycle's work
    std::size_t iterations, contact_iterations = 0, sets = 0;
  };

  /** A solver with everything that it needs besides the block. */
  template <int dim>
  struct Solver
  {
    Solver(const CrackedBlock<dim> &block, const bool with_ml)
    {
      if (with_ml)
        {
          assemble_stiffness(block.space,
                             block.points,
                             block.stiffness,
                             matrix);
          linear =
            std::make_unique<AmgCg>(matrix,
                                    rigid_modes(block.space),
                                    dim,
                                    block.space.finite_element.degree > 1);
          problem = std::make_unique<SignoriniProblem>(matrix, block.bounds);
          return;
        }
      stiffness = std::make_unique<StiffnessOperator<dim>>(block.space,
                                                           block.points,
                                                           block.stiffness);
      levels =
        std::make_shared<MultigridLevels<dim>>(block.space, block.points);
      linear  = std::make_unique<GmgCg<dim>>(levels,
                                            *stiffness,
                                            block.stiffness,
                                            block.bounds.dofs);
      problem = std::make_unique<SignoriniProblem>(*stiffness, block.bounds);
    }

    double
    bytes() const
    {
      return linear->memory_consumption() +
             (stiffness == nullptr ? matrix.memory_consumption()
                                   : stiffness->memory_consumption() +
                                       levels->memory_consumption());
    }

    /** One level waits for the other: the cells of the rank that has most, of
     * all levels that are smoothed, against an equal share. */
    double
    imbalance() const
    {
      if (levels == nullptr)
        return 1.;
      double most = 0., all = 0.;
      for (unsigned int level = 1; level < levels->n_levels(); ++level)
        {
          const Mesh<dim> &mesh = levels->space(level).mesh();
          most += dealii::Utilities::MPI::max(
            double(mesh.n_locally_owned_active_cells()), MPI_COMM_WORLD);
          all += mesh.n_global_active_cells();
        }
      return most * dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) /
             all;
    }

    SparseMatrix                            matrix;
    std::shared_ptr<MultigridLevels<dim>>   levels;
    std::unique_ptr<StiffnessOperator<dim>> stiffness;
    std::unique_ptr<LinearSolver>           linear;
    std::unique_ptr<SignoriniProblem>       problem;
  };

  template <int dim>
  Measurement
  measure(const BlockKind &kind,
          const bool       with_ml,
          const double     accuracy,
          const bool       with_contact)
  {
    const CrackedBlock<dim> block(MPI_COMM_WORLD, kind);
    const Vector            b = block.loads();
    Measurement             result;
    result.unknowns = block.space.n_unknowns();

    dealii::Timer timer;
    Solver<dim>   solver(block, with_ml);
    result.set_up = timer.wall_time();
    result.bytes = dealii::Utilities::MPI::sum(solver.bytes(), MPI_COMM_WORLD) /
                   result.unknowns;
    result.imbalance = solver.imbalance();

    Vector q(b);
    q = 0.;
    timer.restart();
    solver.linear->solve(q, b, accuracy * b.l2_norm());
    result.solve      = timer.wall_time();
    result.iterations = solver.linear->n_iterations();

    if (!with_contact)
      return result;
    ActiveSet contact(
      *solver.problem, *solver.linear, usual_accuracy, 1e-3, 100);
    std::vector<double> forces;
    timer.restart();
    contact.solve(b, q, forces);
    result.contact            = timer.wall_time();
    result.contact_iterations = contact.statistics().linear_iterations;
    result.sets               = contact.statistics().vi_iterations;
    return result;
  }

  Measurement
  measure(const unsigned int dim,
          const BlockKind   &kind,
          const bool         with_ml,
          const double       accuracy,
          const bool         with_contact)
  {
    const auto of_dimension = dim == 2 ? measure<2> : measure<3>;
    return of_dimension(kind, with_ml, accuracy, with_contact);
  }

  void
  print(const unsigned int dim,
        const BlockKind   &kind,
        const char        *name,
        const Measurement &m)
  {
    dealii::Utilities::System::MemoryStats memory;
    dealii::Utilities::System::get_memory_stats(memory);
    const double peak =
      dealii::Utilities::MPI::sum(memory.VmHWM * 1e-3, MPI_COMM_WORLD);
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) > 0)
      return;
    std::printf("| %uD Q%u, %u + %u, %g | %.0f | %s | %.2f | %zu | %.2f |",
                dim,
                kind.degree,
                kind.n_uniform,
                kind.n_tip,
                kind.jump,
                m.unknowns,
                name,
                m.set_up,
                m.iterations,
                m.solve);
    if (m.sets > 0)
      std::printf(" %zu in %zu sets | %.2f |",
                  m.contact_iterations,
                  m.sets,
                  m.contact);
    std::printf(" %.0f | %.0f | %.3f |\n", m.bytes, peak, m.imbalance);
  }

  /** Of the lattice of nodes, without what is refined at the tip. */
  double
  unknowns_of(const unsigned int dim, const BlockKind &kind)
  {
    const double nodes = kind.degree * std::pow(2., kind.n_uniform + 1) + 1.;
    return dim * std::pow(nodes, dim);
  }

  /** A line of blocks, finer and finer. */
  void
  print_iterations(const unsigned int dim,
                   const BlockKind   &kind,
                   const bool         at_tip,
                   const bool         with_ml,
                   const double       most_unknowns)
  {
    std::printf(
      "| %uD Q%u%s | %g |", dim, kind.degree, at_tip ? ", tip" : "", kind.jump);
    for (BlockKind finer = kind; unknowns_of(dim, finer) < most_unknowns;
         ++finer.n_uniform)
      {
        finer.n_tip = at_tip ? finer.n_uniform : 0;
        const Measurement m =
          measure(dim, finer, with_ml, usual_accuracy, false);
        std::printf(" %.0f: %zu;", m.unknowns, m.iterations);
        std::fflush(stdout);
      }
    std::printf(" |\n");
  }

  void
  print_all(const bool with_ml, const double most_unknowns)
  {
    std::printf("| element | jump | unknowns: iterations |\n|---|---|---|\n");
    for (const unsigned int dim : {2, 3})
      for (const unsigned int degree : {1, 2})
        for (const bool at_tip : {false, true})
          for (const double jump : {1., 1e2, 1e4})
            print_iterations(dim,
                             {degree,
                              (dim == 2 ? 5 : 3) - degree,
                              0,
                              jump,
                              VolumetricStrain::full},
                             at_tip,
                             with_ml,
                             most_unknowns);
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const auto number = [&](const int i) { return std::atof(argv[i]); };
  if (argc >= 3 && std::string(argv[1]) == "iterations")
    print_all(std::string(argv[2]) == "ml", argc > 3 ? number(3) : 2e6);
  else if (argc == 7 || argc == 8)
    {
      const BlockKind   kind{static_cast<unsigned int>(number(2)),
                           static_cast<unsigned int>(number(3)),
                           static_cast<unsigned int>(number(4)),
                           number(5),
                           VolumetricStrain::full};
      const std::string last         = argc == 8 ? argv[7] : "";
      const bool        with_contact = last == "contact";
      const double      accuracy =
        last.empty() || with_contact ? usual_accuracy : number(7);
      print(number(1),
            kind,
            argv[6],
            measure(number(1),
                    kind,
                    std::string(argv[6]) == "ml",
                    accuracy,
                    with_contact));
    }
  else
    {
      std::printf("See the head of multigrid_study.cc.\n");
      return 2;
    }
}
