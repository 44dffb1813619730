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
// Conjugate gradients with geometric multigrid, without a matrix, and with ML
// on the assembled one: iterations, time and memory for a cracked block.
//
//     multigrid_study iterations [largest number of unknowns]
//     multigrid_study DIMENSION DEGREE UNIFORM TIP JUMP gmg|ml
//
// The first prints tables as Markdown, those of doc/multigrid.md; the second
// one row, with the peak memory of its process.

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
  constexpr double accuracy = 1e-8;

  struct Measurement
  {
    double      unknowns, bytes;
    double      set_up, solve, contact; ///< seconds
    std::size_t iterations, contact_iterations, sets;
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
                                    block.space.finite_element().degree > 1);
          problem = std::make_unique<SignoriniProblem>(matrix, block.bounds);
          return;
        }
      stiffness = std::make_unique<StiffnessOperator<dim>>(block.space,
                                                           block.points,
                                                           block.stiffness);
      levels =
        std::make_shared<MultigridLevels<dim>>(block.space, block.points);
      linear =
        std::make_unique<GmgCg<dim>>(levels, *stiffness, block.stiffness);
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

    SparseMatrix                            matrix;
    std::shared_ptr<MultigridLevels<dim>>   levels;
    std::unique_ptr<StiffnessOperator<dim>> stiffness;
    std::unique_ptr<LinearSolver>           linear;
    std::unique_ptr<SignoriniProblem>       problem;
  };

  template <int dim>
  Measurement
  measure(const BlockKind &kind, const bool with_ml)
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

    Vector q(b);
    q = 0.;
    timer.restart();
    solver.linear->solve(q, b, accuracy * b.l2_norm());
    result.solve      = timer.wall_time();
    result.iterations = solver.linear->n_iterations();

    ActiveSet contact(*solver.problem, *solver.linear, accuracy, 1e-3, 100);
    std::vector<double> forces;
    timer.restart();
    contact.solve(b, q, forces);
    result.contact            = timer.wall_time();
    result.contact_iterations = contact.n_linear_iterations();
    result.sets               = contact.n_iterations();
    return result;
  }

  Measurement
  measure(const unsigned int dim, const BlockKind &kind, const bool with_ml)
  {
    return dim == 2 ? measure<2>(kind, with_ml) : measure<3>(kind, with_ml);
  }

  void
  print(const BlockKind &kind, const char *name, const Measurement &m)
  {
    dealii::Utilities::System::MemoryStats memory;
    dealii::Utilities::System::get_memory_stats(memory);
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::printf(
        "| Q%u | %u | %u | %g | %.0f | %s | %.2f | %zu | %.2f | %zu "
        "in %zu sets | %.2f | %.0f | %.0f |\n",
        kind.degree,
        kind.n_uniform,
        kind.n_tip,
        kind.jump,
        m.unknowns,
        name,
        m.set_up,
        m.iterations,
        m.solve,
        m.contact_iterations,
        m.sets,
        m.contact,
        m.bytes,
        memory.VmHWM * 1e-3);
    std::fflush(stdout);
  }

  double
  cells_of(const unsigned int dim, const unsigned int n_uniform)
  {
    return std::pow(2., dim * (n_uniform + 1.));
  }

  void
  print_all(const double most_unknowns)
  {
    for (const unsigned int dim : {2, 3})
      {
        std::printf(
          "\n%uD\n\n| element | refinements | at the tip | jump | "
          "unknowns | solver | set-up s | iterations | s | with "
          "contact | s | bytes per unknown | peak MB |\n"
          "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
          dim);
        for (const unsigned int degree : {1, 2})
          for (const double jump : {1., 1e2, 1e4})
            for (const bool tip : {false, true})
              for (unsigned int n = (dim == 2 ? 4 : 2) - (degree - 1);
                   cells_of(dim, n) * std::pow(degree, dim) * dim <
                   most_unknowns;
                   ++n)
                for (const bool with_ml : {false, true})
                  {
                    const BlockKind kind{
                      degree, n, tip ? n : 0, jump, VolumetricStrain::full};
                    print(kind,
                          with_ml ? "ml" : "gmg",
                          measure(dim, kind, with_ml));
                  }
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const auto number = [&](const int i) { return std::atof(argv[i]); };
  if (argc >= 2 && std::string(argv[1]) == "iterations")
    print_all(argc > 2 ? number(2) : 2e6);
  else if (argc == 7)
    {
      const BlockKind kind{static_cast<unsigned int>(number(2)),
                           static_cast<unsigned int>(number(3)),
                           static_cast<unsigned int>(number(4)),
                           number(5),
                           VolumetricStrain::full};
      print(kind,
            argv[6],
            measure(number(1), kind, std::string(argv[6]) == "ml"));
    }
  else
    {
      std::printf("See the head of multigrid_study.cc.\n");
      return 2;
    }
}
