// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

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
  Scales::set_force_scale(const double largest_nodal_force)
  {
    load = largest_nodal_force;
  }



  void
  Scales::include(const SignoriniProblem &problem,
                  const Vector           &right_hand_side,
                  const Vector           &solution)
  {
    std::array<double, 3> here{{0., 0., 0.}};
    for (unsigned int i = 0; i < solution.locally_owned_size(); ++i)
      {
        const double b  = std::abs(right_hand_side.local_element(i));
        const double q  = std::abs(solution.local_element(i));
        const double Aq = problem.diagonal().local_element(i) * q;
        here            = {
                     {std::max(here[0], b), std::max(here[1], q), std::max(here[2], Aq)}};
      }
    Utilities::MPI::max(ArrayView<const double>(here.data(), here.size()),
                        problem.stiffness.get_mpi_communicator(),
                        ArrayView<double>(here.data(), here.size()));

    largest_force         = std::max(largest_force, here[0]);
    displacement_to_round = std::max(displacement_to_round, here[1]);
    force_to_round        = std::max(force_to_round, here[2]);
    // The viscous strain of a few periods makes up for a few times the load.
    constexpr double long_drift = 4.;
    if (load == 0. || here[0] <= long_drift * load ||
        largest_displacement == 0.)
      largest_displacement = std::max(largest_displacement, here[1]);
  }



  namespace
  {
    constexpr double some_roundings =
      100. * std::numeric_limits<double>::epsilon();
  }



  double
  Scales::force() const
  {
    // However long the drift, a load that is so much smaller than what it has
    // added up to is no load.
    constexpr double least_load = 1e-6;
    const double     largest    = std::max(load, least_load * largest_force);
    if (load > 0.)
      return largest;
    return largest_force > 0. ? largest_force : 1.;
  }



  double
  Scales::displacement() const
  {
    return largest_displacement > 0. ? largest_displacement : 1.;
  }



  double
  Scales::force_rounding() const
  {
    return some_roundings * force_to_round / force();
  }



  double
  Scales::displacement_rounding() const
  {
    return some_roundings * displacement_to_round / displacement();
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
    const double force        = scales.force();
    const double displacement = scales.displacement();

    problem.stiffness.vmult(residual, solution);
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
                        problem.stiffness.get_mpi_communicator(),
                        ArrayView<double>(contact.data(), contact.size()));
    certificate.penetration     = contact[0];
    certificate.tension         = contact[1];
    certificate.complementarity = contact[2];
    return certificate;
  }
} // namespace Crevasse
