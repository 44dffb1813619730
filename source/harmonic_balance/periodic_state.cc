// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/harmonic_balance/periodic_state.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    LipVector
    joined(const std::vector<LipVector> &instants)
    {
      LipVector all(instants.size() * instants[0].size());
      auto      end = all.begin();
      for (const LipVector &instant : instants)
        end = std::copy(instant.begin(), instant.end(), end);
      return all;
    }
  } // namespace



  PeriodicState::PeriodicState(const PeriodicContactProblem &problem,
                               const PeriodicConvolution    &convolution)
    : forces(convolution.n_nodes * convolution.n_instants)
    , offsets(convolution.n_nodes)
    , centre(forces.size())
    , convolution(convolution)
    , without_contact(joined(problem.openings_without_contact))
    , mean_forces(problem.mean_forces)
  {
  }



  void
  PeriodicState::compute_openings()
  {
    convolution.vmult(openings, forces);
    openings += without_contact;
    openings.add(shift, forces, -shift, centre);
    for (unsigned int k = 0; k < openings.size(); ++k)
      openings(k) += offsets(k % offsets.size());
  }



  LipVector
  PeriodicState::missing_means() const
  {
    LipVector missing(mean_forces);
    for (unsigned int k = 0; k < forces.size() && !convolution.has_mean; ++k)
      missing(k % missing.size()) -= forces(k) / convolution.n_instants;
    return missing;
  }



  PeriodicContactCertificate
  PeriodicState::certify() const
  {
    const double force = force_scale(), length = opening_scale();
    const double opening = length > 0. ? length : 1.;
    const auto   enlarge = [](double &largest, const double value) {
      // A largest value that is nan stays nan.
      if (!std::isnan(largest) && !(value <= largest))
        largest = value;
    };
    PeriodicContactCertificate result;
    for (unsigned int k = 0; k < forces.size(); ++k)
      {
        const double g = forces(k) / force, w = openings(k) / opening;
        enlarge(result.tension, -g);
        enlarge(result.penetration, -w);
        enlarge(result.complementarity, std::abs(g * w));
      }
    for (const double missing : missing_means())
      enlarge(result.mean_defect, std::abs(missing) / force);
    return result;
  }



  double
  PeriodicContactCertificate::worst() const
  {
    // Comparisons overlook nan, sums do not.
    if (std::isnan(penetration + tension + complementarity + mean_defect))
      return std::numeric_limits<double>::infinity();
    return std::max({penetration, tension, complementarity, mean_defect});
  }



  std::string
  PeriodicContactCertificate::describe() const
  {
    return Text::Message() << std::setprecision(3)
                           << "certificate: penetration " << penetration
                           << ", tension " << tension << ", complementarity "
                           << complementarity << ", defect of the mean "
                           << mean_defect;
  }



  PeriodicContactCertificate
  certify(const PeriodicContactProblem  &problem,
          const PeriodicContactSolution &solution)
  {
    const PeriodicConvolution convolution(problem,
                                          solution.offsets.size(),
                                          solution.forces.size());
    PeriodicState             state(problem, convolution);
    state.forces  = joined(solution.forces);
    state.offsets = solution.offsets;
    state.compute_openings();
    return state.certify();
  }
} // namespace Crevasse
