// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_lip_forces_h
#define crevasse_crack_tip_lip_forces_h

#include <deal.II/base/mpi.h>

#include <array>
#include <vector>

namespace Crevasse
{
  /**
   * Contribution of the contact forces on the lips to K at a tip, or at a
   * vertex of a crack front: a linear function.
   *
   * In the cells at a tip whose lips slide the stress of K_II is as wrong as it
   * is large. Unless both sides have mirrored meshes, so is the pressure: its
   * mean over a cell of size h by about K_II/√h, which contributes alike on all
   * meshes. But displacements at a distance from the tip are right, and the
   * pressure is smooth: from there the straight line of least squares (of
   * pressures with the areas of their nodes) continues it to the tip. It begins
   * elsewhere in squares of other sizes, so that their difference shows what is
   * left. At a front, the nodes beside a vertex count less the farther they are
   * along the front, up to the distance to which the line extends.
   */
  class LipForces
  {
  public:
    /** Local node of the lips. */
    struct Node
    {
      std::size_t number;   ///< in ContactBoundary::nodes
      double      factor;   ///< of its force; 0 beyond the square
      double      distance; ///< from the tip or front
      double      along;    ///< distance along the front; 0 at a tip
      double      area;     ///< its force under a uniform pressure 1
      double      sign;     ///< sign of its force under a uniform traction
    };

    LipForces() = default;

    /** Contribution of the forces as they are. */
    explicit LipForces(const std::vector<Node> &nodes);

    /** Contribution with the line, if enough nodes are beyond its begin.
     * Collective.
     * @param begin distance up to which forces are wrong: two cells and more.
     * @param reach largest distance on the line. */
    LipForces(const std::vector<Node> &nodes,
              const double             begin,
              const double             reach,
              const MPI_Comm           communicator);

    /** What a rank adds to the sums over all ranks: the contribution without
     * and with the line; area, pressure and its square over the nodes on the
     * line. */
    enum Part
    {
      of_forces,
      with_line,
      area,
      pressure,
      square,
      n_parts
    };
    using Sums = std::array<double, n_parts>;

    /** Adds the sums of normal or tangential forces, of all local nodes.
     * @param normal normal forces. */
    void
    add(const std::vector<double> &forces,
        const std::vector<double> &normal,
        Sums                      &sums) const;

    /** The contribution of sums over all ranks: with the line where it is under
     * a smooth pressure, without where half of it is open. Between both it
     * changes continuously, as K does when nodes close one by one. */
    static double
    chosen(const Sums &sums);

    /** Multiplies the contribution. */
    void
    scale(const double factor);

    /** Factors with the line, of all local nodes. */
    std::vector<double>
    factors(const std::size_t n_nodes) const;

  private:
    struct Factor
    {
      std::size_t node;
      double      of_force; ///< without the line
      double      with_line;
      double      share; ///< in the line; 0: not on it
      double      area;
    };

    std::vector<Factor> all;
  };
} // namespace Crevasse

#endif
