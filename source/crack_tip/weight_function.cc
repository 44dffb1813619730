// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/crack_tip/weight_function.h>

#include <deal.II/base/mpi.h>

namespace Crevasse
{
  using namespace dealii;

  WeightFunction::WeightFunction(Vector                   &&influence,
                                 const UnilateralBounds    &bounds,
                                 const std::vector<double> &of_lip)
    : influence(std::move(influence))
    , of_contact_forces(of_lip)
  {
    of_contact_forces.resize(bounds.dofs.size(), 0.);
    for (std::size_t k = 0; k < of_contact_forces.size(); ++k)
      of_contact_forces[k] += bounds.sign[k] * this->influence(bounds.dofs[k]);
  }



  double
  WeightFunction::value(const Vector              &loads,
                        const std::vector<double> &contact_forces) const
  {
    double of_forces = 0.;
    for (std::size_t k = 0; k < contact_forces.size(); ++k)
      of_forces += of_contact_forces[k] * contact_forces[k];
    return influence * loads +
           Utilities::MPI::sum(of_forces, loads.get_mpi_communicator());
  }
} // namespace Crevasse
