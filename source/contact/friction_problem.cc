// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/contact/friction_problem.h>
#include <crevasse/contact/lemke.h>

#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/solver_gmres.h>

#include <cmath>
#include <limits>
#include <set>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    constexpr double rounding = 100. * std::numeric_limits<double>::epsilon();

    /** 1 where a pair slips along the tangent, −1 against it, 0 elsewhere. */
    double
    direction(const SlipState state)
    {
      return state == SlipState::forward    ? 1.
             : state == SlipState::backward ? -1.
                                            : 0.;
    }



    SlipState
    slip(const bool is_forward)
    {
      return is_forward ? SlipState::forward : SlipState::backward;
    }



    /** Largest |v_i| w_i, but not 0. */
    double
    largest(const dealii::Vector<double>          &v,
            const std::function<double(unsigned)> &w)
    {
      double size = 1e-300;
      for (unsigned int i = 0; i < v.size(); ++i)
        size = std::max(size, std::abs(v(i)) * w(i));
      return size;
    }
  } // namespace



  FrictionProblem::FrictionProblem(const LAPACKFullMatrix<double> &stiffness,
                                   const std::vector<Pair>        &pairs)
    : states(pairs.size(), SlipState::stick)
    , factor(stiffness)
    , pairs(pairs)
    , fixed(stiffness.m())
    , right_hand_side(stiffness.m())
  {
    unsigned int n_unknowns = 0;
    for (const Pair &pair : pairs)
      n_unknowns += pair.may_slide() ? 2 : 1;
    AssertThrow(n_unknowns == stiffness.m(),
                ExcMessage("Each unknown of the lip belongs to one pair."));
  }



  unsigned int
  FrictionProblem::solve(const LipVector &loads,
                         const Increment &increment,
                         LipVector       &jumps)
  {
    std::set<std::vector<SlipState>> seen;
    bool                             is_rescued = false;
    for (unsigned int n_sets = 1;; ++n_sets)
      {
        solve_with_states(loads, increment, jumps);
        std::vector<SlipState> next = next_states(loads, increment, jumps);
        if (next == states || is_rescued)
          return n_sets;
        // More sets than any problem needed: those of CondensedProblem.
        const std::size_t enough = 100 * (pairs.size() + 10);
        if (seen.insert(states).second && n_sets < enough)
          states = std::move(next);
        else
          {
            solve_by_lemke(loads, increment);
            is_rescued = true;
          }
      }
  }



  void
  FrictionProblem::solve_with_states(const LipVector &loads,
                                     const Increment &increment,
                                     LipVector       &jumps)
  {
    // A slipping pair has the row of its tangent plus s μ times that of its
    // normal; for others, the matrix on the free unknowns is that of Σ.
    struct Rows
    {
      void
      add_normal_rows(LipVector &v, const LipVector &of_all) const
      {
        for (unsigned int i = 0; i < problem.pairs.size(); ++i)
          if (const double s = direction(problem.states[i]); s != 0.)
            v(problem.pairs[i].tangent) +=
              s * increment.coefficients[i] * of_all(problem.pairs[i].normal);
      }
      void
      restrict_to_free(LipVector &v) const
      {
        for (unsigned int j = 0; j < v.size(); ++j)
          if (!is_free[j])
            v(j) = 0.;
      }
      void
      vmult(LipVector &result, const LipVector &x) const
      {
        problem.factor.matrix.vmult(result, x);
        add_normal_rows(result, LipVector(result));
        restrict_to_free(result);
      }
      const FrictionProblem   &problem;
      const Increment         &increment;
      const std::vector<bool> &is_free;
    };
    struct Preconditioner
    {
      void
      vmult(LipVector &result, const LipVector &x) const
      {
        result = x;
        factor.solve(result);
      }
      PrincipalFactor &factor;
    };

    std::vector<bool> is_free(loads.size(), true);
    bool              has_slip = false;
    fixed                      = 0.;
    for (unsigned int i = 0; i < pairs.size(); ++i)
      if (states[i] != SlipState::open)
        {
          is_free[pairs[i].normal] = false;
          fixed(pairs[i].normal)   = pairs[i].gap;
          if (states[i] == SlipState::stick && pairs[i].may_slide())
            {
              is_free[pairs[i].tangent] = false;
              fixed(pairs[i].tangent)   = increment.reference[i];
            }
          has_slip = has_slip || (states[i] != SlipState::stick &&
                                  increment.coefficients[i] != 0.);
        }
    const Rows rows{*this, increment, is_free};
    factor.matrix.vmult(right_hand_side, fixed);
    right_hand_side.sadd(-1., loads);
    if (has_slip)
      rows.add_normal_rows(right_hand_side, LipVector(right_hand_side));
    rows.restrict_to_free(right_hand_side);
    factor.choose(is_free);
    jumps = right_hand_side;
    factor.solve(jumps);
    if (has_slip)
      {
        constexpr unsigned int most = 100;
        IterationNumberControl control(most, 1e-15 * jumps.l2_norm());
        SolverGMRES<LipVector>(control,
                               SolverGMRES<LipVector>::AdditionalData(most + 2))
          .solve(rows, jumps, right_hand_side, Preconditioner{factor});
      }
    jumps += fixed;
  }



  std::vector<SlipState>
  FrictionProblem::next_states(const LipVector &loads,
                               const Increment &increment,
                               const LipVector &jumps) const
  {
    const auto  &stiffness = factor.matrix;
    const double largest   = jumps.linfty_norm();
    LipVector    forces(loads.size());
    stiffness.vmult(forces, jumps);
    forces -= loads;
    std::vector<SlipState> next = states;
    for (unsigned int i = 0; i < pairs.size(); ++i)
      {
        const unsigned int N = pairs[i].normal;
        // Without a tangent, that of an unknown which neither moves nor bears.
        const bool         slides  = pairs[i].may_slide();
        const unsigned int T       = slides ? pairs[i].tangent : N;
        const double       mu      = increment.coefficients[i];
        const double       opening = jumps(N) - pairs[i].gap;
        const double delta = slides ? jumps(T) - increment.reference[i] : 0.;
        const double force = slides ? forces(T) : 0.;
        const double noise =
          rounding * std::max(std::abs(loads(N)) + stiffness(N, N) * largest,
                              std::abs(loads(T)) + stiffness(T, T) * largest);
        if (states[i] == SlipState::open)
          {
            if (opening < -rounding * largest)
              next[i] = stiffness(T, T) * std::abs(delta) <=
                            -mu * stiffness(N, N) * opening
                          ? SlipState::stick
                          : slip(delta > 0.);
          }
        else if (forces(N) < -noise)
          next[i] = SlipState::open;
        else if (states[i] == SlipState::stick)
          {
            if (std::abs(force) > mu * std::max(forces(N), 0.) + noise)
              next[i] = slip(force < 0.);
          }
        else if (direction(states[i]) * delta < -rounding * largest)
          next[i] = SlipState::stick;
      }
    return next;
  }



  double
  FrictionProblem::violation(const LipVector &loads,
                             const Increment &increment,
                             const LipVector &jumps) const
  {
    const auto  &stiffness = factor.matrix;
    const auto   one       = [](unsigned) { return 1.; };
    const auto   diagonal  = [&](const unsigned i) { return stiffness(i, i); };
    const double force =
      std::max(largest(loads, one), largest(jumps, diagonal));
    const double jump =
      std::max(largest(jumps, one), largest(loads, [&](const unsigned i) {
                 return 1. / stiffness(i, i);
               }));
    LipVector forces(loads.size());
    stiffness.vmult(forces, jumps);
    forces -= loads;
    double worst = 0.;
    for (unsigned int i = 0; i < pairs.size(); ++i)
      {
        const double opening = (jumps(pairs[i].normal) - pairs[i].gap) / jump;
        const double normal  = forces(pairs[i].normal) / force;
        worst = std::max(worst, std::abs(std::min(normal, opening)));
        if (!pairs[i].may_slide())
          continue;
        const double tangent = forces(pairs[i].tangent) / force;
        const double slip =
          (jumps(pairs[i].tangent) - increment.reference[i]) / jump;
        const double bound = increment.coefficients[i] * std::max(normal, 0.);
        worst =
          std::max({worst,
                    std::abs(tangent) - bound,
                    std::min(std::abs(slip),
                             std::abs(tangent + std::copysign(bound, slip)))});
      }
    return worst;
  }



  void
  FrictionProblem::solve_by_lemke(const LipVector &loads,
                                  const Increment &increment)
  {
    ++rescues;
    const unsigned int       m = pairs.size();
    LAPACKFullMatrix<double> compliance(factor.matrix);
    compliance.invert();
    LipVector free_jumps(loads.size());
    compliance.vmult(free_jumps, loads);
    double scale = 0.; // so that forces and jumps are alike
    for (unsigned int i = 0; i < loads.size(); ++i)
      scale += compliance(i, i) / loads.size();

    // An unknown of a pair, or none: then of a compliance without coupling.
    const auto C = [&](const unsigned int a, const unsigned int b) {
      return std::max(a, b) == numbers::invalid_unsigned_int
               ? 0.
               : compliance(a, b) / scale;
    };
    // Blocks: g_N, g_T along and against the tangent, size of the slip.
    FullMatrix<double> M(4 * m);
    LipVector          r(4 * m);
    for (unsigned int i = 0; i < m; ++i)
      {
        const auto [N_i, T_i, gap] = pairs[i];
        for (unsigned int j = 0; j < m; ++j)
          {
            const unsigned int N_j = pairs[j].normal, T_j = pairs[j].tangent;
            const double       TT =
              i == j && !pairs[i].may_slide() ? 1. : C(T_i, T_j);
            M(i, j)                 = C(N_i, N_j);
            M(i, m + j)             = C(N_i, T_j);
            M(i, 2 * m + j)         = -C(N_i, T_j);
            M(m + i, j)             = C(T_i, N_j);
            M(m + i, m + j)         = TT;
            M(m + i, 2 * m + j)     = -TT;
            M(2 * m + i, j)         = -C(T_i, N_j);
            M(2 * m + i, m + j)     = -TT;
            M(2 * m + i, 2 * m + j) = TT;
          }
        M(m + i, 3 * m + i) = M(2 * m + i, 3 * m + i) = 1.;
        M(3 * m + i, i)     = increment.coefficients[i];
        M(3 * m + i, m + i) = M(3 * m + i, 2 * m + i) = -1.;
        r(i)                                          = free_jumps(N_i) - gap;
        if (pairs[i].may_slide())
          r(m + i) = free_jumps(T_i) - increment.reference[i];
        r(2 * m + i) = -r(m + i);
      }
    if (const double size = r.linfty_norm(); size > 0.)
      r /= size;
    const auto z = lemke(M, r);
    if (!z)
      throw NumericalError(
        "The friction of " + std::to_string(m) +
        " pairs of nodes has no solution that could be found: its stiffness is "
        "too ill-conditioned. Check the moduli of [Material] and the mesh.");
    // The variable that is not 0 tells the state.
    LipVector w(4 * m);
    M.vmult(w, *z);
    w += r;
    for (unsigned int i = 0; i < m; ++i)
      if ((*z)(i) <= 0.)
        states[i] = SlipState::open;
      else if ((*z)(3 * m + i) <= 0.)
        states[i] = SlipState::stick;
      else
        states[i] = slip(w(m + i) > w(2 * m + i));
  }
} // namespace Crevasse
