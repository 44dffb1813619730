// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Methods for fixed points: Anderson's acceleration on maps whose fixed point
// is known, and the distance to the limit that changes of a sequence tell.

#include <crevasse/periodic/contraction.h>
#include <crevasse/time/anderson_acceleration.h>

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
        const double      unit        = std::pow(10., exponent);
        const std::string in_units    = "units 1e" + std::to_string(exponent);
        const auto        fast_errors = errors(LinearMap(fast, unit), {5}, 40);
        const auto        slow_errors = errors(LinearMap(slow, unit), {5}, 40);
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
                errors(map, {1}, 40).back(),
                1e-12);
  }



  void
  check_memory()
  {
    const LinearMap      map({0.5, -0.3, 0.1}, 1.);
    AndersonAcceleration acceleration({5});
    Vector               x(n_unknowns), image(n_unknowns), next(n_unknowns);
    map(x, image);
    acceleration.add(x, image);
    acceleration.extrapolate(next);
    next -= image;
    check("the first step is the map itself", next.linfty_norm() == 0.);
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



  /** x ← x − ∇φ(x) with a convex φ that has kinks in its gradient: springs that
   * bear some directions only on one side. Points to an error of 1e-8. */
  unsigned int
  points_with_kinks(const unsigned int seed, const bool accelerated)
  {
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> number(-1., 1.);
    std::vector<Vector>                    normals(n_unknowns);
    for (Vector &normal : normals)
      {
        normal.reinit(n_unknowns);
        for (unsigned int i = 0; i < n_unknowns; ++i)
          normal(i) = number(generator);
        normal /= normal.l2_norm() * std::sqrt(double(n_unknowns));
      }
    AndersonAcceleration acceleration({5, true});
    Vector               x(n_unknowns), image(n_unknowns);
    x = 30.;
    for (unsigned int n = 1; n < 5000; ++n)
      {
        // The fixed point is 0, some springs just touching it.
        image = x;
        for (unsigned int i = 0; i < n_unknowns; ++i)
          image(i) -= 0.02 * x(i);
        for (const Vector &normal : normals)
          image.add(-0.9 * std::max(normal * x, 0.), normal);
        if (x.l2_norm() <= 1e-8)
          return n;
        acceleration.add(x, image);
        if (accelerated)
          acceleration.extrapolate(x);
        else
          x = image;
      }
    return 5000;
  }



  void
  check_kinks()
  {
    unsigned int most = 0, least_of_map = 5000;
    for (unsigned int seed = 0; seed < 20; ++seed)
      {
        most         = std::max(most, points_with_kinks(seed, true));
        least_of_map = std::min(least_of_map, points_with_kinks(seed, false));
      }
    check("kinks: the map itself needs hundreds of points", least_of_map > 300);
    check("accelerated it needs a quarter of that", 4 * most < least_of_map);
  }
} // namespace

void
periodic_methods()
{
  check_linear_maps();
  check_memory();
  check_contraction();
  section("kinks");
  check_kinks();
}
