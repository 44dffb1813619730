// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/strain_operator.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Loops over the cells near singular functions, in whose batches special
     * cells are by themselves. */
    template <int dim>
    std::shared_ptr<const MatrixFree<dim, double>>
    around_special_cells(const Space<dim> &space)
    {
      typename MatrixFree<dim, double>::AdditionalData data;
      data.mapping_update_flags = update_gradients | update_JxW_values;
      data.tasks_parallel_scheme =
        MatrixFree<dim, double>::AdditionalData::none;
      if constexpr (dim == 2)
        {
          data.cell_vectorization_categories_strict = true;
          for (const auto &cell : space.mesh().active_cell_iterators())
            data.cell_vectorization_category.push_back(
              cell->is_locally_owned() && Enrichment::is_special(space, cell)
                ? 1
                : 0);
        }
      auto loops = std::make_shared<MatrixFree<dim, double>>();
      loops->reinit(space.mapping(),
                    space.dof_handler(),
                    space.constraints(),
                    QGauss<1>(space.finite_element().degree + 2),
                    data);
      return loops;
    }
  } // namespace



  template <int dim>
  StrainOperator<dim>::StrainOperator(const Space<dim>           &space,
                                      const QuadratureField<dim> &points)
    : degree(space.finite_element().degree)
    , n_cell_points(space.quadratures()[0].size())
    , mean_volume(space.volumetric_strain() == VolumetricStrain::mean)
  {
    Assert(degree == 1 || degree == 2, ExcNotImplemented());

    matrix_free = space.singular_shapes() == nullptr
                    ? space.matrix_free()
                    : around_special_cells(space);
    if constexpr (dim == 2)
      if (space.singular_shapes() != nullptr)
        {
          Vector nodal;
          matrix_free->initialize_dof_vector(nodal);
          enrichment = std::make_unique<Enrichment>(space, points, nodal);
        }

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
      enrichment->initialize(displacement);
    else
      matrix_free->initialize_dof_vector(displacement);
  }



  template <int dim>
  bool
  StrainOperator<dim>::has_batch(const unsigned int batch) const
  {
    return enrichment == nullptr || matrix_free->get_cell_category(batch) == 0;
  }



  template class StrainOperator<2>;
  template class StrainOperator<3>;
} // namespace Crevasse
