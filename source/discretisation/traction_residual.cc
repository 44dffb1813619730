// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/discretisation/traction_residual.h>
#include <crevasse/material/voigt.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  Tensor<1, dim>
  traction_of(const dealii::Vector<double> &stress,
              const Tensor<1, dim>         &normal)
  {
    Tensor<1, dim> traction;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        traction[i] += stress[voigt_index<dim>(i, j)] * normal[j];
    return traction;
  }



  template <int dim>
  TractionResidual<dim>::TractionResidual(const Space<dim>           &space,
                                          const ContactBoundary<dim> &lip,
                                          const LoadParameters       &loads)
    : space(space)
    , lip(lip)
    , loads(*loads.traction)
    , pressure(space.ghosted_vector())
    , displacement(space.mapping(),
                   space.finite_element(),
                   space.face_quadrature(),
                   update_values)
    , pressures(space.face_quadrature().size(), dealii::Vector<double>(dim))
  {
  }



  template <int dim>
  void
  TractionResidual<dim>::set_instant(const double               t,
                                     const std::vector<double> &contact_forces)
  {
    instant  = t;
    pressure = space.ghosted_vector();
    for (unsigned int k = 0; k < lip.nodes().size(); ++k)
      pressure(lip.nodes()[k].dof) = contact_forces[k] / lip.nodes()[k].weight;
    lip.spread_to_held_nodes(pressure);
  }



  template <int dim>
  double
  TractionResidual<dim>::square(
    const typename Triangulation<dim>::active_cell_iterator &cell,
    const unsigned int                                       face,
    const FEFaceValuesBase<dim>                             &values,
    const std::vector<dealii::Vector<double>>               &stress)
  {
    const BoundaryRoles     &roles = space.roles();
    const types::boundary_id id    = cell->face(face)->boundary_id();
    if (roles.clamped.count(id) > 0)
      return 0.;
    const bool is_loaded   = roles.loaded.count(id) > 0;
    const bool is_symmetry = roles.symmetry.count(id) > 0;
    const bool is_lip      = roles.contact.count(id) > 0;
    if (is_lip)
      {
        displacement.reinit(
          typename DoFHandler<dim>::active_cell_iterator(
            &space.mesh(), cell->level(), cell->index(), &space.dof_handler()),
          face);
        displacement.get_function_values(pressure, pressures);
      }

    double integral = 0.;
    for (const unsigned int q : values.quadrature_point_indices())
      {
        const Tensor<1, dim> normal   = values.normal_vector(q);
        Tensor<1, dim>       residual = traction_of<dim>(stress[q], normal);
        if (is_loaded)
          for (unsigned int d = 0; d < loads.size(); ++d)
            residual[d] -= loads[d].value(values.quadrature_point(q), instant);
        if (is_symmetry)
          residual -= (residual * normal) * normal;
        else if (is_lip)
          // The only component that is not zero is the normal one.
          for (unsigned int d = 0; d < dim; ++d)
            residual += pressures[q][d] * normal;
        integral += residual.norm_square() * values.JxW(q);
      }
    return integral;
  }



#define INSTANTIATE(dim)                                                   \
  template Tensor<1, dim> traction_of<dim>(const dealii::Vector<double> &, \
                                           const Tensor<1, dim> &);        \
  template class TractionResidual<dim>

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
