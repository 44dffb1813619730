// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_marking_h
#define crevasse_discretisation_marking_h

#include <crevasse/discretisation/space.h>
#include <crevasse/parameters/parameters.h>

#include <deal.II/grid/cell_id.h>
#include <deal.II/lac/vector.h>

#include <functional>
#include <memory>
#include <vector>

namespace Crevasse
{
  class StateArchive;

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

    explicit MeshHistory(const MakeMesh &make_mesh);

    /** What the first mesh became, once more and independent of others. */
    std::shared_ptr<Mesh<dim>>
    make() const;

    /** What it would become next. */
    std::shared_ptr<Mesh<dim>>
    make_with(const Marks &next) const;

    void
    add(const Marks &marks);

    /** Shows what it became so far. */
    void
    serialize(StateArchive &archive);

  private:
    MakeMesh           make_first;
    std::vector<Marks> all;
  };
} // namespace Crevasse

#endif
