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

#ifndef crevasse_discretisation_space_h
#define crevasse_discretisation_space_h

#include <crevasse/scene/boundary_roles.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <memory>
#include <vector>

namespace Crevasse
{
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  template <int dim>
  using Mesh = dealii::parallel::distributed::Triangulation<dim>;

  /** What a strain has as its volumetric part: that of the displacement
   * gradient at the point, or the mean of that over the cell (B-bar; Hughes
   * 1980), which keeps linear elements from locking where the volume hardly
   * changes. */
  enum class VolumetricStrain
  {
    full,
    mean
  };



  /**
   * The displacement space: Q1 or Q2 elements on a distributed mesh, with the
   * linear constraints of hanging nodes, clamped parts, symmetry planes and
   * fixed points. Displacement vectors hold zeros in their constrained
   * entries; constraints().distribute() fills these for output.
   */
  template <int dim>
  class Space
  {
  public:
    /**
     * @throw SceneError with all of it at once, if a role names a boundary id
     * that no face has, or a fixed point is not a vertex.
     *
     * @param volumetric_strain mean with degree 1, and not in plane stress.
     */
    Space(std::shared_ptr<const Mesh<dim>>    mesh,
          const unsigned int                  degree,
          const BoundaryRoles                &roles,
          const std::vector<FixedPoint<dim>> &fixed_points,
          const VolumetricStrain volumetric_strain = VolumetricStrain::full);

    const Mesh<dim> &
    mesh() const;
    /** For another space on the same mesh; its dofs are numbered alike. */
    std::shared_ptr<const Mesh<dim>>
    shared_mesh() const;
    const dealii::DoFHandler<dim> &
    dof_handler() const;
    const dealii::FESystem<dim> &
    finite_element() const;
    const dealii::Mapping<dim> &
    mapping() const;
    const dealii::AffineConstraints<double> &
    constraints() const;
    const BoundaryRoles &
    roles() const;
    /** What D takes from displacements of this space. */
    VolumetricStrain
    volumetric_strain() const;
    MPI_Comm
    communicator() const;

    /** A vector of zeros for values at the degrees of freedom, with ghosts for
     * those of the cells that this rank sees. */
    Vector
    ghosted_vector() const;

    /** The rule that integrates the stiffness, and at whose points the viscous
     * strain lives: Gauss with degree + 1 points a direction. */
    const dealii::Quadrature<dim> &
    quadrature() const;
    const dealii::Quadrature<dim - 1> &
    face_quadrature() const;

  private:
    void
    check_roles() const;
    void
    make_constraints(const std::vector<FixedPoint<dim>> &fixed_points);
    void
    constrain(const FixedPoint<dim> &fixed_point);
    void
    constrain(const dealii::types::global_dof_index dof,
              const unsigned int                    component,
              const dealii::Point<dim>             &place);

    const std::shared_ptr<const Mesh<dim>> triangulation;
    const dealii::MappingQ1<dim>           q1_mapping;
    const dealii::FESystem<dim>            fe;
    const dealii::QGauss<dim>              cell_rule;
    const dealii::QGauss<dim - 1>          face_rule;
    const BoundaryRoles                    boundary_roles;
    const VolumetricStrain                 volumetric;
    dealii::DoFHandler<dim>                dofs;
    dealii::AffineConstraints<double>      affine_constraints;
  };
} // namespace Crevasse

#endif
