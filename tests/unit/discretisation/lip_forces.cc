// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// The line that continues forces of lips to a tip or front: it leaves a linear
// pressure as it is, wrong forces next to the tip do not count, and forces may
// be those of either lip.

#include <crevasse/crack_tip/lip_forces.h>

#include <crevasse_tests/tests.h>

using namespace Crevasse;

namespace
{
  constexpr double begin = 0.25, reach = 1.;

  /** Nodes at the distances 0.05, 0.1, … 1 in rows along a front. */
  std::vector<LipForces::Node>
  nodes(const unsigned int n_rows)
  {
    std::vector<LipForces::Node> all;
    for (unsigned int row = 0; row < n_rows; ++row)
      for (unsigned int i = 1; i <= 20; ++i)
        {
          const double r    = 0.05 * i;
          const double area = i % 2 == 0 ? 0.02 : 0.04; // as of quadratics
          const double sign = i % 3 == 0 ? -1. : 1.;
          all.push_back({all.size(),
                         sign * (r < 0.5 ? 0.5 - r : 0.) / std::sqrt(r),
                         r,
                         0.2 * row,
                         area,
                         sign});
        }
    return all;
  }

  /** The contribution of a pressure, wrong up to a distance. */
  double
  contribution(const LipForces                    &lips,
               const std::vector<LipForces::Node> &nodes,
               const double                        wrong_up_to)
  {
    std::vector<double> forces, normal(nodes.size(), 1.);
    for (const LipForces::Node &node : nodes)
      forces.push_back(
        node.sign * node.area *
        (node.distance < wrong_up_to ? -3. : 2. - node.distance));
    LipForces::Sums sums{};
    lips.add(forces, normal, sums);
    return LipForces::chosen(sums);
  }
} // namespace

void
lip_forces()
{
  for (const unsigned int n_rows : {1, 3})
    {
      section(n_rows == 1 ? "tip" : "front");
      const auto      all = nodes(n_rows);
      const LipForces plain(all), with_line(all, begin, reach, MPI_COMM_SELF);
      const double    exact = contribution(plain, all, 0.);
      check_below("linear pressure",
                  std::abs(contribution(with_line, all, 0.) / exact - 1.),
                  1e-12);
      check_below("wrong next to the tip",
                  std::abs(contribution(with_line, all, 0.2) / exact - 1.),
                  1e-12);
      check("matters without the line",
            std::abs(contribution(plain, all, 0.2) / exact - 1.) > 0.1);
    }
}
