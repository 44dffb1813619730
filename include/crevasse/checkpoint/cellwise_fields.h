// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_checkpoint_cellwise_fields_h
#define crevasse_checkpoint_cellwise_fields_h

#include <crevasse/model/body.h>

#include <cstdint>
#include <vector>

namespace Crevasse
{
  /**
   * Fields cell by cell, in the order of the space-filling curve along which
   * p4est hands cells out to ranks: each rank has a part of that order without
   * gaps, whatever their number is.
   */
  template <int dim>
  class CellwiseFields
  {
  public:
    /** @p body must outlive this object. Collective. */
    explicit CellwiseFields(const Body<dim> &body);

    /** Number of the first cell of this rank in the order of all. */
    std::size_t
    first_cell() const;
    std::size_t
    n_cells() const;
    std::size_t
    n_cells_of_all_ranks() const;

    /** The number of quadrature points of each cell of this rank. */
    const std::vector<std::uint32_t> &
    n_points() const;

    unsigned int
    n_nodal_values() const;

    /** A field of the layout of Space at the dofs of each cell, except the
     * coefficients of singular functions. Collective. */
    std::vector<double>
    nodal(const Vector &field) const;

    void
    set_nodal(const std::vector<double> &values, Vector &field) const;

    /** The coefficients, on all ranks. Collective. */
    std::vector<double>
    singular_coefficients(const Vector &field) const;

    void
    set_singular_coefficients(const std::vector<double> &values,
                              Vector                    &field) const;

    /** A field at the points of each cell. */
    std::vector<double>
    at_points(const Vector &field) const;

    /** How many numbers it has at a point. */
    unsigned int
    n_per_point(const Vector &field) const;

    void
    set_at_points(const std::vector<double> &values,
                  const unsigned int         n_per_point,
                  Vector                    &field) const;

    /** Numbers by active cell index. */
    std::vector<double>
    of_cells(const dealii::Vector<double> &values) const;

    void
    set_of_cells(const std::vector<double> &ordered,
                 dealii::Vector<double>    &values) const;

    /** A nodal field with these values at the bounds; those that are missing
     * at the end are 0. */
    Vector
    from_bounds(const std::vector<double> &values) const;

    std::vector<double>
    to_bounds(const Vector &field) const;

  private:
    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

    const Body<dim>           &body;
    const UnilateralBounds     bounds;
    std::vector<Cell>          cells; ///< of this rank, in order
    std::vector<std::uint32_t> points;
    std::size_t                first = 0, total = 0;
  };
} // namespace Crevasse

#endif
