// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// PETSc's solvers of variational inequalities, given the same A, b and bounds.

#include <deal.II/lac/exceptions.h>

#include <Epetra_CrsMatrix.h>
#include <competitor.h>
#include <petscsnes.h>
#include <petsctao.h>
#include <string>
#include <vector>

using Crevasse::SignoriniProblem;
using Crevasse::Vector;

namespace
{
  /** Relative to the load: what the program's own certificates reach. */
  constexpr double residual_tolerance = 1e-10;

  void
  require(const PetscErrorCode error)
  {
    AssertThrow(error == 0, dealii::ExcPETScError(error));
  }

  /** A, b and the bounds as PETSc's objects; F = A q − b, the energy, and their
   * derivatives as its callbacks. */
  struct Problem
  {
    explicit Problem(const SignoriniProblem &problem)
    {
      const Epetra_CrsMatrix &epetra = problem.matrix().trilinos_matrix();
      int                    *starts, *columns;
      double                 *values;
      epetra.ExtractCrsDataPointers(starts, columns, values);
      const PetscInt n = problem.matrix().m();
      // Some of PETSc's solvers scale the matrix that they are given.
      Mat view;
      require(MatCreateSeqAIJWithArrays(
        PETSC_COMM_SELF, n, n, starts, columns, values, &view));
      require(MatDuplicate(view, MAT_COPY_VALUES, &A));
      require(MatDestroy(&view));
      require(MatSetOption(A, MAT_SPD, PETSC_TRUE));
      require(MatSetBlockSize(A, n % 2 == 0 ? 2 : 1));
      require(MatDuplicate(A, MAT_COPY_VALUES, &J));
      require(MatCreateVecs(A, &b, &lower));
      require(VecDuplicate(b, &upper));
      require(VecDuplicate(b, &residual));
      require(VecSet(lower, PETSC_NINFINITY));
      require(VecSet(upper, PETSC_INFINITY));
      for (std::size_t k = 0; k < problem.bounds.dofs.size(); ++k)
        if (problem.bounds.sign[k] > 0.)
          require(VecSetValue(lower,
                              problem.bounds.dofs[k],
                              problem.bounds.gap[k],
                              INSERT_VALUES));
        else
          require(VecSetValue(upper,
                              problem.bounds.dofs[k],
                              -problem.bounds.gap[k],
                              INSERT_VALUES));
    }

    ~Problem()
    {
      MatDestroy(&A);
      MatDestroy(&J);
      for (Vec *vector : {&b, &lower, &upper, &residual})
        VecDestroy(vector);
    }

    static void
    copy(const Vector &from, Vec to)
    {
      double *array;
      require(VecGetArray(to, &array));
      std::copy(from.begin(), from.end(), array);
      require(VecRestoreArray(to, &array));
    }

    static void
    copy(Vec from, Vector &to)
    {
      const double *array;
      require(VecGetArrayRead(from, &array));
      std::copy(array, array + to.size(), to.begin());
      require(VecRestoreArrayRead(from, &array));
    }

    static PetscErrorCode
    function(SNES, Vec x, Vec f, void *self)
    {
      const auto *problem = static_cast<Problem *>(self);
      MatMult(problem->A, x, f);
      VecAXPY(f, -1., problem->b);
      return 0;
    }

    static PetscErrorCode
    jacobian(SNES, Vec, Mat J, Mat, void *self)
    {
      return MatCopy(static_cast<Problem *>(self)->A, J, SAME_NONZERO_PATTERN);
    }

    static PetscErrorCode
    energy_and_gradient(Tao, Vec x, PetscReal *energy, Vec g, void *self)
    {
      const auto *problem = static_cast<Problem *>(self);
      MatMult(problem->A, x, g);
      PetscScalar xAx, bx;
      VecDot(x, g, &xAx);
      VecDot(problem->b, x, &bx);
      *energy = 0.5 * xAx - bx;
      VecAXPY(g, -1., problem->b);
      return 0;
    }

    static PetscErrorCode
    hessian(Tao, Vec, Mat, Mat, void *)
    {
      return 0; // constant
    }

    Mat A;
    Mat J; ///< what solvers are given as Jacobian
    Vec b, lower, upper, residual;
  };

  /** What SNES and TAO have in common: from Crevasse's vectors to PETSc's and
   * back. */
  class PetscCompetitor : public Competitor
  {
  public:
    using Competitor::Competitor;

    void
    prepare(const SignoriniProblem &contact_problem,
            const std::vector<Vector> &,
            const unsigned int) override
    {
      problem = std::make_unique<Problem>(contact_problem);
      set_up();
    }

    unsigned int
    solve(const Vector &b, Vector &q) override
    {
      Vec x;
      require(VecDuplicate(problem->b, &x));
      Problem::copy(b, problem->b);
      Problem::copy(q, x);
      const unsigned int n = solve(x, residual_tolerance * b.l2_norm());
      Problem::copy(x, q);
      require(VecDestroy(&x));
      return n;
    }

  protected:
    virtual void
    set_up() = 0;

    virtual unsigned int
    solve(Vec x, const double residual) = 0;

