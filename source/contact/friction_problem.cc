// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/contact/friction_problem.h>

#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/solver_gmres.h>

#include <Teuchos_LAPACK.hpp>
#include <algorithm>
#include <cmath>
#include <set>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** The equations of states: those of Σ on the free unknowns, but where a
     * pair slides along d, the row of each tangent has d μ times that of the
     * normal, and the spring across d. */
    struct Equations
    {
      const LAPACKFullMatrix<double>            &stiffness;
      const std::vector<FrictionProblem::Pair>  &pairs;
      const std::vector<FrictionProblem::State> &states;
      const std::vector<double>                 &coefficients;
      const std::vector<bool>                   &is_free;

      /** Calls f(pair, tangent) for all tangents along which pairs slide. */
      template <typename Function>
      void
      for_each_slip(const Function &f) const
      {
        for (unsigned int i = 0; i < pairs.size(); ++i)
          for (const unsigned int c : {0, 1})
            if (states[i].kind == SlipState::slip && pairs[i].has(c))
              f(i, c);
      }

      /** Factor of the slip along tangent e in the spring's force along c. */
      double
      spring(const unsigned int i,
             const unsigned int c,
             const unsigned int e) const
      {
        const auto &d = states[i].direction;
        return states[i].spring * ((c == e ? 1. : 0.) - d[c] * d[e]);
      }

      void
      add_normal_rows(dealii::Vector<double>       &v,
                      const dealii::Vector<double> &of_all) const
      {
        for_each_slip([&](const unsigned int i, const unsigned int c) {
          v(pairs[i].tangents[c]) +=
            states[i].direction[c] * coefficients[i] * of_all(pairs[i].normal);
        });
      }

      void
      restrict_to_free(dealii::Vector<double> &v) const
      {
        for (unsigned int j = 0; j < v.size(); ++j)
          if (!is_free[j])
            v(j) = 0.;
      }

      /** In the plane, where no springs are. */
      void
      vmult(dealii::Vector<double>       &result,
            const dealii::Vector<double> &x) const
      {
        stiffness.vmult(result, x);
        add_normal_rows(result, dealii::Vector<double>(result));
        restrict_to_free(result);
      }

      /** Solves by elimination. @param A work space. @return false if the
       * equations have no unique solution. */
      bool
      solve(dealii::Vector<double> &x, std::vector<double> &A) const
      {
        std::vector<unsigned int> free, place(x.size());
        for (unsigned int j = 0; j < x.size(); ++j)
          if (is_free[j])
            {
              place[j] = free.size();
              free.push_back(j);
            }
        const std::size_t n = free.size();
        A.resize(n * n);
        for (unsigned int b = 0; b < n; ++b)
          for (unsigned int a = 0; a < n; ++a)
            A[n * b + a] = stiffness(free[a], free[b]);
        for_each_slip([&](const unsigned int i, const unsigned int c) {
          const unsigned int a      = place[pairs[i].tangents[c]];
          const double       factor = states[i].direction[c] * coefficients[i];
          for (unsigned int b = 0; b < n; ++b)
            A[n * b + a] += factor * stiffness(free[b], pairs[i].normal);
          for (const unsigned int e : {0, 1})
            if (pairs[i].has(e))
              A[n * place[pairs[i].tangents[e]] + a] += spring(i, c, e);
        });
        std::vector<double> of_free;
        for (const unsigned int j : free)
          of_free.push_back(x(j));
        std::vector<int> pivots(n);
        int              info = 0;
        Teuchos::LAPACK<int, double>().GESV(
          n, 1, A.data(), n, pivots.data(), of_free.data(), n, &info);
        for (unsigned int a = 0; a < n; ++a)
          x(free[a]) = of_free[a];
        return info == 0;
      }
    };



    struct Preconditioner
    {
      void
      vmult(dealii::Vector<double>       &result,
            const dealii::Vector<double> &x) const
      {
        result = x;
        factor.solve(result);
      }
      PrincipalFactor &factor;
    };



    /** Solves the equations of states in the plane from a first guess on.
     * @param factor of the free unknowns. @return false if it takes long. */
    bool
    solve_by_gmres(const Equations              &equations,
                   PrincipalFactor              &factor,
                   const dealii::Vector<double> &right_hand_side,
                   dealii::Vector<double>       &x)
    {
      using GMRES = SolverGMRES<dealii::Vector<double>>;
      // Elimination costs about as much.
      constexpr unsigned int most      = 15;
      const double           tolerance = 1e-15 * x.l2_norm();
      IterationNumberControl control(most, tolerance);
      GMRES(control, GMRES::AdditionalData(most + 2))
        .solve(equations, x, right_hand_side, Preconditioner{factor});
      return control.last_value() <= tolerance;
    }
  } // namespace



  FrictionProblem::FrictionProblem(const LAPACKFullMatrix<double> &stiffness,
                                   const std::vector<Pair>        &pairs)
    : ProblemOnLip(stiffness)
    , pairs(pairs)
    , states(pairs.size())
    , in_plane(std::none_of(pairs.begin(),
                            pairs.end(),
                            [](const Pair &pair) { return pair.has(1); }))
    , fixed(stiffness.m())
    , right_hand_side(stiffness.m())
  {
    unsigned int n_unknowns = 0;
    for (const Pair &pair : pairs)
      n_unknowns += 1 + pair.n_tangents();
    AssertThrow(n_unknowns == stiffness.m(),
                ExcMessage("Each unknown of the lip belongs to one pair."));
  }



  std::vector<bool>
  FrictionProblem::closed_pairs() const
  {
    std::vector<bool> closed;
    for (const State &state : states)
      closed.push_back(state.kind != SlipState::open);
    return closed;
  }



  void
  FrictionProblem::start_from(const std::vector<bool> &closed_pairs)
  {
    for (unsigned int i = 0; i < states.size(); ++i)
      states[i] = {closed_pairs[i] ? SlipState::stick : SlipState::open,
                   {},
                   0.};
  }



  void
  FrictionProblem::serialize(StateArchive &archive)
  {
    std::vector<unsigned int> kinds;
    std::vector<double>       slips;
    for (const State &state : states)
      {
        kinds.push_back(static_cast<unsigned int>(state.kind));
        slips.insert(slips.end(),
                     {state.direction[0], state.direction[1], state.spring});
      }
    archive.common(kinds);
    archive.common(slips);
    for (unsigned int i = 0; i < kinds.size(); ++i)
      states[i] = {SlipState(kinds[i]),
                   Tensor<1, 2>({slips[3 * i], slips[3 * i + 1]}),
                   slips[3 * i + 2]};
  }



  unsigned int
  FrictionProblem::solve(const LipVector &loads, LipVector &jumps)
  {
    // More sets than any problem needed: in the plane those of
    // CondensedProblem. In space directions need not recur.
    const std::size_t enough = in_plane ? 100 * (pairs.size() + 10) : 40;
    // A finer polygon was never needed, and its matrix would be large.
    constexpr unsigned int       most_directions = 16;
    std::set<std::vector<State>> seen;
    unsigned int                 n_directions = 0;
    for (unsigned int n_sets = 1, last = enough;; ++n_sets)
      {
        solve_with_states(loads, jumps);
        std::vector<State> next = next_states(loads, jumps);
        if (next == states || (in_plane && n_directions > 0))
          return n_sets;
        if (seen.insert(states).second && n_sets < last)
          {
            states = std::move(next);
            continue;
          }
        n_directions = n_directions > 0 ? 2 * n_directions : in_plane ? 2 : 4;
        if (n_directions > most_directions)
          throw NumericalError(
            "The friction of " + std::to_string(pairs.size()) +
            " pairs of nodes has no solution that could be found in " +
            std::to_string(n_sets) +
            " sets: its stiffness is too ill-conditioned, or the coefficient "
            "too large. Check the moduli of [Material] and the mesh, or lower "
            "[Boundary] Friction coefficient.");
        solve_by_lemke(loads, n_directions);
        seen.clear();
        last = n_sets + enough;
      }
  }



  bool
  FrictionProblem::fix_unknowns(std::vector<bool> &is_free)
  {
    bool has_slip = false;
    fixed         = 0.;
    for (unsigned int i = 0; i < pairs.size(); ++i)
      if (states[i].kind != SlipState::open)
        {
          const bool slides        = states[i].kind == SlipState::slip;
          is_free[pairs[i].normal] = false;
          fixed(pairs[i].normal)   = pairs[i].gap;
          for (const unsigned int c : {0, 1})
            if (pairs[i].has(c))
              {
                is_free[pairs[i].tangents[c]] = slides;
                // In space the springs need the slip itself, not the jump.
                if (!slides || !in_plane)
                  fixed(pairs[i].tangents[c]) = increment.reference[c][i];
              }
          has_slip = has_slip || (slides && increment.coefficients[i] != 0.);
        }
    return has_slip;
  }



  void
  FrictionProblem::solve_with_states(const LipVector &loads, LipVector &jumps)
  {
    std::vector<bool> is_free(loads.size(), true);
    const bool        has_slip = fix_unknowns(is_free);
    const Equations   equations{
      factor.matrix, pairs, states, increment.coefficients, is_free};
    factor.matrix.vmult(right_hand_side, fixed);
    right_hand_side.sadd(-1., loads);
    if (has_slip)
      equations.add_normal_rows(right_hand_side, LipVector(right_hand_side));
    equations.restrict_to_free(right_hand_side);
    jumps = right_hand_side;
    if (in_plane || !has_slip)
      {
        factor.choose(is_free);
        factor.solve(jumps);
      }
    if (has_slip &&
        !(in_plane &&
          solve_by_gmres(equations, factor, right_hand_side, jumps)))
      {
        jumps = right_hand_side;
        // Without a unique solution, other states follow.
        if (!equations.solve(jumps, elimination))
          jumps = 0.;
      }
    jumps += fixed;
  }
} // namespace Crevasse
