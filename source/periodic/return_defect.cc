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


#include <crevasse/periodic/return_defect.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>

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
  ReturnDefect<dim>::ReturnDefect(const QuadratureField<dim> &points,
                                  const MaterialState<dim>   &material,
                                  const double                slowness,
                                  const SecularFlow          *flow,
                                  const bool                  is_split,
                                  const double                period,
                                  const UnilateralBounds     &bounds,
                                  const bool                  opening_excuses)
    : n_points(points.n_local_points())
    , material(material)
    , slowness(slowness)
    , flow(flow)
    , is_split(is_split)
    , period(period)
    , bounds(bounds)
    , opening_excuses(opening_excuses && material.spring <= 1e-10)
  {
  }



  template <int dim>
  double
  ReturnDefect<dim>::operator()(const Vector &before,
                                const Vector &after,
                                const double  stress) const
  {
    using Field                    = QuadratureField<dim>;
    constexpr double      rounding = 1e-12, resolved = 10.;
    std::array<double, 2> largest{}; // what is left, and what it is left of
    std::size_t           offset = 0;
    for (std::size_t point = 0; point < n_points; ++point)
      for (const double fraction : material.fractions)
        {
          const VoigtMatrix<dim> &K      = (*material.stiffness)[point];
          const VoigtVector<dim>  strain = Field::get(after, offset);
          VoigtVector<dim>        change = strain - Field::get(before, offset);
          if (flow != nullptr && !is_split)
            change -= period * Field::get(flow->strain_rate, offset);
          largest[0] =
            std::max(largest[0], fraction * largest_entry(K * change));
          largest[1] =
            std::max(largest[1], fraction * largest_entry(K * strain));
          offset += Field::n_components;
        }
    Utilities::MPI::max(ArrayView<const double>(largest.data(), 2),
                        before.get_mpi_communicator(),
                        ArrayView<double>(largest.data(), 2));
    const double left = material.stiffness_factor * largest[0];
    if (left <=
        rounding * std::max(stress, material.stiffness_factor * largest[1]))
      return 0.;
    return resolved * slowness * left / stress;
  }



  template <int dim>
  bool
  ReturnDefect<dim>::is_excused(const Vector &before, const Vector &after) const
  {
    constexpr double rounding = 1e-10;
    if (!opening_excuses)
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



  template class ReturnDefect<2>;
  template class ReturnDefect<3>;
} // namespace Crevasse
