// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Friction on the lip: the three solutions of a problem of one pair, each found
// and kept where its state is the first guess; the shielding of a pressed
// crack; 560 seeded increments and their followers of cracks in an infinite
// body, whose halves differ or not, from coefficients 0 to 2; random
// stiffnesses, on some of which states recur, so that Lemke's method must end
// them.

#include <crevasse/contact/friction_problem.h>

#include <deal.II/lac/full_matrix.h>

#include <crevasse_tests/friction_violation.h>
#include <crevasse_tests/tests.h>
#include <random>

using namespace Crevasse;

namespace
{
  using Dense = dealii::LAPACKFullMatrix<double>;
  using Small = dealii::Vector<double>;

  /** Openings come first. */
  std::vector<FrictionProblem::Pair>
  pairs(const unsigned int m, const double gap = 0.)
  {
    std::vector<FrictionProblem::Pair> all;
    for (unsigned int i = 0; i < m; ++i)
      all.push_back({i, {{m + i, dealii::numbers::invalid_unsigned_int}}, gap});
    return all;
  }

  void
  three_solutions()
  {
    Dense A(2);
    A(0, 0) = 4.;
    A(0, 1) = A(1, 0) = -1.5;
    A(1, 1)           = 1.;
    Small loads(2), q(2);
    loads(0)                      = -1.;
    loads(1)                      = 0.9;
    const double    expected[][2] = {{0.2, 1.2}, {0., 0.}, {0., 0.2}};
    FrictionProblem lip(A, pairs(1));
    lip.increment = {{1.}, {{0.}}};
    section("a problem with three solutions");
    const dealii::Tensor<1, 2> forwards({1., 0.});
    for (const SlipState state :
         {SlipState::open, SlipState::stick, SlipState::slip})
      {
        lip.states = {{state, forwards, 0.}};
        check("it needs one set", lip.solve(loads, q) == 1);
        const auto &solution = expected[static_cast<int>(state)];
        check_below("violation", violation(lip, loads, q), 1e-14);
        check_below("difference",
                    std::max(std::abs(q(0) - solution[0]),
                             std::abs(q(1) - solution[1])),
                    1e-14);
      }
  }

  /** Stiffness of a crack |x| < 1 between two halves, on m Chebyshev points:
   * the jumps of a point force pair are arcosh(|1 − xξ| / |x − ξ|), and opening
   * and slip are coupled by a part where the halves differ. */
  Dense
  crack(const unsigned int m, const double coupling)
  {
    Dense      A(2 * m);
    const auto x = [m](const unsigned int i) {
      return std::cos(dealii::numbers::PI * (i + 0.5) / m);
    };
    for (unsigned int i = 0; i < m; ++i)
      for (unsigned int j = 0; j < m; ++j)
        {
          const double h = dealii::numbers::PI / m;
          const double root =
            std::sqrt((1. - x(i) * x(i)) * (1. - x(j) * x(j)));
          const double log =
            i == j ? std::log(4. * (1. - x(i) * x(i)) / (h * root)) + 1.
                   : std::acosh((1. - x(i) * x(j)) / std::abs(x(i) - x(j)));
          A(i, j) = A(m + i, m + j) = log;
          A(i, m + j)               = A(m + j, i) =
            i == j ? 0. : coupling * (i < j ? root : -root);
        }
    A.invert();
    Dense symmetric(2 * m);
    for (unsigned int i = 0; i < 2 * m; ++i)
      for (unsigned int j = 0; j < 2 * m; ++j)
        symmetric(i, j) = 0.5 * (A(i, j) + A(j, i));
    return symmetric;
  }

  /** K_II(μ) / K_II(0) = 1 − μ σ / τ, here of all slips. */
  void
  shielding()
  {
    constexpr unsigned int m = 50;
    const Dense            A = crack(m, 0.);
    Small free_slip(2 * m), loads(2 * m), q(2 * m), none(2 * m);
    for (unsigned int i = 0; i < m; ++i)
      {
        loads(i)     = -2.;
        loads(m + i) = 1.;
      }
    section("shielding of a pressed crack");
    for (const double mu : {0., 0.3, 0.6})
      {
        FrictionProblem lip(A, pairs(m));
        lip.increment = {std::vector<double>(m, mu), {std::vector<double>(m)}};
        lip.solve(loads, q);
        if (mu == 0.)
          free_slip = q;
        q.add(-(1. - 2. * std::min(mu, 0.5)), free_slip);
        check_below("K_II", q.linfty_norm() / free_slip.linfty_norm(), 1e-12);
      }
  }

