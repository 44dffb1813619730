// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Which states follow from jumps and forces, for FrictionProblem.

#include <crevasse/contact/friction_problem.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    using PairState = FrictionProblem::State;

    /** A candidate for the solution. */
    struct Solution
    {
      const dealii::Vector<double> &loads, &jumps, &forces;
      double                        largest; ///< largest jump
    };



    /** What decides on the next state of a pair. */
    struct PairValues
    {
      double       opening, pressure;  ///< q_N − gap, g_N
      Tensor<1, 2> slip, force;        ///< δ, g_T
      double       coefficient, limit; ///< μ, largest allowed force
      double       normal_stiffness;
      double       stiffness = 0.; ///< along tangents, however these are turned
      double       least_slip;     ///< what rounding makes of 0 or more
      double       noise;          ///< size of rounding in forces
      bool         can_turn;       ///< whether it can slide in any direction

      PairValues(const FrictionProblem &problem,
                 const unsigned int     i,
                 const Solution        &solution)
      {
        constexpr double rounding =
          100. * std::numeric_limits<double>::epsilon();
        const auto &[loads, jumps, forces, largest] = solution;
        const auto                  &sigma          = problem.factor.matrix;
        const FrictionProblem::Pair &pair           = problem.pairs[i];
        const unsigned int           N              = pair.normal;
        opening                                     = jumps(N) - pair.gap;
        pressure                                    = forces(N);
        coefficient      = problem.increment.coefficients[i];
        limit            = coefficient * std::max(pressure, 0.);
        normal_stiffness = sigma(N, N);
        least_slip       = -rounding * largest;
        noise            = std::abs(loads(N)) + normal_stiffness * largest;
        can_turn         = pair.n_tangents() > 1;
        for (const unsigned int c : {0, 1})
          if (pair.has(c))
            {
              const unsigned int T = pair.tangents[c];
              slip[c]  = jumps(T) - problem.increment.reference[c][i];
              force[c] = forces(T);
              stiffness += sigma(T, T) / pair.n_tangents();
              noise =
                std::max(noise, std::abs(loads(T)) + sigma(T, T) * largest);
            }
        noise *= rounding;
      }

      /** State of slip against a trial force, which is not 0 and not below its
       * limit. */
      PairState
      slide(const Tensor<1, 2> &trial, const double at_limit) const
      {
        // As a pair begins to slide, its direction changes more and more
        // easily. A stiffer spring would not save steps, but cost digits.
        constexpr double stiffest = 1e4;
        const double     size = trial.norm(), excess = size - at_limit;
        return {SlipState::slip,
                -trial / size,
                stiffness * (at_limit < stiffest * excess ? at_limit / excess
                                                          : stiffest)};
      }

      PairState
      after_open(const PairState &state) const
      {
        if (opening >= least_slip)
          return state;
        const double allowed = -coefficient * normal_stiffness * opening;
        return stiffness * slip.norm() > allowed
                 ? slide(-stiffness * slip, allowed)
                 : PairState();
      }

      PairState
      after_slip(const PairState &state) const
      {
        if (state.direction * slip < least_slip)
          return {};
        if (const Tensor<1, 2> trial = force - stiffness * slip;
            can_turn && trial.norm() > 0.)
          if (const PairState turned = slide(trial, limit);
              (force + limit * turned.direction).norm() > noise)
            return turned;
        return state;
      }

      PairState
      next(const PairState &state) const
      {
        if (state.kind == SlipState::open)
          return after_open(state);
        if (pressure < -noise)
          return {SlipState::open, {}, 0.};
        if (state.kind == SlipState::slip)
          return after_slip(state);
        return force.norm() > limit + noise ? slide(force, limit) : state;
      }
    };
  } // namespace



  std::vector<FrictionProblem::State>
  FrictionProblem::next_states(const LipVector &loads,
                               const LipVector &jumps) const
  {
    LipVector forces(loads.size());
    factor.matrix.vmult(forces, jumps);
    forces -= loads;
    double largest = jumps.linfty_norm();
    for (const auto &along : increment.reference)
      for (const double jump : along)
        largest = std::max(largest, std::abs(jump));
    std::vector<State> next;
    for (unsigned int i = 0; i < pairs.size(); ++i)
      next.push_back(
        PairValues(*this, i, {loads, jumps, forces, largest}).next(states[i]));
    return next;
  }
} // namespace Crevasse
