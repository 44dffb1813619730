// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Methods for fixed points: Anderson's acceleration on maps whose fixed point
// is known, and the distance to the limit that changes of a sequence tell.

#include <crevasse/periodic/anderson_acceleration.h>
#include <crevasse/periodic/contraction.h>
#include <crevasse/periodic/drift_leaps.h>

#include <algorithm>
#include <cmath>
#include <crevasse_tests/tests.h>
#include <random>

using namespace Crevasse;

namespace
{
  constexpr unsigned int n_unknowns = 8;



  /** x ← x* + A (x − x*) with a symmetric A whose eigenvalues are given. */
  struct LinearMap
  {
    LinearMap(const std::vector<double> &eigenvalues, const double unit)
      : eigenvalues(eigenvalues)
      , axis(n_unknowns)
      , fixed_point(n_unknowns)
    {
      std::mt19937                           generator(7);
      std::uniform_real_distribution<double> number(-1., 1.);
      for (unsigned int i = 0; i < n_unknowns; ++i)
        {
          axis(i)        = number(generator);
          fixed_point(i) = unit * (2. + number(generator));
        }
      axis /= axis.l2_norm();
    }

    /** A Householder reflection, its own inverse. */
    void
    reflect(Vector &x) const
    {
      x.add(-2. * (axis * x), axis);
    }

    void
    operator()(const Vector &x, Vector &image) const
    {
      image = x;
      image -= fixed_point;
      reflect(image);
      for (unsigned int i = 0; i < n_unknowns; ++i)
        image(i) *= eigenvalues[i % eigenvalues.size()];
      reflect(image);
      image += fixed_point;
    }

    std::vector<double> eigenvalues;
    Vector              axis, fixed_point;
  };



  /** Relative errors of the points x₀ = 0, x₁, …. */
  std::vector<double>
  errors(const LinearMap                      &map,
         const AndersonAcceleration::Settings &settings,
         const unsigned int                    n_points)
  {
    AndersonAcceleration acceleration(settings);
    std::vector<double>  all;
    Vector               x(n_unknowns), image(n_unknowns), next(n_unknowns);
    for (unsigned int k = 0; k < n_points; ++k)
      {
        Vector error = x;
        error -= map.fixed_point;
        all.push_back(error.l2_norm() / map.fixed_point.l2_norm());
        map(x, image);
        acceleration.add(x, image);
        acceleration.extrapolate(next);
        x = next;
      }
    return all;
  }



  void
  check_linear_maps()
  {
    // In exact arithmetic as many points as the map has eigenvalues, and two,
    // tell the fixed point, as GMRES would (Walker and Ni, theorem 2.2). A slow
    // map is one of long relaxation times.
    const std::vector<double> fast = {0.5, -0.3, 0.1},
                              slow = {0.999, 0.95, 0.5};
    for (const int exponent : {0, -12, 12})
      {
        const double      unit     = std::pow(10., exponent);
        const std::string in_units = "units 1e" + std::to_string(exponent);
        const auto fast_errors     = errors(LinearMap(fast, unit), {5, 1.}, 40);
        const auto slow_errors     = errors(LinearMap(slow, unit), {5, 1.}, 40);
        check("three eigenvalues are not found in three points, " + in_units,
              fast_errors[3] > 1e-4);
        check_below("three eigenvalues, five points, " + in_units,
                    fast_errors[4],
                    1e-12);
        // Its differences are nearly dependent, and some are left out.
        check_below("slow map, nine points, " + in_units, slow_errors[8], 1e-7);
        check_below("what dependent residuals do afterwards, " + in_units,
                    *std::max_element(fast_errors.begin() + 5,
                                      fast_errors.end()),
                    1e-12);
        check_below("the same of the slow map, " + in_units,
                    *std::max_element(slow_errors.begin() + 9,
                                      slow_errors.end()),
                    1e-9);
      }

    const LinearMap map(fast, 1.);
    check_below("depth 1 on three eigenvalues, 40 points",
                errors(map, {1, 1.}, 40).back(),
                1e-12);
    check_below("damped, 40 points", errors(map, {5, 0.5}, 40).back(), 1e-12);
    const LinearMap diverging({1.5, -2., 0.3}, 1.);
    check_below("a map that diverges by itself",
                errors(diverging, {5, 1.}, 40)[8],
                1e-10);
  }



