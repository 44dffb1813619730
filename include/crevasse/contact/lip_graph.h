// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_lip_graph_h
#define crevasse_contact_lip_graph_h

#include <crevasse/contact/signorini_problem.h>

namespace Crevasse
{
  /**
   * Graph of the bounds of all ranks, numbered rank by rank: bounds on the same
   * face of a lip are neighbours. Every rank has the whole graph.
   */
  class LipGraph
  {
  public:
    /** Builds the graph. Collective. */
    explicit LipGraph(const SignoriniProblem &problem);

    /** Number of the first locally owned bound. */
    unsigned int
    first() const
    {
      return first_local;
    }

    /** Number of bounds on all ranks. */
    unsigned int
    n_nodes() const
    {
      return neighbours.size();
    }

    /** Combines the locally owned flags of all ranks, false if there are none.
     * Collective. */
    std::vector<bool>
    gathered(const std::vector<bool> &local) const;

    /**
     * Moves the edges of the next active set as the formulas below predict.
     *
     * If a set is wrong by a layer of nodes along its edge, so is the next set
     * of a primal–dual active set method. A contact that reaches too far by δ
     * has a pressure as at a crack tip, p ~ (δ/2 − x)/√x at the distance x, so
     * that half of the layer shows tension; if it is too short by δ, the
     * opening is w ~ x^{3/2} − (3/2) δ x^{1/2}, and penetration reaches 1.5 δ.
     * Errors are halved, and the number of sets grows with the logarithm of the
     * mesh size. Edges move only by several layers.
     *
     * @param active Set whose plain successor is @p next.
     */
    void
    extrapolate(const std::vector<bool> &active, std::vector<bool> &next) const;

  private:
    using Nodes = std::vector<unsigned int>;

    /** Layers of the marked nodes that are connected with @p seed, by their
     * distance from nodes with a neighbour where @p is_outside; no layers
     * without such a neighbour. Unmarks the nodes. */
    template <typename IsOutside>
    std::vector<Nodes>
    layers(const unsigned int seed,
           std::vector<bool> &marked,
           const IsOutside   &is_outside) const;

    /** Removes from @p next a neighbourhood of @p layers that is as many layers
     * wide. */
    void
    erode(const std::vector<Nodes> &layers, std::vector<bool> &next) const;

    MPI_Comm           communicator;
    unsigned int       first_local = 0;
    std::vector<Nodes> neighbours;
  };
} // namespace Crevasse

#endif
