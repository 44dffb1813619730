// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/cell_values.h>
#include <crevasse/discretisation/stiffness.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** The strain of the shape function with the one nonzero component
     * @p component. */
    template <int dim>
    VoigtVector<dim>
    shape_strain(const Tensor<1, dim> &gradient, const unsigned int component)
    {
      VoigtVector<dim> strain;
      for (unsigned int d = 0; d < dim; ++d)
        strain[voigt_index<dim>(component, d)] = gradient[d];
      return strain;
    }



    /** The means over a cell of the dilatations of its shape functions. */
    template <int dim>
    std::vector<double>
    mean_dilatations(const FEValues<dim> &values)
    {
      const FiniteElement<dim> &fe = values.get_fe();
      std::vector<double>       means(fe.n_dofs_per_cell(), 0.);
      double                    volume = 0.;
      for (const unsigned int q : values.quadrature_point_indices())
        {
          volume += values.JxW(q);
          for (unsigned int i = 0; i < means.size(); ++i)
            {
              const unsigned int c = fe.system_to_component_index(i).first;
              means[i] +=
                values.shape_grad_component(i, q, c)[c] * values.JxW(q);
            }
        }
      for (double &mean : means)
        mean /= volume;
      return means;
    }



    /** Adds a dilatation in equal parts to all three directions. */
    template <int dim>
    void
    add_dilatation(VoigtVector<dim> &strain, const double dilatation)
    {
      for (unsigned int i = 0; i < 3; ++i)
        strain[i] += dilatation / 3.;
    }



    /** Strains of all shape functions of a cell, those of the nodes and the
     * singular ones. */
    template <int dim>
    class ShapeStrains
    {
    public:
      explicit ShapeStrains(const Space<dim> &space)
        : space(space)
        , fe(space.finite_element())
        , cell_values(space, flags(space))
        , mean_volume(space.volumetric_strain() == VolumetricStrain::mean)
      {
      }



      const FEValues<dim> &
      reinit(const typename DoFHandler<dim>::active_cell_iterator &cell)
      {
        values = &cell_values.reinit(cell);
        if (mean_volume)
          means = mean_dilatations(*values);
        if constexpr (dim == 2)
          if (const SingularShapes *shapes = space.singular_shapes())
            {
              singular_gradients.resize(shapes->size());
              for (unsigned int k = 0; k < shapes->size(); ++k)
                shapes->gradients(k, *values, singular_gradients[k]);
            }
        return *values;
      }



      void
      at_point(const unsigned int             q,
               std::vector<VoigtVector<dim>> &strains) const
      {
        strains.clear();
        for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
          {
            const unsigned int   c = fe.system_to_component_index(i).first;
            const Tensor<1, dim> gradient =
              values->shape_grad_component(i, q, c);
            strains.push_back(shape_strain<dim>(gradient, c));
            if (mean_volume)
              add_dilatation<dim>(strains.back(), means[i] - gradient[c]);
          }
        for (const auto &gradients : singular_gradients)
          strains.push_back(voigt_strain<dim>(gradients[q]));
      }

    private:
      static UpdateFlags
      flags(const Space<dim> &space)
      {
        return update_gradients | update_JxW_values |
               (space.singular_shapes() != nullptr ? update_quadrature_points
                                                   : update_default);
      }

      const Space<dim>                        &space;
      const FESystem<dim>                     &fe;
      CellValues<dim>                          cell_values;
      const bool                               mean_volume;
      const FEValues<dim>                     *values = nullptr;
      std::vector<double>                      means;
      std::vector<std::vector<Tensor<2, dim>>> singular_gradients;
    };



    template <int dim>
    void
    initialize_matrix(const Space<dim> &space, SparseMatrix &matrix)
    {
      const IndexSet                   &owned = space.locally_owned_unknowns();
      TrilinosWrappers::SparsityPattern sparsity(
        owned, owned, space.locally_relevant_unknowns(), space.communicator());
      std::vector<types::global_dof_index> indices;
      for (const auto &cell : space.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          {
            space.get_unknowns(cell, indices);
            space.constraints().add_entries_local_to_global(indices,
                                                            sparsity,
                                                            false);
          }
      sparsity.compress();
      matrix.reinit(sparsity);
    }
  } // namespace



  template <int dim>
  void
  assemble_stiffness(const Space<dim>                    &space,
                     const QuadratureField<dim>          &points,
                     const PointValues<VoigtMatrix<dim>> &stiffness,
                     SparseMatrix                        &matrix)
  {
    if (matrix.m() == 0)
      initialize_matrix(space, matrix);
    else
      matrix = 0.;

    ShapeStrains<dim>                    shapes(space);
    std::vector<types::global_dof_index> indices;
    std::vector<VoigtVector<dim>>        strains;
    FullMatrix<double>                   cell_matrix;
    for (const auto &cell : space.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const FEValues<dim> &values = shapes.reinit(cell);
          space.get_unknowns(cell, indices);
          const unsigned int n = indices.size();
          cell_matrix.reinit(n, n);
          const std::size_t first =
            points.offset(cell) / n_stress_components<dim>;
          for (const unsigned int q : values.quadrature_point_indices())
            {
              shapes.at_point(q, strains);
              for (unsigned int i = 0; i < n; ++i)
                {
                  const VoigtVector<dim> stress =
                    stiffness[first + q] * strains[i] * values.JxW(q);
                  for (unsigned int j = 0; j < n; ++j)
                    cell_matrix(i, j) += stress * strains[j];
                }
            }
          space.constraints().distribute_local_to_global(cell_matrix,
                                                         indices,
                                                         matrix);
        }
    matrix.compress(VectorOperation::add);
  }



  template void
  assemble_stiffness<2>(const Space<2> &,
                        const QuadratureField<2> &,
                        const PointValues<VoigtMatrix<2>> &,
                        SparseMatrix &);
  template void
  assemble_stiffness<3>(const Space<3> &,
                        const QuadratureField<3> &,
                        const PointValues<VoigtMatrix<3>> &,
                        SparseMatrix &);
} // namespace Crevasse
