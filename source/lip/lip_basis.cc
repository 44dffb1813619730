// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/lip/lip_basis.h>

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/connected_components.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    [[noreturn]] void
    throw_dependent(const Point<dim> &point)
    {
      throw SceneError(
        "[Boundary] Contact or Crack: at " + Text::from_point(point) +
        " lips meet whose openings depend on each other, as two lips with "
        "opposite normals that share a node. Give a crack within the body the "
        "role Crack; or model the half above or below its plane, with the "
        "crack as Contact and the rest of the plane as Symmetry.");
    }



    template <int dim>
    [[noreturn]] void
    throw_unmatched(const Point<dim> &centre)
    {
      throw SceneError(
        "[Boundary] Crack: the face at " + Text::from_point(centre) +
        " has no partner: each face of a crack must lie on a face of the other "
        "lip. Use a Gmsh file that has the crack as a physical group of faces "
        "within the body, along which it is cut; or [Boundary] Contact for a "
        "lip that touches a rigid plane.");
    }



    /** Unit vector, with components removed that are rounding errors. */
    template <int dim>
    Tensor<1, dim>
    unit(Tensor<1, dim> vector)
    {
      const double length = vector.norm();
      for (unsigned int d = 0; d < dim; ++d)
        if (std::abs(vector[d]) < 1e-10 * length)
          vector[d] = 0.;
      return length > 0. ? vector / vector.norm() : vector;
    }
  } // namespace



  /** Data that only the construction of LipBasis needs. */
  template <int dim>
  struct LipBasis<dim>::Surroundings
  {
    std::multimap<Index, unsigned int> nodes_at; ///< nodes by first dof
    std::vector<Tensor<1, dim>>        loads;    ///< ∫φ n of nodes
    Meanings                           supported;
  };



  template <int dim>
  LipBasis<dim>::LipBasis(const DoFHandler<dim>           &dof_handler,
                          const Mapping<dim>              &mapping,
                          const Quadrature<dim - 1>       &face_rule,
                          const BoundaryRoles             &roles,
                          const AffineConstraints<double> &supports)
    : OpeningUnknowns(dof_handler.n_dofs())
    , has_friction(roles.has_friction)
  {
    Surroundings surroundings =
      collect_nodes(find_lip_faces(dof_handler, mapping, face_rule, roles));
    surroundings.supported = gather_supports(dof_handler, supports);
    for (Node &node : nodes)
      if (!hangs(node, surroundings))
        make_opening(node, surroundings.supported);
    if (has_friction)
      for (Node &node : nodes)
        if (node.has_unknown())
          make_sliding(node, surroundings.supported);
    const auto renumbered = number_unknowns();
    const auto renumber   = [&renumbered](Index &unknown) {
      if (const auto found = renumbered.find(unknown);
          found != renumbered.end())
        unknown = found->second;
    };
    for (Node &node : nodes)
      {
        renumber(node.unknown);
        for (Index &unknown : node.sliding)
          renumber(unknown);
      }
    set_weights(surroundings);
    choose_masters();
    number_lips(surroundings);
  }



  template <int dim>
  typename LipBasis<dim>::Surroundings
  LipBasis<dim>::collect_nodes(const std::vector<LipFace<dim>> &faces)
  {
    Surroundings            surroundings;
    std::vector<Point<dim>> centres;
    std::vector<double>     sizes;
    for (const LipFace<dim> &face : faces)
      {
        centres.push_back(face.centre);
        sizes.push_back(face.size);
      }
    const std::vector<unsigned int> partners = find_partners(centres, sizes);
    for (unsigned int f = 0; f < faces.size(); ++f)
      {
        const LipFace<dim> &face = faces[f], &other = faces[partners[f]];
        if (face.is_crack && (partners[f] == f || !other.is_crack))
          throw_unmatched(face.centre);
        if (face.is_crack && partners[f] < f)
          continue;
        auto &of_face = nodes_of_faces.emplace_back();
        for (const auto &node : face.nodes)
          {
            const auto *opposite =
              face.is_crack ? other.node_at(node.point) : nullptr;
            if (face.is_crack && opposite == nullptr)
              throw_unmatched(face.centre);
            Tensor<1, dim>     inward = node.inward;
            const unsigned int number =
              node_number(node,
                          opposite == nullptr ? numbers::invalid_dof_index
                                              : opposite->first,
                          inward,
                          surroundings);
            surroundings.loads.resize(nodes.size());
            surroundings.loads[number] +=
              inward * node.inward >= 0. ? node.load : -node.load;
            nodes[number].normal += inward;
            nodes[number].area += node.area;
            of_face.push_back(number);
          }
      }
    for (Node &node : nodes)
      node.normal = unit(node.normal);
    return surroundings;
  }



  template <int dim>
  unsigned int
  LipBasis<dim>::node_number(const typename LipFace<dim>::Node &node,
                             const Index                        other_side,
                             Tensor<1, dim>                    &inward,
                             Surroundings                      &surroundings)
  {
    auto      &nodes_at = surroundings.nodes_at;
    const bool is_crack = other_side != numbers::invalid_dof_index;
    const auto search   = [&](const Index                 first,
                            const std::array<Index, 2> &sides) -> int {
      const auto [begin, end] = nodes_at.equal_range(first);
      for (auto at = begin; at != end; ++at)
        if (const Node &known = nodes[at->second]; known.sides == sides)
          {
            // Where rigid planes meet, a node has an opening for each plane.
            const double cosine = unit(known.normal) * unit(inward);
            if (!is_crack && cosine < -1. + 1e-10)
              throw_dependent(node.point);
            if (is_crack || cosine > 1. - 1e-10)
              return at->second;
          }
      return -1;
    };
    if (const int number = search(node.first, {{node.first, other_side}});
        number >= 0)
      return number;
    if (is_crack)
      if (const int number = search(other_side, {{other_side, node.first}});
          number >= 0)
        {
          inward *= -1.;
          return number;
        }
    Node added;
    added.point = node.point;
    added.sides = {{node.first, other_side}};
    nodes_at.emplace(node.first, nodes.size());
    if (is_crack)
      nodes_at.emplace(other_side, nodes.size());
    nodes.push_back(added);
    return nodes.size() - 1;
  }



  template <int dim>
  OpeningUnknowns::Meanings
  LipBasis<dim>::gather_supports(
    const DoFHandler<dim>           &dof_handler,
    const AffineConstraints<double> &supports) const
  {
    const IndexSet &owned = dof_handler.locally_owned_dofs();
    Meanings        mine, all;
    for (const Node &node : nodes)
      for (const Index first : node.sides)
        for (unsigned int d = 0; d < dim; ++d)
          if (const Index dof = first + d;
              first != numbers::invalid_dof_index && owned.is_element(dof))
            if (const auto *entries = supports.get_constraint_entries(dof))
              mine[dof] = *entries;
    for (auto &of_rank :
         Utilities::MPI::all_gather(dof_handler.get_communicator(), mine))
      all.merge(of_rank);
    return all;
  }



  template <int dim>
  bool
  LipBasis<dim>::hangs(Node &node, const Surroundings &surroundings) const
  {
    const auto        &nodes_at  = surroundings.nodes_at;
    const Meanings    &supported = surroundings.supported;
    const unsigned int component = node.component();
    const auto add_master        = [&](const Index first, const double factor) {
      const auto [begin, end] = nodes_at.equal_range(first);
      for (auto at = begin; at != end; ++at)
        if (std::abs(nodes[at->second].normal * node.normal) > 0.5)
          {
            node.masters.emplace_back(at->second, factor);
            return;
          }
    };
    unsigned int n_sides = 0, n_hanging = 0;
    for (const Index first : node.sides)
      {
        if (first == numbers::invalid_dof_index)
          continue;
        ++n_sides;
        bool is_hanging = false;
        for (unsigned int d = 0; d < dim; ++d)
          if (const auto line = supported.find(first + d);
              line != supported.end())
            for (const auto &[dof, factor] : line->second)
              if (dof < first || dof >= first + dim)
                {
                  is_hanging = true;
                  if (d == component && n_sides == 1)
                    add_master(dof - component, factor);
                }
        n_hanging += is_hanging ? 1 : 0;
      }
    // If only one side hangs, the opening is not interpolated.
    if (n_hanging < n_sides)
      node.masters.clear();
    return n_hanging == n_sides;
  }



  template <int dim>
  void
  LipBasis<dim>::make_opening(Node &node, const Meanings &supported)
  {
    // With two lips, a degree of freedom may belong to another rank's lip;
    // friction needs openings and slips on one rank.
    const auto unknown =
      make_unknown(jump_along(node.normal, node, supported),
                   node.sides[1] == numbers::invalid_dof_index &&
                     !has_friction);
    if (!unknown)
      throw_dependent(node.point);
    std::tie(node.unknown, node.sign) = *unknown;
  }



  template <int dim>
  void
  LipBasis<dim>::set_weights(Surroundings &surroundings)
  {
    auto &loads = surroundings.loads;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      for (const auto &[master, factor] : nodes[i].masters)
        loads[master] +=
          (nodes[i].normal * nodes[master].normal > 0. ? factor : -factor) *
          loads[i];
    for (const auto &on_face : nodes_of_faces)
      {
        double largest = 0.;
        for (const unsigned int i : on_face)
          largest = std::max(largest, loads[i].norm());
        // Dividing forces by a smaller weight would amplify errors.
        constexpr double least = 1e-3;
        for (const unsigned int i : on_face)
          if (const double weight = loads[i] * nodes[i].normal;
              nodes[i].has_unknown() && weight > least * largest)
            nodes[i].weight = weight;
      }
  }



  template <int dim>
  void
  LipBasis<dim>::choose_masters()
  {
    std::map<unsigned int, std::pair<double, unsigned int>> nearest;
    for (const auto &on_face : nodes_of_faces)
      for (const unsigned int i : on_face)
        if (nodes[i].weight == 0.)
          for (const unsigned int j : on_face)
            if (nodes[j].weight > 0.)
              {
                const double length = nodes[i].point.distance(nodes[j].point);
                const auto [at, is_first] =
                  nearest.emplace(i, std::make_pair(length, j));
                // Use the first of equally near nodes.
                if (!is_first && length < (1. - 1e-10) * at->second.first)
                  at->second = {length, j};
              }
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        Node                                        &node = nodes[i];
        double                                       rest = 1., most = 0.;
        std::vector<std::pair<unsigned int, double>> masters;
        const auto                                   best = nearest.find(i);
        int strongest = best == nearest.end() ? -1 : int(best->second.second);
        for (const auto &[master, factor] : node.masters)
          if (nodes[master].weight > 0.)
            {
              masters.emplace_back(master, factor);
              rest -= factor;
              if (factor > most)
                strongest = master;
              most = std::max(most, factor);
            }
        if (node.weight == 0. && strongest >= 0 && std::abs(rest) > 1e-10)
          // A hanging node takes the share of masters without weight from the
          // nearest node.
          masters.emplace_back(strongest, rest);
        for (const auto &[master, factor] : masters)
          nodes[master].area += factor * node.area;
        node.masters = masters;
      }
  }



  template <int dim>
  void
  LipBasis<dim>::number_lips(const Surroundings &surroundings)
  {
    boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS> graph(
      nodes.size());
    for (const auto &on_face : nodes_of_faces)
      for (const unsigned int i : on_face)
        add_edge(on_face.front(), i, graph);
    for (const auto &[first, i] : surroundings.nodes_at)
      add_edge(surroundings.nodes_at.find(first)->second, i, graph);
    std::vector<unsigned int> numbers(nodes.size());
    boost::connected_components(graph, numbers.data());
    for (unsigned int i = 0; i < nodes.size(); ++i)
      nodes[i].lip = numbers[i];
  }



  template class LipBasis<2>;
  template class LipBasis<3>;
} // namespace Crevasse