    std::unique_ptr<Problem> problem;
  };

  class Snes : public PetscCompetitor
  {
  public:
    Snes(const std::string &name, const SNESType type, const bool amg)
      : PetscCompetitor(name)
      , type(type)
      , amg(amg)
    {
    }

    ~Snes() override
    {
      SNESDestroy(&snes);
    }

  protected:
    void
    set_up() override
    {
      require(SNESDestroy(&snes));
      require(SNESCreate(PETSC_COMM_SELF, &snes));
      require(SNESSetType(snes, type));
      require(SNESSetFunction(
        snes, problem->residual, Problem::function, problem.get()));
      require(SNESSetJacobian(
        snes, problem->J, problem->J, Problem::jacobian, problem.get()));
      require(SNESVISetVariableBounds(snes, problem->lower, problem->upper));
      // The semismooth method's matrix is not symmetric.
      const bool reduced = std::string(type) == SNESVINEWTONRSLS;
      KSP        ksp;
      PC         pc;
      require(SNESGetKSP(snes, &ksp));
      require(KSPGetPC(ksp, &pc));
      if (reduced)
        {
          SNESLineSearch line_search;
          require(SNESGetLineSearch(snes, &line_search));
          require(SNESLineSearchSetType(line_search, SNESLINESEARCHBASIC));
        }
      if (amg)
        {
          require(KSPSetType(ksp, reduced ? KSPCG : KSPGMRES));
          require(PCSetType(pc, PCHYPRE));
          require(PCHYPRESetType(pc, "boomeramg"));
          require(
            KSPSetTolerances(ksp, 1e-8, PETSC_DEFAULT, PETSC_DEFAULT, 500));
        }
      else
        {
          require(KSPSetType(ksp, KSPPREONLY));
          require(PCSetType(pc, reduced ? PCCHOLESKY : PCLU));
          require(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
        }
    }

    unsigned int
    solve(Vec x, const double residual) override
    {
      // By the residual alone, as TAO below. The semismooth method needs few
      // iterations or does not converge.
      require(SNESSetTolerances(snes, residual, 0., 0., 50, 100000));
      require(SNESSolve(snes, nullptr, x));
      PetscInt iterations;
      require(SNESGetIterationNumber(snes, &iterations));
      return iterations;
    }

  private:
    const SNESType type;
    const bool     amg;
    SNES           snes = nullptr;
  };

  class TaoCompetitor : public PetscCompetitor
  {
  public:
    TaoCompetitor(const std::string &name,
                  const TaoType      type,
                  const unsigned int maximum_iterations)
      : PetscCompetitor(name)
      , type(type)
      , maximum_iterations(maximum_iterations)
    {
    }

    ~TaoCompetitor() override
    {
      TaoDestroy(&tao);
    }

  protected:
    void
    set_up() override
    {
      require(TaoDestroy(&tao));
      require(TaoCreate(PETSC_COMM_SELF, &tao));
      require(TaoSetType(tao, type));
      require(TaoSetObjectiveAndGradient(
        tao, nullptr, Problem::energy_and_gradient, problem.get()));
      require(TaoSetHessian(
        tao, problem->J, problem->J, Problem::hessian, problem.get()));
      require(TaoSetVariableBounds(tao, problem->lower, problem->upper));
      require(TaoSetMaximumIterations(tao, maximum_iterations));
    }

    unsigned int
    solve(Vec x, const double residual) override
    {
      require(TaoSetTolerances(tao, residual, 0., 0.));
      require(TaoSetSolution(tao, x));
      require(TaoSolve(tao));
      PetscInt iterations;
      require(TaoGetIterationNumber(tao, &iterations));
      return iterations;
    }

  private:
    const TaoType      type;
    const unsigned int maximum_iterations;
    Tao                tao = nullptr;
  };
} // namespace

void
add_petsc_competitors(Competitors &competitors)
{
  // An error becomes an exception, without a page of output.
  require(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
  competitors.push_back(
    std::make_unique<Snes>("SNESVI rsls, MUMPS", SNESVINEWTONRSLS, false));
  competitors.push_back(std::make_unique<Snes>("SNESVI rsls, CG + BoomerAMG",
                                               SNESVINEWTONRSLS,
                                               true));
  competitors.push_back(
    std::make_unique<Snes>("SNESVI ssls, MUMPS", SNESVINEWTONSSLS, false));
  competitors.push_back(std::make_unique<Snes>("SNESVI ssls, GMRES + BoomerAMG",
                                               SNESVINEWTONSSLS,
                                               true));
  competitors.push_back(
    std::make_unique<TaoCompetitor>("TAO bnls", TAOBNLS, 2000));
  competitors.push_back(
    std::make_unique<TaoCompetitor>("TAO tron", TAOTRON, 2000));
  competitors.push_back(
    std::make_unique<TaoCompetitor>("TAO gpcg", TAOGPCG, 2000));
  // Its own criterion is not met by rounding; the error says what it reached.
  competitors.push_back(
    std::make_unique<TaoCompetitor>("TAO bqpip", TAOBQPIP, 50));
}
