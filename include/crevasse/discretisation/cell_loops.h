// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_cell_loops_h
#define crevasse_discretisation_cell_loops_h

#include <crevasse/discretisation/space.h>
#include <crevasse/kernels/cell_kernels.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/partitioner.h>

#include <tuple>

namespace Crevasse
{
  /**
   * Data for loops of CellKernels over the cells of this rank: indices,
   * constraints and geometry. Excludes cells that do not have the first rule,
   * see Space::quadratures. All operators of a space share this object: see
   * Space::cell_loops().
   *
   * Constraints are resolved once for each unknown, not in each cell: a kernel
   * reads and writes constrained unknowns like others.
   */
  template <int dim>
  class CellLoops
  {
  public:
    template <typename Real>
    using VectorOf = dealii::LinearAlgebra::distributed::Vector<Real>;

    /** Prepares the loops. @p space must outlive them. Collective. */
    explicit CellLoops(const Space<dim> &space);

    /** Gives @p vector the layout for loops: values at nodes. */
    template <typename Real>
    void
    initialize(VectorOf<Real> &vector) const
    {
      vector.reinit(partitioner);
    }

    /** Calls f(cell, k) for each cell in the order of the loops. */
    template <typename Function>
    void
    for_each_cell(const Function &f) const
    {
      unsigned int k = 0;
      for (const auto &cell : owned_cells(space.dof_handler))
        if (space.rule(cell) == 0)
          f(cell, k++);
    }

    unsigned int
    n_cells() const
    {
      return n;
    }

    unsigned int
    n_nodes_per_cell() const
    {
      return n_nodes;
    }

    /** Local indices of the first component at the nodes of cell k, x fastest;
     * the other components follow. */
    const unsigned int *
    first_indices(const unsigned int k) const
    {
      return indices.data() + std::size_t(k) * n_nodes;
    }

    /** Position of each dof of the element: node × dim + component. */
    const std::vector<unsigned int> &
    places() const
    {
      return place_of_dof;
    }

    template <typename Real>
    const CellKernels<Real> &
    kernels() const
    {
      return geometry<Real>().kernels;
    }

    /** Batches from @p first on, at most so many. In single precision the unit
     * of length is length_unit(). */
    template <typename Real>
    CellBatches<Real>
    batches(const unsigned int first   = 0,
            const unsigned int at_most = -1) const;

    /** Unit of length with which single precision can hold powers of the size
     * of cells: diameter of a coarsest cell, which all levels share. */
    double
    length_unit() const
    {
      return space.mesh().begin(0)->diameter();
    }

    /** Local indices of the constrained unknowns of this rank, ascending. */
    const std::vector<unsigned int> &
    constrained() const
    {
      return owned_constrained;
    }

    /** Sets ghost values and constrained entries of a vector during its life.
     */
    template <typename Real>
    class ResolvedValues
    {
    public:
      /** Sets the values. Collective. */
      ResolvedValues(const CellLoops &loops, const VectorOf<Real> &vector);

      /** Restores the vector, without ghost values. */
      ~ResolvedValues();

      ResolvedValues(const ResolvedValues &) = delete;

    private:
      const CellLoops      &loops;
      const VectorOf<Real> &vector;
      std::vector<Real>     own_values;
    };

    /** Transpose of ResolvedValues: adds entries of constrained unknowns and
     * ghosts to their masters, and zeroes them. Collective. */
    template <typename Real>
    void
    distribute(VectorOf<Real> &vector) const;

    std::size_t
    memory_consumption() const;

  private:
    template <typename Real>
    struct Geometry
    {
      CellKernels<Real>           kernels;
      std::vector<BatchGeometry>  of_batch;
      dealii::AlignedVector<Real> values;
    };

    template <typename Real>
    const Geometry<Real> &
    geometry() const;

    template <typename Real>
    std::unique_ptr<const Geometry<Real>>
    make_geometry() const;

    void
    find_constraints();
    void
    number_nodes();

    const Space<dim>                                          &space;
    const CellKind                                             kind;
    const unsigned int                                         n_nodes;
    unsigned int                                               n = 0;
    std::vector<unsigned int>                                  place_of_dof;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
    std::vector<unsigned int>                                  indices;

    // Constrained unknowns of the cells: local indices, starts of their entries
    // in weights, and entries (local index, weight).
    std::vector<unsigned int>                    constrained_indices;
    std::vector<std::size_t>                     starts = {0};
    std::vector<std::pair<unsigned int, double>> weights;
    std::vector<unsigned int>                    owned_constrained;

    /** Geometry of all batches, made when first used. */
    mutable std::tuple<std::unique_ptr<const Geometry<float>>,
                       std::unique_ptr<const Geometry<double>>>
      geometries;
  };
} // namespace Crevasse

#endif
