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
    , degree(space.finite_element().degree)
    , n_cell_points(space.quadratures()[0].size())
    , mean_volume(space.volumetric_strain() == VolumetricStrain::mean)
    , matrix_free(space.matrix_free())
  {
    Assert(degree == 1 || degree == 2, ExcNotImplemented());

    if constexpr (dim == 2)
      if (space.singular_shapes() != nullptr)
        enrichment = std::make_unique<Enrichment>(space, points);

    batch_offsets.resize(matrix_free->n_cell_batches());
    for (unsigned int batch = 0; batch < batch_offsets.size(); ++batch)
      for (unsigned int lane = 0;
           lane < matrix_free->n_active_entries_per_cell_batch(batch);
           ++lane)
        batch_offsets[batch][lane] =
          points.offset(matrix_free->get_cell_iterator(batch, lane));
  }



  template <int dim>
  void
  StrainOperator<dim>::initialize(Vector &displacement) const
  {
    if (enrichment != nullptr)
      displacement = space.ghosted_vector();
    else
      matrix_free->initialize_dof_vector(displacement);
  }



  template class StrainOperator<2>;
  template class StrainOperator<3>;
} // namespace Crevasse