  void
  check_memory()
  {
    const LinearMap      map({0.5, -0.3, 0.1}, 1.);
    AndersonAcceleration acceleration({5, 1.});
    Vector               x(n_unknowns), image(n_unknowns), next(n_unknowns);
    map(x, image);
    acceleration.add(x, image);
    acceleration.extrapolate(next);
    next -= image;
    check("the first step is the map itself", next.linfty_norm() == 0.);
    x = image;
    map(x, image);
    acceleration.add(x, image);
    acceleration.clear();
    acceleration.add(x, image);
    acceleration.extrapolate(next);
    next -= image;
    check("nothing is remembered after clear()", next.linfty_norm() == 0.);
  }



  void
  check_contraction()
  {
    // eₙ = aλⁿ has changes eₙ₋₁ − eₙ: the estimate is exact.
    for (const double lambda : {0.9, 0.5, 1e-3})
      {
        section("geometric sequence of " + std::to_string(lambda));
        Contraction contraction;
        double      estimate = contraction.add(1., false);
        check("no estimate of the first period", std::isnan(estimate));
        for (unsigned int n = 1; n <= 3; ++n)
          {
            estimate = contraction.add(std::pow(lambda, n - 1) - //
                                       std::pow(lambda, n));
            if (n == 1)
              check("no estimate of one change", std::isnan(estimate));
          }
        check_below("relative error of the estimate",
                    std::abs(estimate / std::pow(lambda, 3) - 1.),
                    1e-9);
      }

    section("other sequences");
    // eₙ = n⁻², as under zero mean loads: changes below 1e-6 far from the
    // limit.
    Contraction contraction;
    double      estimate = 0., change = 0.;
    for (double n = 2.; n <= 200.; ++n)
      {
        change   = 1. / ((n - 1.) * (n - 1.)) - 1. / (n * n);
        estimate = contraction.add(change);
      }
    const double error = 1. / (200. * 200.);
    check("algebraic sequence: the change is a hundredth of the error",
          change < 0.011 * error);
    check("the estimate is within a factor of 2",
          estimate > 0.5 * error && estimate < 2. * error);

    // Twice a node comes free, and then it goes on as slowly as before.
    Contraction ceasing;
    for (unsigned int n = 0; n < 10; ++n)
      ceasing.add(std::pow(0.9, n));
    for (const double fall : {1., 0.1})
      {
        change = 0.1 * fall; // 0.9¹⁰ is more
        check("a fall of the changes to " + std::to_string(fall) +
                " for once says little",
              ceasing.add(change) >= 8.9 * change);
      }

    Contraction growing;
    growing.add(1e-3);
    check("no estimate of changes that grow", std::isnan(growing.add(2e-3)));
    check("nor soon after", std::isnan(growing.add(1e-3)));
    growing.add(1e-4);
    growing.add(1e-5);
    check("but later", std::isfinite(growing.add(1e-6)));
    check("changes that are rounding are no ratio",
          growing.add(1e-14) <= 1e-14 && growing.add(2e-14) <= 2e-14);
  }



  void
  check_drift_leaps()
  {
    // x ← x − 1 as long as x > 0, and then x ← x/2: a lip that drifts until it
    // touches.
    DriftLeaps   leaps;
    double       x       = 1e5;
    unsigned int n_leaps = 0;
    const auto residual = [](const double x) { return x > 0. ? -1. : -x / 2.; };
    for (double length = 1.; length > 0. && n_leaps < 100; ++n_leaps)
      {
        const double f = residual(x);
        length         = leaps.next(x > 0. ? 1. : 0., 0., std::abs(f));
        x += length * f;
      }
    check("a drift of 1e5 periods ends within 18 leaps",
          x <= 0. && n_leaps <= 18);
    check("that it has ended is reported", leaps.has_left());
    check("once", leaps.next(0.5, 0., 1.) == 0. && !leaps.has_left());
    check("the same drift goes on with the length of the last leap",
          leaps.next(1., 0., 1.) == 65536.);
    check("a lesser one from the beginning", leaps.next(1., 0., 0.1) == 1.);

    check("a residual that changes is none, however hard to explain",
          leaps.next(1., 0.3, 0.1) == 0.);

    leaps.clear();
    double longest = 0.;
    for (unsigned int n = 0; n < 100; ++n)
      longest = std::max(longest, leaps.next(1., 0., 1.));
    check("what never ends is not followed for ever",
          longest < 1e7 && leaps.next(1., 0., 1.) == 0.);
    leaps.clear();
    check("a single step is no leap",
          leaps.next(1., 0., 1.) == 1. && leaps.next(0., 0., 1.) == 0. &&
            !leaps.has_left());
  }
} // namespace

void
periodic_methods()
{
  check_linear_maps();
  check_memory();
  check_contraction();
  section("drift leaps");
  check_drift_leaps();
}
