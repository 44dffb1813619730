// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_refinement_h
#define crevasse_discretisation_refinement_h

#include <crevasse/discretisation/space.h>
#include <crevasse/parameters/boundary_roles.h>
#include <crevasse/parameters/refinement_parameters.h>

#include <deal.II/grid/cell_id.h>
#include <deal.II/lac/vector.h>

#include <functional>
#include <memory>
#include <vector>

namespace Crevasse
{
  class StateArchive;

  /** The finest level of a mesh: beyond it the coordinates of the cells, and of
   * p4est's quadrants, are not told apart. */
  template <int dim>
  constexpr unsigned int finest_level = dim == 2 ? 26 : 16;

  /** How many unknowns a space on this mesh will have. Collective. */
  template <int dim>
  dealii::types::global_dof_index
  count_unknowns(const Mesh<dim> &mesh, const unsigned int degree);

  /** @throw SceneError if a mesh has more than Target unknowns before anything
   * is refined. Collective. */
  template <int dim>
  void
  require_affordable(const Mesh<dim>            &mesh,
                     const RefinementParameters &parameters,
                     const unsigned int          degree);

  /**
   * The mesh of Strategy = tip: the cells that touch the front are divided
   * Cycles times, or as long as there are no more unknowns than wished for.
   * Collective.
   *
   * @param make_mesh the mesh to begin with, anew with each call.
   * @throw SceneError if there is no front, or if the mesh cannot be as fine,
   * or is as large from the beginning.
   */
  template <int dim>
  std::shared_ptr<Mesh<dim>>
  graded_mesh(const std::function<std::shared_ptr<Mesh<dim>>()> &make_mesh,
              const BoundaryRoles                               &roles,
              const RefinementParameters                        &parameters,
              const unsigned int                                 degree);

  /** The cells that one adaptation divides and joins, by name and from all
   * ranks, so that a mesh can be made again, by whatever ranks there are. */
  struct Marks
  {
    std::vector<dealii::CellId> refined, coarsened;
  };

  /** Sets the flags that the parameters ask for: the cells with the largest
   * part of the squares of the estimates are divided, those with the smallest
   * joined where all their siblings are. Cells at the finest level stay.
   * Collective.
   *
   * @param squares by active cell index.
   * @param share of Refine fraction. */
  template <int dim>
  void
  set_flags(Mesh<dim>                   &mesh,
            const dealii::Vector<float> &squares,
            const RefinementParameters  &parameters,
            const double                 share = 1.);

  /** The cells with flags, over all ranks. Collective. */
  template <int dim>
  Marks
  flagged_cells(const Mesh<dim> &mesh);

  /** Divides and joins these cells. Collective. */
  template <int dim>
  void
  apply(const Marks &marks, Mesh<dim> &mesh);

  /** A mesh, and how it came to be: there is no way back from a mesh that has
   * become too large, but it can be made anew. */
  template <int dim>
  class MeshHistory
  {
  public:
    using MakeMesh = std::function<std::shared_ptr<Mesh<dim>>()>;

    explicit MeshHistory(const MakeMesh &make_mesh)
      : make_first(make_mesh)
    {
    }

    /** What the first mesh became, or would become next, once more and
     * independent of others. */
    std::shared_ptr<Mesh<dim>>
    make(const Marks &next = {}) const
    {
      const std::shared_ptr<Mesh<dim>> mesh = make_first();
      for (const Marks &marks : all)
        apply<dim>(marks, *mesh);
      apply<dim>(next, *mesh);
      return mesh;
    }

    void
    add(const Marks &marks)
    {
      all.push_back(marks);
    }

    /** Shows what it became so far. */
    void
    serialize(StateArchive &archive);

  private:
    MakeMesh           make_first;
    std::vector<Marks> all;
  };
} // namespace Crevasse

#endif
