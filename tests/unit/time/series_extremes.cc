// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Extremes between samples: exact for parabolas and for kinks of lines, none
// where there is none, and of second order at least.

#include <crevasse/base/series_extremes.h>

#include <deal.II/base/numbers.h>

#include <crevasse_tests/tests.h>
#include <functional>
#include <limits>

using namespace Crevasse;

namespace
{
  using Function       = std::function<double(double)>;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();



  SeriesExtremes
  extremes_of(const Function &q, const std::vector<double> &t)
  {
    std::vector<double> values;
    for (const double instant : t)
      values.push_back(q(instant));
    return {t, values};
  }



  /** Instants from 0 to 1, of steps that are equal or alternate. */
  std::vector<double>
  instants(const unsigned int n, const double longer = 1.)
  {
    std::vector<double> t = {0.};
    for (unsigned int k = 0; k < n; ++k)
      t.push_back(t.back() + (k % 2 == 0 ? longer : 1.));
    for (double &instant : t)
      instant /= t.back();
    return t;
  }



  void
  exact()
  {
    section("exact");
    const auto parabola = [](const double t) {
      return 3. - (t - 0.37) * (t - 0.37);
    };
    const auto kink = [](const double t) {
      return std::max(-1. - 2. * (t - 0.437), -1. + 3. * (t - 0.437));
    };
    for (const double longer : {1., 1.7})
      {
        const auto top    = extremes_of(parabola, instants(10, longer)).largest;
        const auto bottom = extremes_of(kink, instants(10, longer)).least;
        const std::string steps = longer == 1. ? "equal" : "unequal";
        check_below("parabola, " + steps, std::abs(top.value - 3.), 1e-14);
        check_below("its instant, " + steps,
                    std::abs(top.instant - 0.37),
                    1e-12);
        check_below("kink, " + steps, std::abs(bottom.value + 1.), 1e-14);
        check_below("kink's instant, " + steps,
                    std::abs(bottom.instant - 0.437),
                    1e-12);
      }
  }



  void
  samples_stay()
  {
    section("samples stay");
    const auto largest = [](const std::vector<double> &q) {
      std::vector<double> t;
      for (unsigned int k = 0; k < q.size(); ++k)
        t.push_back(k);
      return SeriesExtremes(t, q).largest.value;
    };
    check("monotone", largest({1., 2., 4., 8., 9.}) == 9.);
    check("dwell that begins and ends at instants",
          largest({0., 10., 10., 10., 5., 1., 0.}) == 10.);
    check("dwell that begins and ends between instants",
          largest({0., 7., 10., 10., 10., 8., 1.}) == 10.);
    check("peak of lines at an instant",
          largest({0., 3., 6., 5., 4., 0.}) == 6.);
    check("steps", largest({0., 0., 1., 1., 1., 0., 0.}) == 1.);
    check("one value", largest({2.}) == 2.);
    check("two values", largest({2., 3.}) == 3.);
    check("no value", std::isnan(largest({})) && std::isnan(largest({nan})));
    check("unknown values", largest({nan, 1., 2., nan, 2., 1.}) == 2.);
    const double e = std::numeric_limits<double>::epsilon();
    check("rounding",
          largest({1., 1. + e, 1. - e, 1. + 2. * e, 1., 1. - e}) ==
            1. + 2. * e);
    check("no sign that no value has",
          SeriesExtremes({0., 1., 2., 3., 4.}, {4., 1., 0., 0.2, 2.})
              .least.value == 0.);
    const SeriesExtremes jump({0., 1., 2., 3., 3., 4., 5., 6.},
                              {0., 1., 2., 3., -3., -2., -1., 0.});
    check("jump",
          jump.largest.value == 3. && jump.least.value == -3. &&
            jump.largest.instant == 3.);
    const SeriesExtremes found({0., 1., 2., 2.4, 2.4000001, 3., 4.},
                               {0., 1., 2., 2.4, 2.4, 1.8, 0.8});
    check("kink that was found", found.largest.value == 2.4);
  }



  /** Largest error of both extremes over phases of the steps. */
  double
  error(const std::function<double(double, double)> &q,
        const double                                 least,
        const double                                 largest,
        const unsigned int                           n,
        const double                                 longer)
  {
    double worst = 0.;
    for (unsigned int k = 0; k < 60; ++k)
      {
        const double phase = k / (30. * n);
        const auto   found =
          extremes_of([&q, phase](const double t) { return q(t, phase); },
                      instants(n, longer));
        worst = std::max({worst,
                          std::abs(found.least.value - least),
                          std::abs(found.largest.value - largest)});
      }
    return worst;
  }



  void
  orders()
  {
    constexpr double pi   = dealii::numbers::PI;
    const auto       sine = [](const double t, const double phase) {
      return std::sin(2. * pi * (t + phase));
    };
    // Two smooth parts that meet at t = 0.3 − phase, and its mirror image.
    const auto kinked = [](const double t, const double phase) {
      const double x = t + phase - 0.3;
      return 2. * std::cos(2. * pi * x) - 3. * std::abs(std::sin(pi * x)) -
             std::sin(2. * pi * x);
    };
    const double least =
      -extremes_of([&kinked](const double t) { return -kinked(t, 0.); },
                   instants(1u << 16))
         .largest.value;
    for (const double longer : {1., 1.5})
      for (const bool has_kink : {false, true})
        {
          section(std::string(has_kink ? "kinked" : "smooth") +
                  (longer == 1. ? ", equal steps" : ", unequal steps"));
          std::vector<double> errors;
          for (const unsigned int n : {20, 40, 80, 160})
            errors.push_back(has_kink ? error(kinked, least, 2., n, longer)
                                      : error(sine, -1., 1., n, longer));
          for (unsigned int k = 1; k < errors.size(); ++k)
            check_below("quarter of the error, " + std::to_string(10 << k) +
                          " steps",
                        4. * errors[k] / errors[k - 1],
                        1.);
          check_below("error with 80 steps", errors[2], 1e-3);
        }
  }



  void
  noise()
  {
    section("noise");
    for (const double size : {1e-6, 1e-9})
      {
        unsigned int seed  = 1;
        const auto   found = extremes_of(
          [&seed, size](const double t) {
            seed = 1664525u * seed + 1013904223u;
            return std::sin(2. * dealii::numbers::PI * t) +
                   size * (seed / 4294967296. - 0.5);
          },
          instants(4000));
        check_below("of a sine, in units of the noise",
                    std::abs(found.largest.value - 1.) / size,
                    2.);
      }
  }
} // namespace



void
series_extremes()
{
  exact();
  samples_stay();
  orders();
  noise();
}
