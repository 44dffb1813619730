// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_model_refinement_h
#define crevasse_model_refinement_h

#include <crevasse/discretisation/space.h>
#include <crevasse/grid/crack_tip.h>
#include <crevasse/parameters/parameters.h>

#include <deal.II/lac/vector.h>

namespace Crevasse
{
  /** The finest level of a mesh: beyond it neither coordinates of cells nor
   * p4est's quadrants are distinct. */
  template <int dim>
  constexpr unsigned int finest_level = dim == 2 ? 26 : 16;

  /** Flags cells at cracks that are coarser than the cells on the other lip, as
   * faces of both lips must match. Collective.
   * @return whether any is flagged: then the mesh must be changed again. */
  template <int dim>
  bool
  flag_unmatched_lips(Mesh<dim> &mesh, const BoundaryRoles &roles);

  /** Number of unknowns of a space on this mesh. Collective. */
  template <int dim>
  dealii::types::global_dof_index
  count_unknowns(const Mesh<dim> &mesh, const unsigned int degree);

  /**
   * Changes the mesh as flagged and predicts the squared errors: where the
   * displacement is smooth a child has 2^-(2 degree + dim) of its parent's; at
   * the front, where displacement is ~ √r, 2^-(dim - 1). Beside the front the
   * factor is about the smooth one. Collective.
   *
   * @param squares squared errors by active cell index, before and after.
   */
  template <int dim>
  void
  divide_and_predict(Mesh<dim>             &mesh,
                     const CrackFront<dim> &front,
                     const unsigned int     degree,
                     dealii::Vector<float> &squares);

  /**
   * Creates the mesh of Strategy = tip: cells that touch the front are divided
   * Cycles times, or as long as Target unknowns allows. Collective.
   *
   * @param make_mesh creates a new initial mesh with each call.
   * @throw SceneError if there is no front, or if the mesh cannot be so fine.
   */
  template <int dim>
  std::shared_ptr<Mesh<dim>>
  graded_mesh(const std::function<std::shared_ptr<Mesh<dim>>()> &make_mesh,
              const BoundaryRoles                               &roles,
              const RefinementParameters                        &parameters,
              const unsigned int                                 degree);
} // namespace Crevasse

#endif
