// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_shape_strains_h
#define crevasse_discretisation_shape_strains_h

#include <crevasse/discretisation/cell_values.h>
#include <crevasse/material/voigt.h>

#include <vector>

namespace Crevasse
{
  /** Strains of all shape functions of a cell at the points of its rule, those
   * of the nodes and the singular ones, in the order of Space::get_unknowns().
   */
  template <int dim>
  class ShapeStrains
  {
  public:
    /** @param space must outlive this object. */
    explicit ShapeStrains(const Space<dim> &space)
      : space(space)
      , cell_values(space,
                    dealii::update_gradients | dealii::update_JxW_values |
                      dealii::update_quadrature_points)
    {
    }

    const dealii::FEValues<dim> &
    reinit(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell)
    {
      values = &cell_values.reinit(cell);
      if (space.volumetric_strain() == VolumetricStrain::mean)
        find_mean_dilatations();
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
    at_point(const unsigned int q, std::vector<VoigtVector<dim>> &strains) const
    {
      const dealii::FESystem<dim> &fe = space.finite_element();
      strains.assign(fe.n_dofs_per_cell(), VoigtVector<dim>());
      for (unsigned int i = 0; i < strains.size(); ++i)
        {
          const unsigned int c        = fe.system_to_component_index(i).first;
          const auto         gradient = values->shape_grad_component(i, q, c);
          for (unsigned int d = 0; d < dim; ++d)
            strains[i][voigt_index<dim>(c, d)] = gradient[d];
          if (!mean_dilatations.empty())
            for (unsigned int d = 0; d < 3; ++d)
              strains[i][d] += (mean_dilatations[i] - gradient[c]) / 3.;
        }
      for (const auto &gradients : singular_gradients)
        strains.push_back(voigt_strain<dim>(gradients[q]));
    }

  private:
    /** The means over the cell of the dilatations of its shape functions. */
    void
    find_mean_dilatations()
    {
      const dealii::FESystem<dim> &fe     = space.finite_element();
      double                       volume = 0.;
      mean_dilatations.assign(fe.n_dofs_per_cell(), 0.);
      for (const unsigned int q : values->quadrature_point_indices())
        {
          volume += values->JxW(q);
          for (unsigned int i = 0; i < mean_dilatations.size(); ++i)
            {
              const unsigned int c = fe.system_to_component_index(i).first;
              mean_dilatations[i] +=
                values->shape_grad_component(i, q, c)[c] * values->JxW(q);
            }
        }
      for (double &mean : mean_dilatations)
        mean /= volume;
    }

    const Space<dim>                                &space;
    CellValues<dim>                                  cell_values;
    const dealii::FEValues<dim>                     *values = nullptr;
    std::vector<double>                              mean_dilatations;
    std::vector<std::vector<dealii::Tensor<2, dim>>> singular_gradients;
  };
} // namespace Crevasse

#endif
