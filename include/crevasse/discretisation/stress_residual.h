// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_stress_residual_h
#define crevasse_discretisation_stress_residual_h

#include <crevasse/discretisation/cell_polynomials.h>
#include <crevasse/discretisation/external_loads.h>
#include <crevasse/discretisation/residual_weight.h>
#include <crevasse/lip/contact_boundary.h>
#include <crevasse/material/voigt.h>

#include <deal.II/fe/fe_interface_values.h>
#include <deal.II/lac/vector.h>

#include <algorithm>

namespace Crevasse
{
  /** Residual of the equilibrium of a stress, given as polynomials of cells, at
   * an instant: in the volume, between cells and at the boundary. */
  template <int dim>
  class StressResidual
  {
  public:
    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

    /** All arguments must outlive this object. Collective. */
    StressResidual(const Space<dim>           &space,
                   const CellPolynomials<dim> &polynomials,
                   const ContactBoundary<dim> &lip,
                   const LoadParameters       &loads,
                   const double                t,
                   const ContactForces        &contact_forces)
      : stress(polynomials.coefficients())
      , space(space)
      , loads(loads)
      , volume_forces(components_in_volume(loads))
      , instant(t)
      , inside(space.mapping,
               polynomials.dof_handler.get_fe(),
               dealii::QGauss<dim>(space.finite_element.degree + 1),
               dealii::update_gradients | dealii::update_quadrature_points |
                 dealii::update_JxW_values |
                 (space.roles.has_axis ? dealii::update_values
                                       : dealii::update_default))
      , faces(space.mapping,
              polynomials.dof_handler.get_fe(),
              space.face_quadrature(),
              dealii::update_values | dealii::update_normal_vectors |
                dealii::update_JxW_values | dealii::update_quadrature_points)
      , displacement(space.mapping,
                     space.finite_element,
                     space.face_quadrature(),
                     dealii::update_values)
      , gradients(inside.n_quadrature_points,
                  std::vector<dealii::Tensor<1, dim>>(n_stress_components<dim>))
      , values_inside(inside.n_quadrature_points,
                      dealii::Vector<double>(n_stress_components<dim>))
      , here(space.face_quadrature().size(),
             dealii::Vector<double>(n_stress_components<dim>))
      , there(here)
      , pressure(lip.pressure(contact_forces))
      , pressures(here.size(), dealii::Vector<double>(dim))
    {
    }

    /** Residual in a cell: ∫ c ‖div s + φ₁‖².
     *
     * @param added Divergence at a point of a stress in addition to the
     * polynomials. */
    template <typename Function>
    double
    in_volume(const Cell                &cell,
              const ResidualWeight<dim> &weight,
              const Function            &added)
    {
      inside.reinit(cell);
      inside.get_function_gradients(stress, gradients);
      if (space.roles.has_axis)
        inside.get_function_values(stress, values_inside);
      double integral = 0.;
      for (const unsigned int q : inside.quadrature_point_indices())
        {
          dealii::Tensor<1, dim> residual = added(inside.quadrature_point(q));
          for (const auto &[d, force] : volume_forces)
            residual[d] += force.value(inside.quadrature_point(q), instant);
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              residual[i] += gradients[q][voigt_index<dim>(i, j)][j];
          if (space.roles.has_axis)
            {
              const auto  &s      = values_inside[q];
              const double radius = inside.quadrature_point(q)[0];
              residual[0] += (s[0] - s[2]) / radius;
              residual[1] += s[voigt_index<dim>(0, 1)] / radius;
            }
          integral += weight.of_force(residual) * inside.JxW(q);
        }
      return integral;
    }

    /** Jump over a face to a cell that is not finer: h ∫ c ‖[s n]‖², with the
     * compliance of the stiffer cell. */
    double
    jump(const Cell                             &cell,
         const unsigned int                      face,
         const std::vector<ResidualWeight<dim>> &weights)
    {
      constexpr auto whole = dealii::numbers::invalid_unsigned_int;
      const auto     other = cell->neighbor(face);
      const auto     place =
        cell->neighbor_is_coarser(face)
              ? cell->neighbor_of_coarser_neighbor(face)
              : std::make_pair(cell->neighbor_of_neighbor(face), whole);
      faces.reinit(cell, face, whole, other, place.first, place.second);
      const auto &mine = faces.get_fe_face_values(0);
      mine.get_function_values(stress, here);
      faces.get_fe_face_values(1).get_function_values(stress, there);
      double of_cell = 0., of_other = 0.;
      for (const unsigned int q : mine.quadrature_point_indices())
        {
          here[q] -= there[q];
          const auto normal   = mine.normal_vector(q);
          const auto traction = traction_of(here[q], normal);
          of_cell +=
            weights[cell->active_cell_index()].of_traction(traction, normal) *
            mine.JxW(q);
          of_other +=
            weights[other->active_cell_index()].of_traction(traction, normal) *
            mine.JxW(q);
        }
      return size_of(mine) * std::min(of_cell, of_other);
    }

