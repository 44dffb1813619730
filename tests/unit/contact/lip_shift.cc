// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// The shift of a lip that has given mean contact forces: random lips (seeded)
// that open and close, with forces of another shift of theirs, with any
// positive forces, and with nodes that bear none.

#include <crevasse/contact/lip_shift.h>

#include <cmath>
#include <crevasse_tests/tests.h>
#include <random>

using namespace Crevasse;

namespace
{
  using Small = LipShift::LipVector;

  constexpr unsigned int n_instants = 24;

  /** Stiffness of a chain of nodes that reach as far as in a body. */
  dealii::LAPACKFullMatrix<double>
  stiffness_of_lip(const unsigned int n)
  {
    dealii::LAPACKFullMatrix<double> sigma(n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        sigma(i, j) = i == j ? 1. : -0.3 / std::pow(std::abs(1. * i - j), 1.5);
    for (unsigned int i = 0; i < n; ++i)
      sigma(i, i) += 1.;
    return sigma;
  }

  struct RandomLip
  {
    std::vector<Small> openings, weights;

    RandomLip(const unsigned int n, const double size, std::mt19937 &random)
    {
      std::uniform_real_distribution<double> uniform(0., 1.);
      Small                                  phase(n), mean(n), sum(n);
      for (unsigned int i = 0; i < n; ++i)
        {
          phase(i) = uniform(random);
          mean(i)  = 2. * uniform(random) - 0.5;
        }
      for (unsigned int j = 0; j < n_instants; ++j)
        {
          openings.emplace_back(n);
          weights.emplace_back(n);
          for (unsigned int i = 0; i < n; ++i)
            {
              openings[j](i) =
                size *
                (mean(i) + std::sin(2. * M_PI * j / n_instants + phase(i)));
              // Creep that is faster at some instants by decades.
              weights[j](i) = std::pow(10., -3. * uniform(random));
              sum(i) += weights[j](i);
            }
        }
      for (Small &weight : weights)
        for (unsigned int i = 0; i < n; ++i)
          weight(i) /= sum(i);
    }

    std::vector<Small>
    shifted(const Small &c) const
    {
      std::vector<Small> all = openings;
      for (Small &opening : all)
        opening += c;
      return all;
    }
  };

  enum class Target
  {
    of_a_shift,
    any,
    none_at_some
  };

  /** Largest difference of mean contact forces from the wanted ones, relative
   * to the largest of them. */
  double
  worst_of(const Target target, const double size)
  {
    std::mt19937                           random(55);
    std::uniform_real_distribution<double> uniform(0., 1.);
    double                                 worst = 0.;
    for (unsigned int trial = 0; trial < 100; ++trial)
      {
        const unsigned int n = 1 + trial % 30;
        const RandomLip    lip(n, size, random);
        const LipShift     shift(stiffness_of_lip(n), lip.weights);
        Small              wanted(n);
        for (double &value : wanted)
          value = size * uniform(random);
        if (target == Target::of_a_shift)
          wanted = shift.mean_force(lip.shifted(wanted));
        if (target == Target::none_at_some)
          for (unsigned int i = 0; i < n; i += 3)
            wanted(i) = 0.;
        const Small c    = shift.solve(lip.openings, wanted);
        Small       mean = shift.mean_force(lip.shifted(c));
        mean -= wanted;
        const double scale =
          std::max(wanted.linfty_norm(),
                   1e-3 * shift.mean_force(lip.openings).linfty_norm());
        worst = std::max(worst, mean.linfty_norm() / std::max(scale, 1e-300));
      }
    return worst;
  }



  /** Largest defect of the shift of a lip that yields to its forces, relative
   * to the shift. */
  double
  worst_of_yielding(const double size)
  {
    std::mt19937 random(55);
    double       worst = 0.;
    for (unsigned int trial = 0; trial < 100; ++trial)
      {
        const unsigned int         n = 1 + trial % 30;
        const RandomLip            lip(n, size, random);
        const LipShift             shift(stiffness_of_lip(n), lip.weights);
        dealii::FullMatrix<double> B(n, n);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            B(i, j) = 1.4 * shift.compliance()(i, j);
        const Small force = shift.mean_force(lip.openings);
        Small       mean  = force;
        Small       left = shift.follow(lip.openings, B, lip.openings[0], mean);
        const double scale = left.linfty_norm();
        left -= lip.openings[0];
        mean -= force;
        Small by_force(n);
        B.vmult(by_force, mean);
        left -= by_force;
        worst = std::max(worst, left.linfty_norm() / scale);
      }
    return worst;
  }
} // namespace



void
lip_shift()
{
  for (const double size : {1., 1e-9})
    {
      section(std::string("lips that move by ") + (size == 1. ? "1" : "1e-9"));
      check_below("mean force of another shift",
                  worst_of(Target::of_a_shift, size),
                  1e-9);
      check_below("any mean force", worst_of(Target::any, size), 1e-9);
      check_below("shift of lips that yield", worst_of_yielding(size), 1e-9);
      check_below("no force at some nodes",
                  worst_of(Target::none_at_some, size),
                  1e-9);
    }
}
