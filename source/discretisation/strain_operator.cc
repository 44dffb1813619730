// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/shape_strains.h>
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
  {
    Assert(degree == 1 || degree == 2, ExcNotImplemented());

    if (space.singular_shapes() != nullptr)
      {
        ShapeStrains<dim> shapes(space);
        for (const auto &cell : space.dof_handler().active_cell_iterators())
          if (cell->is_locally_owned())
            {
              const FEValues<dim> &values = shapes.reinit(cell);
              StoredCell           stored;
              stored.offset  = points.offset(cell);
              stored.weights = values.get_JxW_values();
              stored.strains.resize(stored.weights.size());
              space.get_unknowns(cell, stored.unknowns);
              for (const unsigned int q : values.quadrature_point_indices())
                shapes.at_point(q, stored.strains[q]);
              stored_cells.push_back(std::move(stored));
            }
        return;
      }
    matrix_free = space.matrix_free();
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
    if (matrix_free == nullptr)
      displacement = space.ghosted_vector();
    else
      matrix_free->initialize_dof_vector(displacement);
  }



  template class StrainOperator<2>;
  template class StrainOperator<3>;
} // namespace Crevasse
