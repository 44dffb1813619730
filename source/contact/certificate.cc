// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/contact/certificate.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** The largest |entry| over all ranks; infinite if one is not finite, which
     * comparisons alone would overlook. */
    double
    largest_entry(const Vector &vector)
    {
      double largest = 0.;
      for (unsigned int i = 0; i < vector.locally_owned_size(); ++i)
        {
          const double entry = std::abs(vector.local_element(i));
          largest            = std::isfinite(entry)
                                 ? std::max(largest, entry)
                                 : std::numeric_limits<double>::infinity();
        }
      return Utilities::MPI::max(largest, vector.get_mpi_communicator());
    }
  } // namespace



  void
  Scales::include(const SignoriniProblem &problem,
                  const Vector           &right_hand_side,
                  const Vector           &solution)
  {
    for (unsigned int i = 0; i < solution.locally_owned_size(); ++i)
      {
        const double b = std::abs(right_hand_side.local_element(i));
        const double q = std::abs(solution.local_element(i));
        force = std::max({force, b, problem.diagonal().local_element(i) * q});
        displacement = std::max(displacement, q);
      }
    for (const double gap : problem.bounds.gap)
      displacement = std::max(displacement, std::abs(gap));

    std::array<double, 2> both{{force, displacement}};
    Utilities::MPI::max(ArrayView<const double>(both.data(), both.size()),
                        problem.matrix.get_mpi_communicator(),
                        ArrayView<double>(both.data(), both.size()));
    force        = both[0];
    displacement = both[1];
  }



  double
  Certificate::worst() const
  {
    // Comparisons overlook nan, sums do not.
    if (std::isnan(penetration + tension + complementarity + residual))
      return std::numeric_limits<double>::infinity();
    return std::max({penetration, tension, complementarity, residual});
  }



  void
  Certificate::merge(const Certificate &other)
  {
    penetration     = std::max(penetration, other.penetration);
    tension         = std::max(tension, other.tension);
    complementarity = std::max(complementarity, other.complementarity);
    residual        = std::max(residual, other.residual);
  }



  std::string
  Certificate::describe() const
  {
    std::ostringstream text;
    text << "penetration " << penetration << ", tension " << tension
         << ", complementarity " << complementarity << ", residual "
         << residual;
    return text.str();
  }



  Certificate
  certify(const SignoriniProblem &problem,
          const Vector           &right_hand_side,
          const Vector           &solution,
          Scales                 &scales,
          Vector                 &residual,
          std::vector<double>    &contact_forces)
  {
    const UnilateralBounds &bounds = problem.bounds;
    scales.include(problem, right_hand_side, solution);
    // Nothing was ever loaded or moved: then any scale will do.
    const double force = scales.force > 0. ? scales.force : 1.;
    const double displacement =
      scales.displacement > 0. ? scales.displacement : 1.;

    problem.matrix.vmult(residual, solution);
    residual -= right_hand_side;

    Certificate certificate;
    contact_forces.resize(bounds.dofs.size());
    for (unsigned int k = 0; k < bounds.dofs.size(); ++k)
      {
        const auto   i = bounds.dofs[k];
        const double opening =
          (bounds.sign[k] * solution(i) - bounds.gap[k]) / displacement;
        contact_forces[k] = bounds.sign[k] * residual(i);
        const double g    = contact_forces[k] / force;
        residual(i)       = 0.;
        certificate.merge(
          {-opening, -g, std::min(std::abs(g), std::abs(opening)), 0.});
      }

    certificate.residual = largest_entry(residual) / force;
    if (!std::isfinite(force) || !std::isfinite(displacement))
      certificate.residual = std::numeric_limits<double>::infinity();

    std::array<double, 3> contact{{certificate.penetration,
                                   certificate.tension,
                                   certificate.complementarity}};
    Utilities::MPI::max(ArrayView<const double>(contact.data(), contact.size()),
                        problem.matrix.get_mpi_communicator(),
                        ArrayView<double>(contact.data(), contact.size()));
    certificate.penetration     = contact[0];
    certificate.tension         = contact[1];
    certificate.complementarity = contact[2];
    return certificate;
  }
} // namespace Crevasse
