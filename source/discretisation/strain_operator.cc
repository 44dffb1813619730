// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/strain_operator.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  StrainOperator<dim>::StrainOperator(const Space<dim>           &space,
                                      const QuadratureField<dim> &points)
    : space(space)
    , n_cell_points(space.quadratures[0].size())
    , loops(space.cell_loops())
    , kernels(loops->template kernels<double>())
  {
    if constexpr (dim == 2)
      if (space.singular_shapes() != nullptr)
        enrichment = std::make_unique<Enrichment>(space, points);
    loops->for_each_cell([&](const auto &cell, const unsigned int) {
      offsets.push_back(points.offset(cell));
    });
  }



  template <int dim>
  void
  StrainOperator<dim>::initialize(Vector &displacement) const
  {
    if (enrichment != nullptr)
      displacement = space.ghosted_vector();
    else
      loops->initialize(displacement);
  }



  template class StrainOperator<2>;
  template class StrainOperator<3>;
} // namespace Crevasse
