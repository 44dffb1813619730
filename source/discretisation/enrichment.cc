// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/cell_loops.h>
#include <crevasse/discretisation/cell_values.h>
#include <crevasse/discretisation/enrichment.h>

namespace Crevasse
{
  using namespace dealii;

  Enrichment::Enrichment(const Space<2>           &space,
                         const QuadratureField<2> &points)
    : space(space)
    , strains(space.singular_shapes()->size(),
              std::vector<VoigtVector<2>>(points.n_local_points))
    , weights(points.n_local_points)
    , coefficients(strains.size())
    , local_values(space.finite_element.n_dofs_per_cell())
  {
    space.cell_loops()->initialize(nodal);
    const FESystem<2> &fe = space.finite_element;
    for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
      components.push_back(fe.system_to_component_index(i).first);

    CellValues<2>                          cell_values(space,
                              update_gradients | update_JxW_values |
                                update_quadrature_points);
    std::vector<std::vector<Tensor<2, 2>>> gradients;
    for (const auto &cell : owned_cells(space.dof_handler))
      {
        const FEValues<2> &values = cell_values.reinit(cell);
        const std::size_t  first  = points.first_point(cell);
        for (const unsigned int q : values.quadrature_point_indices())
          weights[first + q] = values.JxW(q);
        space.singular_shapes()->gradients(values, gradients);
        for (unsigned int k = 0; k < strains.size(); ++k)
          for (const unsigned int q : values.quadrature_point_indices())
            strains[k][first + q] = voigt_strain<2>(gradients[k][q]);
        if (space.rule(cell) != 0)
          {
            SpecialCell special;
            special.offset = points.offset(cell);
            special.indices.resize(components.size());
            cell->get_dof_indices(special.indices);
            special.weights = values.get_JxW_values();
            for (const unsigned int q : values.quadrature_point_indices())
              for (unsigned int i = 0; i < components.size(); ++i)
                special.gradients.push_back(
                  values.shape_grad_component(i, q, components[i]));
            special_cells.push_back(std::move(special));
          }
      }
  }



  void
  Enrichment::read(const Vector &displacement)
  {
    for (std::size_t i = 0; i < nodal.locally_owned_size(); ++i)
      nodal.local_element(i) = displacement.local_element(i);
    for (unsigned int k = 0; k < strains.size(); ++k)
      coefficients[k] = displacement(space.singular_unknown(k));
  }



  VoigtVector<2>
  Enrichment::strain(const std::size_t offset) const
  {
    VoigtVector<2> sum;
    for (unsigned int k = 0; k < strains.size(); ++k)
      sum += coefficients[k] * strains[k][offset / n_stress_components<2>];
    return sum;
  }



  void
  Enrichment::begin_transpose()
  {
    nodal.zero_out_ghost_values();
    nodal = 0.;
    std::fill(coefficients.begin(), coefficients.end(), 0.);
  }



  void
  Enrichment::add_stress(const std::size_t offset, const VoigtVector<2> &stress)
  {
    const std::size_t    point    = offset / n_stress_components<2>;
    const VoigtVector<2> weighted = weights[point] * stress;
    for (unsigned int k = 0; k < strains.size(); ++k)
      coefficients[k] += weighted * strains[k][point];
  }



  void
  Enrichment::end_transpose(Vector &force)
  {
    nodal.compress(VectorOperation::add);
    for (std::size_t i = 0; i < nodal.locally_owned_size(); ++i)
      force.local_element(i) += nodal.local_element(i);
    for (unsigned int k = 0; k < strains.size(); ++k)
      force(space.singular_unknown(k)) += coefficients[k];
    force.compress(VectorOperation::add);
  }
} // namespace Crevasse
