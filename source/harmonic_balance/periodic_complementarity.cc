// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/harmonic_balance/periodic_complementarity.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  PeriodicComplementarity::PeriodicComplementarity(
    const PeriodicContactProblem &problem,
    const PeriodicConvolution    &convolution)
    : convolution(convolution)
    , openings_without_contact(convolution.n_nodes() * convolution.n_instants())
    , mean_openings(convolution.n_nodes())
    , mean_forces(problem.mean_forces)
  {
    const unsigned int p = convolution.n_nodes();
    const unsigned int N = convolution.n_instants();
    AssertDimension(problem.openings_without_contact.size(), N);
    AssertDimension(mean_forces.size(), p);
    for (unsigned int i = 0; i < p; ++i)
      AssertThrow(mean_forces(i) > 0. && std::isfinite(mean_forces(i)),
                  ExcMessage("A mean contact force is not positive."));

    for (const dealii::Vector<double> &opening :
         problem.openings_without_contact)
      {
        AssertDimension(opening.size(), p);
        mean_openings.add(1. / N, opening);
      }
    for (unsigned int j = 0; j < N; ++j)
      for (unsigned int i = 0; i < p; ++i)
        {
          const double w_0 = problem.openings_without_contact[j](i);
          AssertThrow(std::isfinite(w_0),
                      ExcMessage("An opening without contact is not finite."));
          openings_without_contact(j * p + i) = w_0 - mean_openings(i);
        }
  }



  void
  PeriodicComplementarity::compute_openings(PeriodicState &state) const
  {
    const unsigned int p = convolution.n_nodes();
    convolution.vmult(state.openings, state.forces);
    state.openings += openings_without_contact;
    for (unsigned int k = 0; k < state.openings.size(); ++k)
      state.openings(k) += state.offsets(k % p);
  }



  double
  PeriodicComplementarity::force_scale(const PeriodicState &state) const
  {
    return std::max(state.forces.linfty_norm(), mean_forces.linfty_norm());
  }



  double
  PeriodicComplementarity::opening_scale(const PeriodicState &state) const
  {
    return openings_without_contact.linfty_norm() +
           convolution.largest_compliance() * force_scale(state);
  }



  PeriodicContactSolution
  PeriodicComplementarity::solution(const PeriodicState &state) const
  {
    const unsigned int      p = convolution.n_nodes();
    const unsigned int      N = convolution.n_instants();
    PeriodicContactSolution result;
    result.forces.resize(N, dealii::Vector<double>(p));
    result.openings = result.forces;
    for (unsigned int j = 0; j < N; ++j)
      {
        std::copy_n(state.forces.begin() + j * p, p, result.forces[j].begin());
        std::copy_n(state.openings.begin() + j * p,
                    p,
                    result.openings[j].begin());
      }
    result.offsets = state.offsets;
    result.offsets -= mean_openings;
    return result;
  }
} // namespace Crevasse