  /** Smooth functions of the place on the lip. */
  Small
  smooth(const unsigned int m, std::mt19937 &random)
  {
    std::normal_distribution<double> normal;
    Small                            values(m);
    for (unsigned int k = 0; k < 4; ++k)
      {
        const double size = normal(random) / (1 + k), phase = normal(random);
        for (unsigned int i = 0; i < m; ++i)
          values(i) +=
            size * std::cos(0.5 * k * dealii::numbers::PI *
                              std::cos(dealii::numbers::PI * (i + 0.5) / m) +
                            3. * phase);
      }
    return values;
  }

  Small
  random_loads(const unsigned int m, std::mt19937 &random)
  {
    std::normal_distribution<double> normal;
    const Small  opening = smooth(m, random), shear = smooth(m, random);
    const double pressure = 1.5 * std::abs(normal(random)),
                 uniform  = normal(random);
    Small loads(2 * m);
    for (unsigned int i = 0; i < m; ++i)
      {
        loads(i)     = -pressure + opening(i);
        loads(m + i) = uniform + shear(i);
      }
    return loads;
  }

  void
  random_increments(const unsigned int m, const double coupling)
  {
    std::mt19937 random(1785 + m);
    const Dense  A     = crack(m, coupling);
    double       worst = 0., again = 0.;
    unsigned int cold = 0, warm = 0, n = 0, most_again = 0;
    for (const double mu : {0., 0.1, 0.3, 0.6, 1., 1.5, 2.})
      for (unsigned int problem = 0; problem < 20; ++problem)
        {
          FrictionProblem lip(A, pairs(m));
          lip.increment      = {std::vector<double>(m, mu),
                                {std::vector<double>(m)}};
          const Small first  = random_loads(m, random),
                      second = random_loads(m, random);
          Small q(2 * m), same(2 * m);
          cold += lip.solve(first, q);
          worst = std::max(worst, violation(lip, first, q));
          for (unsigned int step = 1; step <= 3; ++step)
            {
              lip.increment.reference[0].assign(q.begin() + m, q.end());
              Small loads = first;
              loads.sadd(1. - 0.05 * step, 0.05 * step, second);
              warm += lip.solve(loads, q);
              worst = std::max(worst, violation(lip, loads, q));
              lip.increment.reference[0].assign(q.begin() + m, q.end());
              most_again = std::max(most_again, lip.solve(loads, same));
              same -= q;
              again = std::max(again, same.linfty_norm() / q.linfty_norm());
            }
          n += 1;
        }
    section(std::to_string(m) + (coupling == 0. ? " pairs" : " coupled pairs"));
    check_below("mean number of sets, cold", cold / double(n), 6.);
    check_below("mean number of sets, warm", warm / (3. * n), 3.5);
    check_below("violation", worst, 1e-9);
    check_below("solved again from its own slip", again, 1e-12);
    check("that needs one set", most_again == 1);
  }

  void
  random_stiffnesses()
  {
    std::mt19937                     random(1996);
    std::normal_distribution<double> normal;
    double                           worst   = 0.;
    unsigned int                     rescues = 0;
    for (unsigned int problem = 0; problem < 1000; ++problem)
      {
        const unsigned int         m = 1 + problem % 8;
        dealii::FullMatrix<double> root(2 * m), product(2 * m);
        for (unsigned int i = 0; i < 2 * m; ++i)
          for (unsigned int j = 0; j < 2 * m; ++j)
            root(i, j) = normal(random);
        root.Tmmult(product, root);
        for (unsigned int i = 0; i < 2 * m; ++i)
          product(i, i) += 0.1;
        Dense A(2 * m);
        A = product;
        Small loads(2 * m), q(2 * m);
        for (double &load : loads)
          load = normal(random);
        FrictionProblem lip(A, pairs(m, problem % 2 * -0.1));
        lip.increment = {std::vector<double>(m, 0.25 * (problem % 9)),
                         {std::vector<double>(m, problem % 3 * 0.05)}};
        lip.solve(loads, q);
        worst = std::max(worst, violation(lip, loads, q));
        rescues += lip.n_rescues();
      }
    section("random stiffnesses");
    check_below("violation", worst, 1e-9);
    check("some cycles were met and ended", rescues > 0);
  }
} // namespace

void
friction_problem()
{
  three_solutions();
  shielding();
  for (const unsigned int m : {20, 100})
    for (const double coupling : {0., 0.3})
      random_increments(m, coupling);
  random_stiffnesses();
}
