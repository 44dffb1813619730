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
  /** The finest level of a mesh: beyond it the coordinates of the cells, and of
   * p4est's quadrants, are not told apart. */
  template <int dim>
  constexpr unsigned int finest_level = dim == 2 ? 26 : 16;

  /** Flags the cells at cracks that are coarser than those on the other lip,
   * whose faces must lie on one another. Collective.
   * @return whether there are any: then the mesh is to be changed again. */
  template <int dim>
  bool
  flag_unmatched_lips(Mesh<dim> &mesh, const BoundaryRoles &roles);

  /** How many unknowns a space on this mesh will have. Collective. */
  template <int dim>
  dealii::types::global_dof_index
  count_unknowns(const Mesh<dim> &mesh, const unsigned int degree);

  /**
   * Changes the mesh as flagged and foretells the squares of the estimate:
   * where the displacement is smooth a child has 2^-(2 degree + dim) of its
   * parent's; at the front, where it is like √r, 2^-(dim - 1). Beside the front
   * it is about as where it is smooth. Collective.
   *
   * @param squares by active cell index, of the mesh before and after. */
  template <int dim>
  void
  divide_and_predict(Mesh<dim>             &mesh,
                     const CrackFront<dim> &front,
                     const unsigned int     degree,
                     dealii::Vector<float> &squares);

  /**
   * The mesh of Strategy = tip: the cells that touch the front are divided
   * Cycles times, or as long as there are no more unknowns than wished for.
   * Collective.
   *
   * @param make_mesh the mesh to begin with, anew with each call.
   * @throw SceneError if there is no front, or if the mesh cannot be as fine.
   */
  template <int dim>
  std::shared_ptr<Mesh<dim>>
  graded_mesh(const std::function<std::shared_ptr<Mesh<dim>>()> &make_mesh,
              const BoundaryRoles                               &roles,
              const RefinementParameters                        &parameters,
              const unsigned int                                 degree);
} // namespace Crevasse

#endif
