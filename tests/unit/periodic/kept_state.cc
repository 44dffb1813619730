// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Iterations that are kept and resumed go on as if they had never been left:
// Anderson's acceleration with its history, and the ratio of changes. So does a
// run.

#include <crevasse/periodic/contraction.h>
#include <crevasse/periodic/run_state.h>
#include <crevasse/time/anderson_acceleration.h>

#include <cmath>
#include <crevasse_tests/memory_archive.h>
#include <crevasse_tests/tests.h>

using namespace Crevasse;

namespace
{
  constexpr unsigned int n_unknowns = 12;



  /** A contraction, curved a little. */
  void
  map(const Vector &x, Vector &image)
  {
    image = x;
    for (unsigned int i = 0; i < n_unknowns; ++i)
      image(i) =
        1. + (0.9 - 0.05 * i) * x(i) + 0.01 * std::sin(x((i + 1) % n_unknowns));
  }



  void
  iterate(AndersonAcceleration &acceleration, Vector &x, const unsigned int n)
  {
    Vector image;
    for (unsigned int k = 0; k < n; ++k)
      {
        map(x, image);
        acceleration.add(x, image);
        acceleration.extrapolate(x);
      }
  }



  template <typename Kept>
  void
  export_state(Kept &from, Kept &to)
  {
    MemoryArchive archive;
    from.serialize(archive);
    archive.turn();
    to.serialize(archive);
  }



  /** The largest difference of iterates after @p n_before and some more. */
  double
  difference_of_iterations(const unsigned int n_before)
  {
    constexpr unsigned int               n_after = 4;
    const AndersonAcceleration::Settings settings{5};
    AndersonAcceleration whole(settings), left(settings), resumed(settings);
    Vector               x(n_unknowns), y(n_unknowns);
    iterate(whole, x, n_before + n_after);

    iterate(left, y, n_before);
    export_state(left, resumed);
    iterate(resumed, y, n_after);
    y -= x;
    return y.linfty_norm() + std::abs(whole.unexplained_distance() -
                                      resumed.unexplained_distance());
  }



  double
  difference_of_contractions(const unsigned int n_before)
  {
    Contraction whole, left, resumed;
    const auto  change = [](const unsigned int k) {
      return std::pow(0.5, k) * (1. + 0.9 * std::sin(1.7 * k));
    };
    for (unsigned int k = 0; k < n_before; ++k)
      {
        whole.add(change(k), k > 0);
        left.add(change(k), k > 0);
      }
    export_state(left, resumed);
    double difference = 0.;
    for (unsigned int k = n_before; k < n_before + 3; ++k)
      {
        const double a = whole.add(change(k), k > 0);
        const double b = resumed.add(change(k), k > 0);
        difference += std::isnan(a) && std::isnan(b) ? 0. : std::abs(a - b);
      }
    return difference;
  }



  void
  runs_go_on()
  {
    RunState left, resumed;
    left.result.periods       = 7;
    left.result.stress_change = {1e-3};
    left.largest_opening      = 0.25;
    left.method_failed        = true;
    export_state(left, resumed);
    check("a run knows its periods and their changes",
          resumed.result.periods == 7 &&
            resumed.result.stress_change == left.result.stress_change);
    check("a run knows its largest opening", resumed.largest_opening == 0.25);
    check("a run knows that harmonic balance has failed",
          resumed.method_failed);
  }
} // namespace



void
kept_state()
{
  for (const unsigned int n : {0, 1, 3, 9})
    {
      const std::string left = "left after " + std::to_string(n) + ": ";
      check(left + "iterates are the same", difference_of_iterations(n) == 0.);
      check(left + "estimates are the same",
            difference_of_contractions(n) == 0.);
    }
  runs_go_on();
}
