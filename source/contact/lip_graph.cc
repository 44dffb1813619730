// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/contact/lip_graph.h>

#include <deal.II/base/mpi.h>

#include <map>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Least number of layers by which edges move: for fewer layers the
     * formulas do not hold. */
    constexpr unsigned int fewest_layers = 3;
  } // namespace



  LipGraph::LipGraph(const SignoriniProblem &problem)
    : communicator(problem.stiffness.get_mpi_communicator())
    , neighbours(problem.n_bounds())
  {
    const auto counts =
      Utilities::MPI::all_gather(communicator, problem.bounds.dofs.size());
    for (unsigned int rank = 0;
         rank < Utilities::MPI::this_mpi_process(communicator);
         ++rank)
      first_local += counts[rank];

    std::map<types::global_dof_index, unsigned int> node_of;
    for (const auto dof : problem.all_bounded_dofs())
      node_of.emplace(dof, node_of.size());
    for (const auto &face : problem.bounds.faces)
      for (const auto a : face)
        for (const auto b : face)
          if (a != b)
            neighbours[node_of.at(a)].push_back(node_of.at(b));
  }



  std::vector<bool>
  LipGraph::gathered(const std::vector<bool> &local) const
  {
    std::vector<bool> all = of_all_ranks(communicator, local);
    all.resize(n_nodes());
    return all;
  }



  template <typename IsOutside>
  std::vector<LipGraph::Nodes>
  LipGraph::layers(const unsigned int seed,
                   std::vector<bool> &marked,
                   const IsOutside   &is_outside) const
  {
    Nodes component = {seed}, first_layer;
    marked[seed]    = false;
    for (std::size_t k = 0; k < component.size(); ++k)
      {
        bool at_edge = false;
        for (const unsigned int neighbour : neighbours[component[k]])
          if (marked[neighbour])
            {
              marked[neighbour] = false;
              component.push_back(neighbour);
            }
          else
            at_edge = at_edge || is_outside(neighbour);
        if (at_edge)
          first_layer.push_back(component[k]);
      }
    if (first_layer.empty())
      return {};

    std::vector<bool> remaining(n_nodes(), false);
    for (const unsigned int node : component)
      remaining[node] = true;
    for (const unsigned int node : first_layer)
      remaining[node] = false;
    std::vector<Nodes> result;
    for (Nodes layer = first_layer; !layer.empty();)
      {
        result.push_back(layer);
        layer.clear();
        for (const unsigned int node : result.back())
          for (const unsigned int neighbour : neighbours[node])
            if (remaining[neighbour])
              {
                remaining[neighbour] = false;
                layer.push_back(neighbour);
              }
      }
    return result;
  }



  void
  LipGraph::erode(const std::vector<Nodes> &layers,
                  std::vector<bool>        &next) const
  {
    Nodes front;
    for (const Nodes &layer : layers)
      front.insert(front.end(), layer.begin(), layer.end());
    for (std::size_t k = 0; k < layers.size(); ++k)
      {
        Nodes eroded;
        for (const unsigned int node : front)
          for (const unsigned int neighbour : neighbours[node])
            if (next[neighbour])
              {
                next[neighbour] = false;
                eroded.push_back(neighbour);
              }
        front = std::move(eroded);
      }
  }



  void
  LipGraph::extrapolate(const std::vector<bool> &active,
                        std::vector<bool>       &next) const
  {
    const unsigned int n = n_nodes();
    std::vector<bool>  leaving(n), entering(n);
    for (unsigned int i = 0; i < n; ++i)
      {
        leaving[i]  = active[i] && !next[i];
        entering[i] = !active[i] && next[i];
      }

    for (unsigned int i = 0; i < n; ++i)
      if (leaving[i])
        {
          const auto of_component =
            layers(i, leaving, [&](const unsigned j) { return !active[j]; });
          if (of_component.size() >= fewest_layers)
            erode(of_component, next);
        }
      else if (entering[i])
        {
          const auto of_component =
            layers(i, entering, [&](const unsigned j) { return active[j]; });
          const std::size_t depth = of_component.size();
          if (depth >= fewest_layers)
            for (std::size_t k = (2 * depth + 2) / 3; k < depth; ++k)
              for (const unsigned int node : of_component[k])
                next[node] = false;
        }
  }
} // namespace Crevasse
