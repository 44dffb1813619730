// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_built_in_boundary_h
#define crevasse_parameters_built_in_boundary_h

#include <crevasse/parameters/parameters.h>

#include <map>

namespace Crevasse
{
  /** Boundary ids of the built-in shapes. The bottom is the crack plane x₂ = 0:
   * `lip` along the crack, `ligament` along the rest. Only bodies in space
   * have a `front`, x₃ = 0, and a `back`, x₃ = Thickness. */
  namespace BoundaryIds
  {
    constexpr dealii::types::boundary_id left     = 0;
    constexpr dealii::types::boundary_id right    = 1;
    constexpr dealii::types::boundary_id ligament = 2;
    constexpr dealii::types::boundary_id top      = 3;
    constexpr dealii::types::boundary_id lip      = 4;
    constexpr dealii::types::boundary_id front    = 5;
    constexpr dealii::types::boundary_id back     = 6;
  } // namespace BoundaryIds

  /** Names of the boundary ids that a built-in shape has. */
  std::map<unsigned int, std::string>
  built_in_names(const GeometryParameters &parameters, const unsigned int dim);

  /** Coordinate x₁ of the crack tip (in space: of the straight crack front) of
   * a built-in shape; the lip is on its right (edge crack) or on its left
   * (centre crack). */
  double
  tip_abscissa(const GeometryParameters &parameters);

  /** Roles of boundary ids. A list of the user has precedence: it replaces the
   * automatic list of its role, and its ids are removed from the automatic
   * lists of other roles; but lips stay lips if they are loaded. */
  BoundaryRoles
  resolve_roles(const BoundaryParameters &parameters,
                const BoundaryRoles      &automatic);

  /** Automatic roles of the boundary ids of a built-in shape; none for a mesh
   * file. */
  BoundaryRoles
  built_in_roles(const GeometryParameters &parameters);

  /**
   * Fixed points that suppress the rigid-body motions along the crack plane
   * which clamped sides and symmetry planes of a built-in shape allow, and no
   * other motion: loads in equilibrium cause no force there. They lie on the
   * crack tip or, without a crack, at the origin and above it.
   *
   * @param roles Final roles of the boundary ids of the shape.
   */
  template <int dim>
  std::vector<FixedPoint<dim>>
  built_in_fixed_points(const GeometryParameters &parameters,
                        const BoundaryRoles      &roles);
} // namespace Crevasse

#endif
