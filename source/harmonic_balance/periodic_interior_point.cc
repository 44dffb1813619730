// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/harmonic_balance/periodic_interior_point.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  PeriodicInteriorPoint::PeriodicInteriorPoint(
    const PeriodicComplementarity &problem,
    PeriodicSystem                &system)
    : problem(problem)
    , system(system)
    , no_means(problem.mean_forces.size())
  {
    const unsigned int            p   = problem.convolution.n_nodes();
    const dealii::Vector<double> &w_0 = problem.openings_without_contact;
    current.offsets.reinit(p);
    current.forces.reinit(w_0.size());
    for (unsigned int k = 0; k < w_0.size(); ++k)
      {
        current.forces(k)      = problem.mean_forces(k % p);
        current.offsets(k % p) = std::max(current.offsets(k % p), -w_0(k));
      }
    constexpr double distance = 0.1;
    current.offsets.add(distance * problem.opening_scale(current));
    problem.compute_openings(current);
  }



  double
  PeriodicInteriorPoint::gap() const
  {
    return (current.forces * current.openings) / current.forces.size() /
           (problem.force_scale(current) * problem.opening_scale(current));
  }



  void
  PeriodicInteriorPoint::step()
  {
    ++steps;
    dealii::Vector<double> &g = current.forces, &w = current.openings;
    const unsigned int      n = g.size();
    dealii::Vector<double>  diagonal(w);
    for (unsigned int k = 0; k < n; ++k)
      diagonal(k) /= g(k);
    system.reinit(std::vector<bool>(n, true), diagonal);

    // What a step towards μ = 0 would achieve tells which μ to aim at, and its
    // products what the linearisation misses.
    dealii::Vector<double> right(w);
    right *= -1.;
    const PeriodicState predicted = direction(right);
    const double        a         = longest_step(predicted);
    const double        mu        = (g * w) / n;
    double              mu_after  = 0.;
    for (unsigned int k = 0; k < n; ++k)
      mu_after += (g(k) + a * predicted.forces(k)) *
                  (w(k) + a * predicted.openings(k)) / n;
    const double aim = mu * std::pow(mu_after / mu, 3);
    for (unsigned int k = 0; k < n; ++k)
      right(k) += (aim - predicted.forces(k) * predicted.openings(k)) / g(k);

    const PeriodicState corrected           = direction(right);
    constexpr double    part_of_the_longest = 0.99;
    const double        length =
      std::min(1., part_of_the_longest * longest_step(corrected));
    g.add(length, corrected.forces);
    w.add(length, corrected.openings);
    current.offsets.add(length, corrected.offsets);
  }



  PeriodicState
  PeriodicInteriorPoint::direction(const dealii::Vector<double> &right)
  {
    const unsigned int p = problem.convolution.n_nodes();
    PeriodicState      result;
    // What a solution by GMRES leaves of an equation changes g w by so much
    // times g: little compared with μ.
    constexpr double part_of_mu = 1e-2;
    const double     mu =
      (current.forces * current.openings) / current.forces.size();
    const double accuracy = part_of_mu * mu / problem.force_scale(current);
    system.solve(right, no_means, accuracy, result.forces, result.offsets);
    problem.convolution.vmult(result.openings, result.forces);
    for (unsigned int k = 0; k < result.openings.size(); ++k)
      result.openings(k) += result.offsets(k % p);
    return result;
  }



  double
  PeriodicInteriorPoint::longest_step(const PeriodicState &direction) const
  {
    double length = 1.;
    for (unsigned int k = 0; k < current.forces.size(); ++k)
      {
        if (direction.forces(k) < 0.)
          length = std::min(length, -current.forces(k) / direction.forces(k));
        if (direction.openings(k) < 0.)
          length =
            std::min(length, -current.openings(k) / direction.openings(k));
      }
    return length;
  }
} // namespace Crevasse
