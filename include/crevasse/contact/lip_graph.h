// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_lip_graph_h
#define crevasse_contact_lip_graph_h

#include <crevasse/contact/signorini_problem.h>

namespace Crevasse
{
  /**
   * The bounds of all ranks, numbered rank by rank, and which of them are
   * neighbours: those whose unknowns A couples. Every rank has all of it.
   */
  class LipGraph
  {
  public:
    /** Collective. */
    explicit LipGraph(const SignoriniProblem &problem);

    /** The number of the first locally owned bound. */
    unsigned int
    first() const
    {
      return first_local;
    }

    /** Of all ranks. */
    unsigned int
    n_nodes() const
    {
      return neighbours.size();
    }

    /** Completes, by those of the other ranks, the entries of the locally
     * owned nodes of @p on_lip. Collective. */
    void
    gather(double *on_lip) const;

    /** A set of all ranks' nodes, from the locally owned ones. Collective. */
    std::vector<bool>
    gathered(const std::vector<bool> &local) const;

    /**
     * Where a set is wrong by a layer of nodes along its edge, the next set of
     * a primal–dual active set is not right either: at the edge of a contact
     * that reaches too far by δ the pressure is that of a crack tip,
     * p ~ (δ/2 − x)/√x at the distance x, so that tension shows on half of the
     * layer only; where it falls short by δ, the opening is
     * w ~ x^{3/2} − (3/2) δ x^{1/2}, so that penetration shows half as far
     * again. Errors are halved, and the number of sets grows with the logarithm
     * of the mesh size. This function moves the edges to where these formulas
     * put them, by layers of neighbours, if they move by several layers.
     *
     * @param active the set of which @p next is the plain successor.
     */
    void
    extrapolate(const std::vector<bool> &active, std::vector<bool> &next) const;

  private:
    using Nodes = std::vector<unsigned int>;

    /** Of the nodes marked, those connected with @p seed, which are unmarked,
     * by layers of distance from those that have a neighbour where
     * @p is_outside; without such a neighbour there are no layers. */
    template <typename IsOutside>
    std::vector<Nodes>
    layers(const unsigned int seed,
           std::vector<bool> &marked,
           const IsOutside   &is_outside) const;

    /** Takes nodes from @p next around those of @p layers, as many layers as
     * these are. */
    void
    erode(const std::vector<Nodes> &layers, std::vector<bool> &next) const;

    MPI_Comm           communicator;
    std::vector<int>   counts; ///< of bounds on each rank
    std::vector<int>   starts;
    unsigned int       first_local;
    std::vector<Nodes> neighbours;
  };
} // namespace Crevasse

#endif
