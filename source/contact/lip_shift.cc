// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/contact/condensed_problem.h>
#include <crevasse/contact/lip_shift.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Crevasse
{
  using namespace dealii;

  LipShift::LipShift(const LAPACKFullMatrix<double> &stiffness,
                     const std::vector<LipVector>   &weights)
    : n(stiffness.m())
    , weights(weights)
    , inverse(stiffness)
    , diagonal(n)
  {
    for (unsigned int i = 0; i < n; ++i)
      diagonal(i) = stiffness(i, i);
    inverse.invert();
    // LAPACK's inverse is symmetric but for rounding.
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < i; ++j)
        inverse(i, j) = inverse(j, i);
  }



  LipShift::LipVector
  LipShift::mean(const std::vector<LipVector> &forces) const
  {
    LipVector sum(n);
    for (unsigned int j = 0; j < weights.size(); ++j)
      for (unsigned int i = 0; i < n; ++i)
        sum(i) += weights[j](i) * forces[j](i);
    return sum;
  }



  void
  LipShift::add_inverse(const Set          &set,
                        const LipVector    &weight,
                        const double        factor,
                        FullMatrix<double> &sum) const
  {
    std::vector<unsigned int> nodes;
    for (unsigned int i = 0; i < n; ++i)
      if (set[i])
        nodes.push_back(i);
    if (nodes.empty())
      return;
    LAPACKFullMatrix<double> part(nodes.size());
    for (unsigned int a = 0; a < nodes.size(); ++a)
      for (unsigned int b = 0; b < nodes.size(); ++b)
        part(a, b) = inverse(nodes[a], nodes[b]);
    part.invert();
    for (unsigned int a = 0; a < nodes.size(); ++a)
      for (unsigned int b = 0; b < nodes.size(); ++b)
        sum(nodes[a], nodes[b]) += factor * weight(nodes[a]) * part(a, b);
  }



  LipShift::Response
  LipShift::respond(const std::vector<LipVector> &openings,
                    const LipVector              &c) const
  {
    Response response;
    response.mean.reinit(n);
    response.slope.reinit(n, n);
    // The complementarity problem of the forces: its "displacement" is g, and
    // its "closed" nodes bear none.
    LipVector ones(n);
    ones = 1.;
    CondensedProblem problem(inverse, ones, LipVector(n));
    problem.start_from(Set(n, true));
    std::map<Set, LipVector> weights_of_sets;
    LipVector                loads(n), forces(n);
    for (unsigned int j = 0; j < openings.size(); ++j)
      {
        response.openings.push_back(openings[j]);
        LipVector &opening = response.openings.back();
        opening += c;
        Set pressed(n, false);
        if (*std::min_element(opening.begin(), opening.end()) < 0.)
          {
            loads = opening;
            loads *= -1.;
            problem.solve(loads, forces);
            inverse.vmult(opening, forces, true);
            pressed = problem.closed_pairs();
            pressed.flip();
            for (unsigned int i = 0; i < n; ++i)
              response.mean(i) += weights[j](i) * forces(i);
            LipVector &sum = weights_of_sets[pressed];
            if (sum.size() == 0)
              sum.reinit(n);
            sum += weights[j];
          }
        response.pressed.push_back(std::move(pressed));
      }
    for (const auto &[set, weight] : weights_of_sets)
      add_inverse(set, weight, 1., response.slope);
    return response;
  }



  LipShift::LipVector
  LipShift::mean_force(const std::vector<LipVector> &openings) const
  {
    return respond(openings, LipVector(n)).mean;
  }



  void
  LipShift::let_touch(const std::vector<LipVector> &openings,
                      const LipVector              &c,
                      const Set                    &idle,
                      Response                     &response,
                      LipVector                    &excess) const
  {
    std::map<unsigned int, Set> touching; ///< by instant
    for (unsigned int i = 0; i < n; ++i)
      if (idle[i])
        {
          unsigned int least = 0;
          for (unsigned int j = 1; j < openings.size(); ++j)
            if (response.openings[j](i) < response.openings[least](i))
              least = j;
          touching.emplace(least, response.pressed[least]).first->second[i] =
            true;
        }
    for (const auto &[j, set] : touching)
      {
        FullMatrix<double> change(n, n);
        add_inverse(set, weights[j], 1., change);
        add_inverse(response.pressed[j], weights[j], -1., change);
        response.slope.add(1., change);
        LipVector position = openings[j];
        position += c;
        change.vmult(position, LipVector(position));
        excess -= position;
      }
  }



  LipShift::LipVector
  LipShift::reach_of(const std::vector<LipVector> &openings) const
  {
    constexpr double small = 1e-3;
    LipVector        low = openings[0], high = openings[0];
    for (const LipVector &opening : openings)
      for (unsigned int i = 0; i < n; ++i)
        {
          low(i)  = std::min(low(i), opening(i));
          high(i) = std::max(high(i), opening(i));
        }
    const double range = *std::max_element(high.begin(), high.end()) -
                         *std::min_element(low.begin(), low.end());
    high -= low;
    for (double &reach : high)
      reach = std::max(reach, small * range);
    return high;
  }



  void
  LipShift::find_correction(const Response &response, LipVector &excess) const
  {
    constexpr double         small = 1e-7, soft = 1e-2;
    LAPACKFullMatrix<double> system(n);
    system = response.slope;
    // Nodes without a force at any instant leave the slope singular.
    for (unsigned int i = 0; i < n; ++i)
      system(i, i) +=
        small * (system(i, i) > 0. ? system(i, i) : soft * diagonal(i));
    system.compute_lu_factorization();
    system.solve(excess);
  }



  bool
  LipShift::approach(const std::vector<LipVector> &openings,
                     const LipVector              &target,
                     const double                  small_force,
                     LipVector                    &c) const
  {
    constexpr double       accuracy = 1e-9, idle_part = 1e-12;
    constexpr unsigned int most  = 12;
    const LipVector        reach = reach_of(openings);
    for (unsigned int k = 0; k < most; ++k)
      {
        Response  response = respond(openings, c);
        LipVector excess   = response.mean;
        excess -= target;
        Set  idle(n, false);
        bool is_solved = true;
        for (unsigned int i = 0; i < n; ++i)
          {
            is_solved =
              is_solved && std::abs(excess(i)) <=
                             accuracy * std::max(target(i), small_force);
            idle[i] =
              target(i) > 0. && response.mean(i) <= idle_part * target(i);
          }
        if (is_solved)
          return true;
        let_touch(openings, c, idle, response, excess);
        find_correction(response, excess);
        double length = 1.;
        for (unsigned int i = 0; i < n; ++i)
          if (reach(i) > 0.)
            length = std::max(length, std::abs(excess(i)) / reach(i));
        c.add(1. / length, excess);
      }
    return false;
  }



  LipShift::LipVector
  LipShift::solve(const std::vector<LipVector> &openings,
                  const LipVector              &target) const
  {
    constexpr double small = 1e-3, rounding = 1e-4, least_part = 1e-4;
    const LipVector  start = mean_force(openings);
    // Forces that are rounding of what the lip could bear are as good as none.
    LipVector held = reach_of(openings);
    for (unsigned int i = 0; i < n; ++i)
      held(i) *= diagonal(i);
    const double small_force =
      std::max(small * std::max(target.linfty_norm(), start.linfty_norm()),
               rounding * held.linfty_norm());
    LipVector c(n), trial, wanted;
    double    done = 0., part = 1.;
    while (done < 1.)
      {
        const double next = std::min(1., done + part);
        wanted            = start;
        wanted.sadd(1. - next, next, target);
        trial = c;
        if (approach(openings, wanted, small_force, trial))
          {
            c    = trial;
            done = next;
            part *= 2.;
          }
        else
          part /= 4.;
        if (part < least_part)
          {
            ++unsolved;
            break;
          }
      }
    return c;
  }



  LipShift::LipVector
  LipShift::follow(const std::vector<LipVector> &openings,
                   const FullMatrix<double>     &B,
                   const LipVector              &position,
                   LipVector                    &force) const
  {
    constexpr double       accuracy = 1e-11, decrease = 0.1, shortest = 1e-3;
    constexpr unsigned int most = 60;
    LipVector              c(n), by_force(n), left, trial, trial_left(n);
    const auto             residual = [&](const LipVector &shift,
                              const Response  &response) {
      LipVector excess = force, value = position;
      excess -= response.mean;
      B.vmult(by_force, excess);
      value -= by_force;
      value -= shift;
      return value; // minus the residual of the shift
    };
    B.vmult(by_force, force);
    const double small = accuracy * (position.l2_norm() + by_force.l2_norm());
    Response     response = respond(openings, c);
    left                  = residual(c, response);
    for (unsigned int k = 0; k < most && left.l2_norm() > small; ++k)
      {
        FullMatrix<double> slope(n, n);
        B.mmult(slope, response.slope);
        for (unsigned int i = 0; i < n; ++i)
          slope(i, i) += 1.;
        LAPACKFullMatrix<double> system(n);
        system = slope;
        system.compute_lu_factorization();
        LipVector step = left;
        system.solve(step);
        for (double length = 1.;; length /= 2.)
          {
            trial = c;
            trial.add(length, step);
            response   = respond(openings, trial);
            trial_left = residual(trial, response);
            if (length < shortest ||
                trial_left.l2_norm() <=
                  (1. - decrease * length) * left.l2_norm())
              break;
          }
        c    = trial;
        left = trial_left;
      }
    if (!(left.l2_norm() <= small))
      ++unsolved;
    force = response.mean;
    return c;
  }
} // namespace Crevasse
