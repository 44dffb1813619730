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

#ifndef crevasse_discretisation_contact_boundary_h
#define crevasse_discretisation_contact_boundary_h

#include <crevasse/discretisation/space.h>
#include <crevasse/scene/expression.h>

#include <vector>

namespace Crevasse
{
  /** One node of the crack lip on this rank. */
  template <int dim>
  struct LipNode
  {
    dealii::types::global_dof_index dof       = 0; ///< normal displacement
    unsigned int                    component = 0;
    double                          sign      = 1.; ///< u_N = sign × u[dof]
    double                          gap       = 0.; ///< u_N ≥ gap
    double                          weight    = 0.; ///< ∫φ over the lip
    dealii::Point<dim>              point;
  };

  /**
   * The normal degrees of freedom of the crack lip, L in the paper's notation.
   * The lip must be parallel to the coordinate axes, which lets u_N be a
   * degree of freedom. Nodes whose normal displacement is held by a support or
   * interpolated from hanging nodes are not contact nodes.
   */
  template <int dim>
  class ContactBoundary
  {
  public:
    /**
     * @param gap_formula The least u_N, at most 0 (an initial opening is
     * negative).
     * @throw SceneError if a face of the lip is not parallel to an axis or the
     * gap is positive somewhere, with the place.
     */
    ContactBoundary(const Space<dim> &space, Expression &&gap_formula);

    /** In the order of their dofs. */
    const std::vector<LipNode<dim>> &
    nodes() const;

    /** The least u_N at any point of the lip. @throw SceneError if it is not
     * finite or positive. */
    double
    gap_at(const dealii::Point<dim> &point) const;

  private:
    const Expression          gap;
    std::vector<LipNode<dim>> lip_nodes;
  };
} // namespace Crevasse

#endif
