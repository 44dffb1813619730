// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/periodic/contraction.h>
#include <crevasse/periodic/return_defect.h>


namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    template <int n>
    double
    largest_entry(const Tensor<1, n> &values)
    {
      double largest = 0.;
      for (unsigned int i = 0; i < n; ++i)
        largest = std::max(largest, std::abs(values[i]));
      return largest;
    }
  } // namespace



  template <int dim>
  double
  ReturnDefect<dim>::operator()(const Vector &before,
                                const Vector &after,
                                const double  largest_stress) const
  {
    using Field               = QuadratureField<dim>;
    constexpr double rounding = 1e-12, resolved = 10.;
    // What is left, what it is left of, and what it makes of the mean stress.
    double      largest[3] = {};
    std::size_t offset     = 0;
    for (std::size_t point = 0; point < n_points; ++point)
      for (unsigned int i = 0; i < material.fractions.size(); ++i)
        {
          const VoigtMatrix<dim> K = material.stiffness_factor *
                                     material.fractions[i] *
                                     (*material.stiffness)[point];
          const VoigtVector<dim> strain = Field::get(after, offset);
          VoigtVector<dim>       left   = strain - Field::get(before, offset);
          if (flow != nullptr && !is_split)
            left -= period * Field::get(flow->strain_rate, offset);
          const VoigtVector<dim> stress = K * left;
          const double           size   = largest_entry(stress);
          const double           relaxed =
            largest_entry(K * ((*material.fluidity[i])[point] * stress)) *
            period * mean_fluidity_factor;
          largest[1] = std::max(largest[1], largest_entry(K * strain));
          if (size > 0.)
            {
              // Rounding of the mean stress leaves T/τ times that.
              const double rate = relaxed / size;
              largest[0] = std::max(largest[0], size / std::max(1., rate));
              largest[2] =
                std::max(largest[2], size * slowness_of_relaxation(rate));
            }
          offset += Field::n_components;
        }
    Utilities::MPI::max(largest, before.get_mpi_communicator(), largest);
    if (largest[0] <= rounding * std::max(largest_stress, largest[1]))
      return 0.;
    return resolved * largest[2] / largest_stress;
  }



  template <int dim>
  bool
  ReturnDefect<dim>::lip_opens(const Vector &before, const Vector &after) const
  {
    constexpr double rounding = 1e-10;
    if (material.spring > rounding)
      return false;
    const double small = rounding * after.linfty_norm();
    bool         opens = true;
    for (unsigned int k = 0; k < bounds.dofs.size(); ++k)
      {
        const auto dof  = bounds.dofs[k];
        double     gain = after(dof) - before(dof);
        if (flow != nullptr && is_split)
          gain += period * flow->velocity(dof);
        opens = opens && bounds.sign[k] * gain >= -small &&
                bounds.sign[k] * after(dof) - bounds.gap[k] > small;
      }
    return Utilities::MPI::min(opens ? 1 : 0, after.get_mpi_communicator()) ==
           1;
  }



  template struct ReturnDefect<2>;
  template struct ReturnDefect<3>;
} // namespace Crevasse