    /** Residual at a boundary face: h ∫ c ‖…‖² of the unbalanced traction: on
     * loaded faces s n minus the load, on planes of symmetry and lips its
     * tangential part, on lips also the normal traction plus the contact
     * pressure, and nothing where the body is held.
     *
     * @param added Stress at a point in addition to the polynomials. */
    template <typename Function>
    double
    at_boundary(const Cell                &cell,
                const unsigned int         face,
                const ResidualWeight<dim> &weight,
                const Function            &added)
    {
      const BoundaryRoles &roles = space.roles;
      const auto           id    = cell->face(face)->boundary_id();
      if (roles.clamped.count(id) > 0)
        return 0.;
      const bool is_lip = roles.is_lip(id);
      if (is_lip)
        {
          displacement.reinit(Cell(&space.mesh(),
                                   cell->level(),
                                   cell->index(),
                                   &space.dof_handler),
                              face);
          displacement.get_function_values(pressure, pressures);
        }
      faces.reinit(cell, face);
      const auto &values = faces.get_fe_face_values(0);
      values.get_function_values(stress, here);
      double integral = 0.;
      for (const unsigned int q : values.quadrature_point_indices())
        {
          const auto            &point  = values.quadrature_point(q);
          const auto             normal = values.normal_vector(q);
          const VoigtVector<dim> more   = added(point);
          for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
            here[q][c] += more[c];
          dealii::Tensor<1, dim> residual = traction_of(here[q], normal);
          if (roles.loaded.count(id) > 0)
            residual -= surface_force<dim>(loads, id, point, normal, instant);
          if (roles.symmetry.count(id) > 0)
            residual -= (residual * normal) * normal;
          else if (is_lip)
            // Only one component of the pressure is not zero.
            for (unsigned int d = 0; d < dim; ++d)
              residual += pressures[q][d] * normal;
          for (unsigned int d = 0; d < dim; ++d)
            if (roles.displaced.count(id) > 0 && roles.free.count({id, d}) == 0)
              residual[d] = 0.;
          integral += weight.of_traction(residual, normal) * values.JxW(q);
        }
      return size_of(values) * integral;
    }

    Vector stress; ///< coefficients of the polynomials of stress

  private:
    /** Traction s n. */
    static dealii::Tensor<1, dim>
    traction_of(const dealii::Vector<double> &stress,
                const dealii::Tensor<1, dim> &normal)
    {
      dealii::Tensor<1, dim> traction;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          traction[i] += stress[voigt_index<dim>(i, j)] * normal[j];
      return traction;
    }

    double
    size_of(const dealii::FEFaceValuesBase<dim> &face) const
    {
      double measure = 0.;
      for (const unsigned int q : face.quadrature_point_indices())
        measure += space.roles.has_axis
                     ? face.JxW(q) / face.quadrature_point(q)[0]
                     : face.JxW(q);
      return std::pow(measure, 1. / (dim - 1));
    }

    const Space<dim>                                      &space;
    const LoadParameters                                  &loads;
    const std::vector<std::pair<unsigned int, Expression>> volume_forces;
    const double                                           instant;

    dealii::FEValues<dim>          inside;
    dealii::FEInterfaceValues<dim> faces;
    dealii::FEFaceValues<dim>      displacement;

    std::vector<std::vector<dealii::Tensor<1, dim>>> gradients;
    std::vector<dealii::Vector<double>> values_inside; ///< values for an axis
    std::vector<dealii::Vector<double>> here, there; ///< stress at face points
    const Vector pressure; ///< pressure at dofs of the lip
    std::vector<dealii::Vector<double>> pressures; ///< pressure at face points
  };
} // namespace Crevasse

#endif
