// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/rigid_modes.h>
#include <crevasse/discretisation/stiffness.h>
#include <crevasse/linear/amg_cg.h>
#include <crevasse/linear/cholesky.h>
#include <crevasse/linear/gmg_cg.h>
#include <crevasse/linear/held_rows.h>
#include <crevasse/linear/mumps.h>
#include <crevasse/linear/solver_choice.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/diagonal_matrix.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/multigrid/mg_base.h>
#include <deal.II/multigrid/multigrid.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    using Vector = LinearOperator::Vector;
    using Rows   = std::vector<unsigned int>;

    void
    set_zero(const Rows &rows, Vector &vector)
    {
      for (const unsigned int row : rows)
        vector.local_element(row) = 0.;
    }



    /** Exact, but for meshes that are large before anything is refined. */
    template <int dim>
    std::unique_ptr<LinearSolver>
    make_coarsest_solver(const Space<dim>           &space,
                         const LinearSolver::Matrix &matrix)
    {
      const LinearSolverChoice choice =
        choose_matrix_solver(dim,
                             space.n_unknowns(),
                             Utilities::MPI::n_mpi_processes(
                               space.communicator()));
      if (choice.type == LinearSolverType::cholesky)
        return std::make_unique<Cholesky>(matrix);
      if (choice.type == LinearSolverType::mumps)
        return std::make_unique<Mumps>(matrix);
      return std::make_unique<AmgCg>(matrix,
                                     rigid_modes(space),
                                     dim,
                                     space.finite_element().degree > 1);
    }
  } // namespace



  /** Keeps the held unknowns of all levels zero. */
  template <int dim>
  class GmgCg<dim>::Transfer : public MGTransferBase<Vector>
  {
  public:
    explicit Transfer(const MultigridLevels<dim> &levels)
      : held(levels.n_levels())
      , levels(levels)
    {
    }

    void
    prolongate(const unsigned int to_level,
               Vector            &dst,
               const Vector      &src) const override
    {
      dst = 0.;
      prolongate_and_add(to_level, dst, src);
    }

    void
    prolongate_and_add(const unsigned int to_level,
                       Vector            &dst,
                       const Vector      &src) const override
    {
      levels.transfer(to_level).prolongate_and_add(dst, src);
      set_zero(held[to_level], dst);
    }

    void
    restrict_and_add(const unsigned int from_level,
                     Vector            &dst,
                     const Vector      &src) const override
    {
      levels.transfer(from_level).restrict_and_add(dst, src);
      set_zero(held[from_level - 1], dst);
    }

    std::vector<Rows> held; ///< of each level

  private:
    const MultigridLevels<dim> &levels;
  };



  template <int dim>
  class GmgCg<dim>::CoarseSolver : public MGCoarseGridBase<Vector>
  {
  public:
    CoarseSolver(LinearSolver &solver, const Transfer &transfer)
      : solver(solver)
      , transfer(transfer)
    {
    }

    void
    operator()(const unsigned int level,
               Vector            &dst,
               const Vector      &src) const override
    {
      solver.precondition(dst, src);
      set_zero(transfer.held[level], dst);
    }

  private:
    LinearSolver   &solver;
    const Transfer &transfer;
  };



  template <int dim>
  class GmgCg<dim>::LevelMatrices : public MGMatrixBase<Vector>
  {
  public:
    explicit LevelMatrices(GmgCg &solver)
      : solver(solver)
    {
    }

    void
    vmult(const unsigned int level,
          Vector            &dst,
          const Vector      &src) const override
    {
      solver.level_operator(level).vmult(dst, src);
    }

    void
    vmult_add(const unsigned int, Vector &, const Vector &) const override
    {
      AssertThrow(false, ExcNotImplemented());
    }

    void
    Tvmult(const unsigned int level,
           Vector            &dst,
           const Vector      &src) const override
    {
      vmult(level, dst, src);
    }

    void
    Tvmult_add(const unsigned int, Vector &, const Vector &) const override
    {
      AssertThrow(false, ExcNotImplemented());
    }

    unsigned int
    get_minlevel() const override
    {
      return 0;
    }

    unsigned int
    get_maxlevel() const override
    {
      return solver.shared_levels->n_levels() - 1;
    }

  private:
    GmgCg &solver;
  };



  /** Chebyshev polynomials (Adams et al., J. Comput. Phys. 188, 2003). */
  template <int dim>
  class GmgCg<dim>::LevelSmoothers : public MGSmootherBase<Vector>
  {
  public:
    explicit LevelSmoothers(GmgCg &solver)
    {
      // Degree, range of eigenvalues and the iterations that estimate them.
      // With degree 4 there are a quarter fewer iterations, but each costs two
      // thirds more (doc/scaling.md).
      typename Smoother::AdditionalData settings(2, 10., 12);
      for (unsigned int level = 1; level < solver.shared_levels->n_levels();
           ++level)
        {
          const Operator &A       = solver.level_operator(level);
          settings.preconditioner = std::make_shared<DiagonalMatrix<Vector>>();
          Vector &inverse         = settings.preconditioner->get_vector();
          inverse.reinit(A.diagonal());
          for (std::size_t i = 0; i < inverse.locally_owned_size(); ++i)
            inverse.local_element(i) = 1. / A.diagonal().local_element(i);
          entries += inverse.locally_owned_size();
          smoothers.push_back(std::make_unique<Smoother>());
          smoothers.back()->initialize(A, settings);
          // Now, not when the first vector comes.
          smoothers.back()->estimate_eigenvalues(inverse);
        }
    }

    void
    clear() override
    {
      smoothers.clear();
    }

    void
    smooth(const unsigned int level,
           Vector            &u,
           const Vector      &rhs) const override
    {
      smoothers[level - 1]->step(u, rhs);
    }

    void
    apply(const unsigned int level, Vector &u, const Vector &rhs) const override
    {
      smoothers[level - 1]->vmult(u, rhs);
    }

    std::size_t
    memory_consumption() const
    {
      // Of Chebyshev's iteration, with the inverse of the diagonal.
      constexpr unsigned int n_vectors = 4;
      return n_vectors * entries * sizeof(double);
    }

  private:
    using Smoother = PreconditionChebyshev<Operator, Vector>;

    std::vector<std::unique_ptr<Smoother>> smoothers;   ///< from level 1 on
    std::size_t                            entries = 0; ///< of all levels
  };



  template <int dim>
  GmgCg<dim>::GmgCg(std::shared_ptr<const MultigridLevels<dim>> levels,
                    StiffnessOperator<dim>                     &finest,
                    const PointValues<VoigtMatrix<dim>>        &stiffness)
    : shared_levels(std::move(levels))
    , finest(finest)
  {
    const MultigridLevels<dim> &of        = *shared_levels;
    const unsigned int          n_coarser = of.n_levels() - 1;
    {
      const auto values = of.on_coarser_levels(stiffness);
      for (unsigned int level = 0; level < n_coarser; ++level)
        coarser.push_back(level == 0
                            ? nullptr
                            : std::make_unique<Operator>(of.space(level),
                                                         of.points(level),
                                                         values[level]));
      assemble_stiffness(of.space(0),
                         of.points(0),
                         n_coarser == 0 ? stiffness : values[0],
                         coarsest_matrix);
    }
    coarsest_solver = make_coarsest_solver(of.space(0), coarsest_matrix);
    finest.initialize_dof_vector(layout);

    transfer      = std::make_unique<Transfer>(of);
    coarse_solver = std::make_unique<CoarseSolver>(*coarsest_solver, *transfer);
    matrices      = std::make_unique<LevelMatrices>(*this);
    smoothers     = std::make_unique<LevelSmoothers>(*this);
    cycle         = std::make_unique<Multigrid<Vector>>(*matrices,
                                                *coarse_solver,
                                                *transfer,
                                                *smoothers,
                                                *smoothers,
                                                0,
                                                n_coarser);
  }



  template <int dim>
  GmgCg<dim>::~GmgCg() = default;



  template <int dim>
  typename GmgCg<dim>::Operator &
  GmgCg<dim>::level_operator(const unsigned int level)
  {
    return level < coarser.size() ? *coarser[level] : finest;
  }



  template <int dim>
  void
  GmgCg<dim>::hold(const std::vector<types::global_dof_index> &dofs)
  {
    if (Utilities::MPI::max(dofs != held_dofs ? 1 : 0,
                            layout.get_mpi_communicator()) == 0)
      return;
    held_dofs = dofs;

    // A node of a coarser level is held if it is, as node of the finest one.
    Rows rows;
    for (const auto dof : held_dofs)
      rows.push_back(layout.get_partitioner()->global_to_local(dof));
    std::sort(rows.begin(), rows.end());
    for (unsigned int level = shared_levels->n_levels(); level-- > 0;)
      {
        transfer->held[level] = rows;
        if (level + 1 == shared_levels->n_levels())
          held_on_finest = rows;
        if (level > 0)
          rows = shared_levels->transfer(level).at_same_nodes(rows);
        if (level > 0 && level < coarser.size())
          coarser[level]->hold(transfer->held[level]);
      }
  }



  template <int dim>
  void
  GmgCg<dim>::precondition(Vector &solution, const Vector &right_hand_side)
  {
    const unsigned int finest_level = shared_levels->n_levels() - 1;
    for (unsigned int level = 0; level < finest_level; ++level)
      shared_levels->space(level).matrix_free()->initialize_dof_vector(
        cycle->defect[level]);
    finest.initialize_dof_vector(cycle->defect[finest_level]);
    cycle->defect[finest_level].copy_locally_owned_data_from(right_hand_side);
    {
      // Not for those who need all of A.
      const HeldRows<dim> during_cycle(finest, held_on_finest);
      cycle->cycle();
    }
    solution.copy_locally_owned_data_from(cycle->solution[finest_level]);
  }



  template <int dim>
  void
  GmgCg<dim>::multiply(Vector &result, const Vector &v) const
  {
    finest.vmult(result, v);
  }



  template <int dim>
  std::size_t
  GmgCg<dim>::memory_consumption() const
  {
    // Of the cycle: right-hand side, solution and residual.
    constexpr unsigned int n_cycle_vectors = 3;
    std::size_t            bytes = coarsest_matrix.memory_consumption() +
                        coarsest_solver->memory_consumption() +
                        smoothers->memory_consumption() +
                        (n_cycle_vectors + 1) * layout.memory_consumption();
    for (const auto &A : coarser)
      if (A != nullptr)
        bytes += A->memory_consumption() +
                 n_cycle_vectors * A->diagonal().memory_consumption();
    return bytes;
  }



  template <int dim>
  std::string
  GmgCg<dim>::preconditioner_description() const
  {
    const unsigned int n = shared_levels->n_levels();
    return "matrix-free geometric multigrid of " + std::to_string(n) +
           (n == 1 ? " level (a mesh without coarser ones: all is " +
                       coarsest_solver->description() + ")"
                   : " levels");
  }



  template class GmgCg<2>;
  template class GmgCg<3>;
} // namespace Crevasse
