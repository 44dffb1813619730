// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// The primal-dual active set of Trilinos' optimisation package ROL. Its Krylov
// solver is preconditioned by a CHOLMOD back-solve, the best there is.

#include <crevasse/linear/cholesky.h>

#include <ROL_Algorithm.hpp>
#include <ROL_Bounds.hpp>
#include <ROL_Objective.hpp>
#include <ROL_PrimalDualActiveSetStep.hpp>
#include <ROL_StatusTest.hpp>
#include <ROL_StdVector.hpp>
#include <algorithm>
#include <competitor.h>

using Crevasse::SignoriniProblem;
using Crevasse::Vector;

namespace
{
  using RolVector = ROL::StdVector<double>;

  const std::vector<double> &
  entries(const ROL::Vector<double> &x)
  {
    return *dynamic_cast<const RolVector &>(x).getVector();
  }

  std::vector<double> &
  entries(ROL::Vector<double> &x)
  {
    return *dynamic_cast<RolVector &>(x).getVector();
  }

  /** ½qᵀAq − bᵀq. */
  class Energy : public ROL::Objective<double>
  {
  public:
    Energy(const SignoriniProblem &problem, Crevasse::LinearSolver &solver)
      : problem(problem)
      , solver(solver)
      , from(problem.diagonal())
      , to(problem.diagonal())
      , b(problem.diagonal())
    {
    }

    double
    value(const ROL::Vector<double> &x, double &) override
    {
      multiply(entries(x));
      return 0.5 * (from * to) - b * from;
    }

    void
    gradient(ROL::Vector<double>       &g,
             const ROL::Vector<double> &x,
             double &) override
    {
      multiply(entries(x));
      to -= b;
      std::copy(to.begin(), to.end(), entries(g).begin());
    }

    void
    hessVec(ROL::Vector<double>       &hv,
            const ROL::Vector<double> &v,
            const ROL::Vector<double> &,
            double &) override
    {
      multiply(entries(v));
      std::copy(to.begin(), to.end(), entries(hv).begin());
    }

    void
    precond(ROL::Vector<double>       &pv,
            const ROL::Vector<double> &v,
            const ROL::Vector<double> &,
            double &) override
    {
      std::copy(entries(v).begin(), entries(v).end(), from.begin());
      solver.precondition(to, from);
      std::copy(to.begin(), to.end(), entries(pv).begin());
    }

    void
    set_right_hand_side(const Vector &right_hand_side)
    {
      b = right_hand_side;
    }

  private:
    void
    multiply(const std::vector<double> &x)
    {
      std::copy(x.begin(), x.end(), from.begin());
      problem.stiffness.vmult(to, from);
    }

    const SignoriniProblem &problem;
    Crevasse::LinearSolver &solver;
    Vector                  from, to, b;
  };

  class Rol : public Competitor
  {
  public:
    Rol()
      : Competitor("ROL primal dual active set, CHOLMOD")
    {
    }

    void
    prepare(const SignoriniProblem &problem,
            const std::vector<Vector> &,
            const unsigned int) override
    {
      solver = std::make_unique<Crevasse::Cholesky>(problem.matrix());
      energy = std::make_unique<Energy>(problem, *solver);

      const std::size_t n     = problem.matrix().m();
      auto              lower = vector(n, -1e30), upper = vector(n, 1e30);
      for (std::size_t k = 0; k < problem.bounds.dofs.size(); ++k)
        if (problem.bounds.sign[k] > 0.)
          entries(*lower)[problem.bounds.dofs[k]] = problem.bounds.gap[k];
        else
          entries(*upper)[problem.bounds.dofs[k]] = -problem.bounds.gap[k];
      bounds = std::make_unique<ROL::Bounds<double>>(lower, upper);
    }

    unsigned int
    solve(const Vector &b, Vector &q) override
    {
      energy->set_right_hand_side(b);
      ROL::ParameterList parameters;
      auto &step = parameters.sublist("Step").sublist("Primal Dual Active Set");
      step.set("Iteration Limit", 50);
      step.set("Relative Step Tolerance", 1e-14);
      step.set("Relative Gradient Tolerance", 1e-14);
      auto &krylov = parameters.sublist("General").sublist("Krylov");
      krylov.set("Type", "Conjugate Gradients");
      krylov.set("Absolute Tolerance", 1e-12 * b.l2_norm());
      krylov.set("Relative Tolerance", 1e-12);
      krylov.set("Iteration Limit", 500);
      parameters.sublist("Status Test")
        .set("Gradient Tolerance", 1e-10 * b.l2_norm());
      parameters.sublist("Status Test").set("Step Tolerance", 1e-14);
      parameters.sublist("Status Test").set("Iteration Limit", 50);

      auto x = vector(b.size(), 0.);
      std::copy(q.begin(), q.end(), entries(*x).begin());
      ROL::Algorithm<double> algorithm(
        ROL::makePtr<ROL::PrimalDualActiveSetStep<double>>(parameters),
        ROL::makePtr<ROL::StatusTest<double>>(parameters));
      algorithm.run(*x, *energy, *bounds, false);
      std::copy(entries(*x).begin(), entries(*x).end(), q.begin());
      return algorithm.getState()->iter;
    }

  private:
    static ROL::Ptr<RolVector>
    vector(const std::size_t n, const double value)
    {
      return ROL::makePtr<RolVector>(
        ROL::makePtr<std::vector<double>>(n, value));
    }

    std::unique_ptr<Crevasse::LinearSolver> solver;
    std::unique_ptr<Energy>                 energy;
    std::unique_ptr<ROL::Bounds<double>>    bounds;
  };
} // namespace

void
add_rol_competitor(Competitors &competitors)
{
  competitors.push_back(std::make_unique<Rol>());
}
