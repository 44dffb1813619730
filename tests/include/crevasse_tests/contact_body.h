// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_tests_contact_body_h
#define crevasse_tests_contact_body_h

#include <crevasse/contact/signorini_problem.h>
#include <crevasse/discretisation/external_loads.h>
#include <crevasse/discretisation/quadrature_field.h>
#include <crevasse/discretisation/strain_operator.h>
#include <crevasse/lip/contact_boundary.h>
#include <crevasse/model/body.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

/** A discretised body whose lip touches its plane without a gap. */
template <int dim>
class ContactBody
{
public:
  /** @param traction on the loaded boundary, unless loads() gets another.
   * The rest is what a Space needs. */
  ContactBody(std::shared_ptr<const Crevasse::Mesh<dim>>    mesh,
              const unsigned int                            degree,
              const Crevasse::BoundaryRoles                &roles,
              const std::vector<Crevasse::FixedPoint<dim>> &fixed_points,
              const Crevasse::VolumetricStrain              volumetric_strain,
              const std::string                            &traction)
    : space(std::move(mesh), degree, roles, fixed_points, volumetric_strain)
    , points(space)
    , strain_operator(space, points)
    , lip(space.lip,
          space.dof_handler,
          space.locally_owned_unknowns,
          Crevasse::Expression("0"))
    , bounds(Crevasse::unilateral_bounds(lip, space))
    , usual_traction(traction)
  {
  }

  /** The nodal forces of a traction. */
  Crevasse::Vector
  loads(const std::string &traction) const
  {
    Crevasse::LoadParameters parameters;
    parameters.traction = traction;
    Crevasse::Vector b;
    strain_operator.initialize(b);
    Crevasse::ExternalLoads<dim>(space, strain_operator, parameters)
      .evaluate(0., b);
    return b;
  }

  Crevasse::Vector
  loads() const
  {
    return loads(usual_traction);
  }

  const Crevasse::Space<dim>           space;
  const Crevasse::QuadratureField<dim> points;
  const Crevasse::StrainOperator<dim>  strain_operator;
  const Crevasse::ContactBoundary<dim> lip;
  Crevasse::UnilateralBounds           bounds;

private:
  const std::string usual_traction;
};

#endif
