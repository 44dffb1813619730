// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/contact/certificate.h>
#include <crevasse/contact/coulomb_law.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iomanip>

namespace Crevasse
{
  using namespace dealii;

  void
  Scales::include(const SignoriniProblem &problem,
                  const Vector           &right_hand_side,
                  const Vector           &solution)
  {
    double here[] = {0., 0., 0.};
    for (unsigned int i = 0; i < solution.locally_owned_size(); ++i)
      {
        const double b  = std::abs(right_hand_side.local_element(i));
        const double q  = std::abs(solution.local_element(i));
        const double Aq = problem.diagonal().local_element(i) * q;
        here[0]         = std::max(here[0], b);
        here[1]         = std::max(here[1], q);
        here[2]         = std::max(here[2], Aq);
      }
    Utilities::MPI::max(here, problem.stiffness.get_mpi_communicator(), here);
    largest_force         = std::max(largest_force, here[0]);
    displacement_to_round = std::max(displacement_to_round, here[1]);
    force_to_round        = std::max(force_to_round, here[2]);
    // The viscous strain of a few periods corresponds to a few times the load.
    constexpr double long_drift = 4.;
    if (load == 0. || here[0] <= long_drift * load ||
        largest_displacement == 0.)
      largest_displacement = std::max(largest_displacement, here[1]);
  }



  double
  Scales::force() const
  {
    // A load that is this much smaller than the force of the accumulated drift
    // counts as no load.
    constexpr double least_load = 1e-6;
    const double     largest    = std::max(load, least_load * largest_force);
    if (load > 0.)
      return largest;
    return largest_force > 0. ? largest_force : 1.;
  }



  double
  Certificate::worst() const
  {
    // Comparisons ignore NaN, sums do not.
    if (std::isnan(penetration + tension + complementarity + residual +
                   friction))
      return std::numeric_limits<double>::infinity();
    return std::max(
      {penetration, tension, complementarity, residual, friction});
  }



  void
  Certificate::merge(const Certificate &other)
  {
    penetration     = std::max(penetration, other.penetration);
    tension         = std::max(tension, other.tension);
    complementarity = std::max(complementarity, other.complementarity);
    residual        = std::max(residual, other.residual);
    friction        = std::max(friction, other.friction);
    newton_residual = std::max(newton_residual, other.newton_residual);
  }



  std::string
  Certificate::describe() const
  {
    return Text::Message() << std::setprecision(3) << "penetration "
                           << penetration << ", tension " << tension
                           << ", complementarity " << complementarity
                           << ", residual " << residual
                           << (friction > 0. ? ", friction " +
                                                 Text::from_number(friction, 3)
                                             : "");
  }



  namespace
  {
    /** Moves the forces along tangents from the residual to @p contact_forces.
     * @return the largest violation of Coulomb's law, relative to the scales.
     */
    double
    take_friction(const UnilateralBounds &bounds,
                  const Candidate        &candidate,
                  const Scales           &scales,
                  Vector                 &residual,
                  ContactForces          &contact_forces)
    {
      const FrictionState &friction = *candidate.friction;
      const std::size_t    n        = bounds.tangents.size();
      contact_forces.tangential.resize(n);
      for (auto &along : contact_forces.tangential)
        along.resize(bounds.dofs.size());
      double worst = 0.;
      for (unsigned int k = 0; k < bounds.dofs.size(); ++k)
        {
          Tensor<1, 2> force, slip;
          for (std::size_t c = 0; c < n; ++c)
            if (const auto i = bounds.tangents[c][k];
                i != numbers::invalid_dof_index)
              {
                contact_forces.tangential[c][k] = residual(i);
                force[c]                        = residual(i) / scales.force();
                slip[c] = (candidate.solution(i) - friction.reference[c][k]) /
                          scales.displacement();
                residual(i) = 0.;
              }
          const double limit = friction.coefficients[k] *
                               std::max(contact_forces.normal[k], 0.) /
                               scales.force();
          worst = std::max(worst, violation_of_friction(force, limit, slip));
        }
      return worst;
    }
  } // namespace



  Certificate
  certify(const SignoriniProblem &problem,
          const Candidate        &candidate,
          Scales                 &scales,
          Vector                 &residual,
          ContactForces          &contact_forces)
  {
    const UnilateralBounds &bounds   = problem.bounds;
    const Vector           &solution = candidate.solution;
    scales.include(problem, candidate.right_hand_side, solution);
    const double force        = scales.force();
    const double displacement = scales.displacement();

    problem.stiffness.vmult(residual, solution);
    residual -= candidate.right_hand_side;

    Certificate certificate;
    contact_forces.normal.resize(bounds.dofs.size());
    for (unsigned int k = 0; k < bounds.dofs.size(); ++k)
      {
        const auto   i = bounds.dofs[k];
        const double opening =
          (bounds.sign[k] * solution(i) - bounds.gap[k]) / displacement;
        contact_forces.normal[k] = bounds.sign[k] * residual(i);
        const double g           = contact_forces.normal[k] / force;
        residual(i)              = 0.;
        certificate.merge(
          {-opening, -g, std::min(std::abs(g), std::abs(opening)), 0.});
      }
    if (candidate.friction != nullptr)
      certificate.friction =
        take_friction(bounds, candidate, scales, residual, contact_forces);

    // Comparisons alone would ignore values that are not finite.
    bool   is_finite = std::isfinite(force) && std::isfinite(displacement);
    double largest   = 0.;
    for (const double entry : residual)
      {
        is_finite = is_finite && std::isfinite(entry);
        largest   = std::max(largest, std::abs(entry));
      }
    certificate.residual =
      is_finite ? largest / force : std::numeric_limits<double>::infinity();

    double all[] = {certificate.penetration,
                    certificate.tension,
                    certificate.complementarity,
                    certificate.residual,
                    certificate.friction};
    Utilities::MPI::max(all, problem.stiffness.get_mpi_communicator(), all);
    return {all[0], all[1], all[2], all[3], all[4]};
  }
} // namespace Crevasse
