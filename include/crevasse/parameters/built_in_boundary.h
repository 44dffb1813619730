// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_built_in_boundary_h
#define crevasse_parameters_built_in_boundary_h

#include <crevasse/parameters/parameters.h>

namespace Crevasse
{
  /** Boundary ids of the built-in shapes. The bottom is the crack plane x₂ = 0:
   * `ligament` where the body goes on below it, `lip` along the crack. Only
   * bodies in space have a `front`, x₃ = 0, and a `back`, x₃ = Thickness. */
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

  /** Where the tip (in space: the straight front) of the crack of a built-in
   * shape lies along x₁; the lip is on its right (edge crack) or on its left
   * (centre crack). */
  double
  tip_abscissa(const GeometryParameters &parameters);

  /** What the user says wins: a role with a list of its own has this list, and
   * loses nothing to the automatic ones; an id in such a list is taken out of
   * the automatic lists of the other roles. */
  BoundaryRoles
  resolve_roles(const BoundaryParameters &parameters,
                const BoundaryRoles      &automatic);

  /** The roles that a built-in shape gives its boundary ids; none for a mesh
   * file. */
  BoundaryRoles
  built_in_roles(const GeometryParameters &parameters);

  /**
   * The points that hold a built-in shape against the motions along the crack
   * plane that clamped sides and symmetry planes leave free, and against no
   * other: loads in equilibrium cause no force there. They lie on the crack
   * tip or, without a crack, at the origin and above it.
   *
   * @param roles what the boundary ids of the shape finally have.
   */
  template <int dim>
  std::vector<FixedPoint<dim>>
  built_in_fixed_points(const GeometryParameters &parameters,
                        const BoundaryRoles      &roles);
} // namespace Crevasse

#endif
