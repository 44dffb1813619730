// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/contact/active_set.h>
#include <crevasse/contact/condensed_solver.h>
#include <crevasse/contact/projected_sor.h>
#include <crevasse/linear/amg_cg.h>
#include <crevasse/linear/cholesky.h>

#include <competitor.h>
#include <functional>

using namespace Crevasse;

namespace
{
  constexpr double tolerance = 1e-12;

  /** One of the program's own contact solvers with a linear solver. */
  class Ours : public Competitor
  {
  public:
    using MakeLinear =
      std::function<std::unique_ptr<LinearSolver>(const SignoriniProblem &,
                                                  const std::vector<Vector> &,
                                                  const unsigned int)>;
    using MakeContact =
      std::function<std::unique_ptr<ContactSolver>(const SignoriniProblem &,
                                                   LinearSolver *)>;

    Ours(const std::string &name,
         const MakeLinear  &make_linear,
         const MakeContact &make_contact)
      : Competitor(name)
      , make_linear(make_linear)
      , make_contact(make_contact)
    {
    }

    void
    prepare(const SignoriniProblem    &problem,
            const std::vector<Vector> &modes,
            const unsigned int         degree) override
    {
      contact.reset();
      linear  = make_linear(problem, modes, degree);
      contact = make_contact(problem, linear.get());
    }

    unsigned int
    solve(const Vector &b, Vector &q) override
    {
      const std::size_t before = contact->statistics().vi_iterations;
      contact->solve(b, q, forces);
      return contact->statistics().vi_iterations - before;
    }

  private:
    const MakeLinear               make_linear;
    const MakeContact              make_contact;
    std::unique_ptr<LinearSolver>  linear;
    std::unique_ptr<ContactSolver> contact;
    std::vector<double>            forces;
  };
} // namespace

void
add_our_competitors(Competitors &competitors)
{
  const Ours::MakeLinear cholesky =
    [](const SignoriniProblem &problem, const auto &, const unsigned int) {
      return std::make_unique<Cholesky>(problem.matrix(),
                                        problem.all_bounded_dofs());
    };
  const Ours::MakeLinear amg = [](const SignoriniProblem    &problem,
                                  const std::vector<Vector> &modes,
                                  const unsigned int         degree) {
    return std::make_unique<AmgCg>(problem.matrix(), modes, 2, degree > 1);
  };
  const Ours::MakeLinear none =
    [](const SignoriniProblem &, const auto &, const unsigned int) {
      return std::unique_ptr<LinearSolver>();
    };
  const Ours::MakeContact active_set = [](const SignoriniProblem &problem,
                                          LinearSolver           *linear) {
    return std::make_unique<ActiveSet>(problem, *linear, tolerance, 1e-3, 1000);
  };

  competitors.push_back(std::make_unique<Ours>(
    "condensed active set, CHOLMOD",
    cholesky,
    [](const SignoriniProblem &problem, LinearSolver *linear) {
      return std::make_unique<CondensedSolver>(
        problem, dynamic_cast<DirectSolver &>(*linear), tolerance);
    }));
  competitors.push_back(
    std::make_unique<Ours>("active set, CHOLMOD", cholesky, active_set));
  competitors.push_back(
    std::make_unique<Ours>("active set, ML", amg, active_set));
  competitors.push_back(std::make_unique<Ours>(
    "projected SOR, factor 2 - 8/sqrt(n)",
    none,
    [](const SignoriniProblem &problem, LinearSolver *) {
      // The model problem's optimum is 2 − O(h); 8 is right for this plate.
      const double factor = 2. - 8. / std::sqrt(problem.matrix().m());
      return std::make_unique<ProjectedSor>(problem, factor, tolerance, 20000);
    }));
}
