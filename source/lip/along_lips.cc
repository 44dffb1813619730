// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/lip/along_lips.h>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Puts the nodes of a face in the order of their distances from @p end. */
    template <int dim>
    void
    sort_from(const Point<dim>          &end,
              const LipBasis<dim>       &basis,
              std::vector<unsigned int> &face)
    {
      std::sort(face.begin(), face.end(), [&](const auto a, const auto b) {
        return end.distance(basis.nodes[a].point) <
               end.distance(basis.nodes[b].point);
      });
    }
  } // namespace



  template <int dim>
  std::vector<unsigned int>
  nodes_along_lips(const LipBasis<dim> &basis)
  {
    const auto               &nodes = basis.nodes;
    std::vector<unsigned int> starts(nodes.size()), order;
    std::iota(starts.begin(), starts.end(), 0);
    if (dim == 3)
      {
        std::stable_sort(starts.begin(),
                         starts.end(),
                         [&](const auto a, const auto b) {
                           return nodes[a].lip < nodes[b].lip;
                         });
        return starts;
      }
    auto                                      faces = basis.nodes_of_faces;
    std::multimap<unsigned int, unsigned int> faces_at; // faces by end
    for (unsigned int f = 0; f < faces.size(); ++f)
      {
        // The farthest node from any node is an end, and from there the other.
        for (unsigned int end = 0; end < 2; ++end)
          sort_from(nodes[faces[f].back()].point, basis, faces[f]);
        faces_at.emplace(faces[f].front(), f);
        faces_at.emplace(faces[f].back(), f);
      }
    // Lips that are closed curves have no end, and begin anywhere.
    const auto place = [&](const unsigned int i) {
      return std::make_tuple(nodes[i].lip,
                             faces_at.count(i) != 1,
                             nodes[i].point[0],
                             nodes[i].point[1]);
    };
    std::sort(starts.begin(), starts.end(), [&](const auto a, const auto b) {
      return place(a) < place(b);
    });

    std::vector<bool> has_node(nodes.size()), has_face(faces.size());
    const auto        add = [&](const unsigned int i) {
      if (!has_node[i])
        order.push_back(i);
      has_node[i] = true;
    };
    for (unsigned int at : starts)
      for (add(at);;)
        {
          const auto [first, end] = faces_at.equal_range(at);
          const auto next = std::find_if(first, end, [&](const auto &entry) {
            return !has_face[entry.second];
          });
          if (next == end)
            break;
          has_face[next->second] = true;
          auto &face             = faces[next->second];
          sort_from(nodes[at].point, basis, face);
          std::for_each(face.begin(), face.end(), add);
          at = face.back();
        }
    return order;
  }



  template decltype(nodes_along_lips<2>) nodes_along_lips<2>;
  template decltype(nodes_along_lips<3>) nodes_along_lips<3>;
} // namespace Crevasse
