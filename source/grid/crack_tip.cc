// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/grid/crack_tip.h>

#include <algorithm>
#include <limits>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Outward unit normal of a plane face of a cell. */
    template <int dim>
    Tensor<1, dim>
    outward_normal(const typename Triangulation<dim>::cell_iterator &cell,
                   const unsigned int                                face)
    {
      const auto     boundary = cell->face(face);
      Tensor<1, dim> normal;
      if constexpr (dim == 2)
        normal = cross_product_2d(boundary->vertex(1) - boundary->vertex(0));
      else
        normal = cross_product_3d(
          Tensor<1, dim>(boundary->vertex(1) - boundary->vertex(0)),
          Tensor<1, dim>(boundary->vertex(2) - boundary->vertex(0)));
      normal /= normal.norm();
      return normal * (boundary->center() - cell->center()) < 0. ? -normal
                                                                 : normal;
    }



    /** A face of the lip or of the plane of symmetry at one of its ends: at a
     * vertex in the plane, stored twice, or at an edge in space. */
    template <int dim>
    struct FaceAtEnd
    {
      types::boundary_id                id;
      unsigned int                      index; ///< index of the vertex or edge
      std::pair<Point<dim>, Point<dim>> end;
      Point<dim>                        center, middle; ///< of chord and arc
      Tensor<1, dim>                    normal;
    };



    /** Faces by the index of their vertex or edge. */
    template <int dim>
    using FacesAtEnds = std::multimap<unsigned int, FaceAtEnd<dim>>;



    template <int dim>
    FacesAtEnds<dim>
    faces_with(std::set<types::boundary_id>        ids,
               const Triangulation<dim>           &mesh,
               const std::set<types::boundary_id> &more_ids = {})
    {
      ids.insert(more_ids.begin(), more_ids.end());
      FacesAtEnds<dim> faces;
      for (const auto &cell : mesh.cell_iterators_on_level(0))
        for (const unsigned int f : cell->face_indices())
          if (const auto face = cell->face(f);
              face->at_boundary() && ids.count(face->boundary_id()) > 0)
            {
              const Tensor<1, dim> normal = outward_normal<dim>(cell, f);
              const auto           add    = [&](const unsigned int index,
                                   const Point<dim>  &first,
                                   const Point<dim>  &last) {
                faces.emplace(index,
                              FaceAtEnd<dim>{face->boundary_id(),
                                             index,
                                             {first, last},
                                             face->center(),
                                             face->center(true),
                                             normal});
              };
              if constexpr (dim == 2)
                for (const unsigned int v : face->vertex_indices())
                  add(face->vertex_index(v), face->vertex(v), face->vertex(v));
              else
                for (const unsigned int l : face->line_indices())
                  add(face->line_index(l),
                      face->line(l)->vertex(0),
                      face->line(l)->vertex(1));
            }
      return faces;
    }



    /** Calls f(lip face, face of the plane of symmetry) where a lip face
     * continues straight as a face of the plane of symmetry. */
    template <int dim, typename Function>
    void
    for_each_end_of_lip(const Triangulation<dim> &mesh,
                        const BoundaryRoles      &roles,
                        const Function           &f)
    {
      const FacesAtEnds<dim> planes = faces_with(roles.symmetry, mesh);
      for (const auto &[index, lip] :
           faces_with(roles.contact, mesh, roles.open))
        {
          const auto [first, last] = planes.equal_range(index);
          for (auto plane = first; plane != last; ++plane)
            if (lip.normal * plane->second.normal > 1. - 1e-10)
              f(lip, plane->second);
        }
    }



    /** Calls f(lip face, other lip face) where the two lips of a crack meet. */
    template <int dim, typename Function>
    void
    for_each_end_of_crack(const Triangulation<dim> &mesh,
                          const BoundaryRoles      &roles,
                          const Function           &f)
    {
      const FacesAtEnds<dim> lips = faces_with(roles.crack, mesh, roles.open);
      for (auto first = lips.begin(); first != lips.end();)
        {
          const auto last = lips.upper_bound(first->first);
          if (const auto next = std::next(first);
              std::distance(first, last) == 2 &&
              first->second.normal * next->second.normal < -1. + 1e-10)
            f(first->second, next->second);
          first = last;
        }
    }
  } // namespace



  std::vector<CrackTip>
  find_crack_tips(const Triangulation<2> &mesh, const BoundaryRoles &roles)
  {
    std::map<unsigned int, CrackTip> tips;
    for_each_end_of_lip<2>(
      mesh, roles, [&](const FaceAtEnd<2> &lip, const FaceAtEnd<2> &plane) {
        const Point<2>    &tip   = plane.end.first;
        const Tensor<1, 2> ahead = plane.center - tip;
        if (ahead * (lip.center - tip) < 0.)
          tips[lip.index] = {tip,
                             ahead / ahead.norm(),
                             -plane.normal,
                             false,
                             roles.open.count(lip.id) > 0};
      });
    std::vector<CrackTip> list;
    for (const auto &[vertex, tip] : tips)
      list.push_back(tip);
    for_each_end_of_crack<2>(
      mesh, roles, [&](const FaceAtEnd<2> &lip, const FaceAtEnd<2> &) {
        // The tangent of a circle halves angles between chords.
        const Point<2>    &tip  = lip.end.first;
        const Tensor<1, 2> half = tip - lip.middle, all = tip - lip.center;
        Tensor<1, 2>       ahead = half;
        const bool         is_curved =
          half * all < (1. - 1e-14) * half.norm() * all.norm();
        if (is_curved)
          ahead = 2. * (half * all) / half.norm_square() * half - all;
        ahead /= ahead.norm();
        const Tensor<1, 2> inward({-ahead[1], ahead[0]});
        // The other end of the lip's face is at −2 all.
        list.push_back({tip,
                        ahead,
                        inward,
                        true,
                        roles.open.count(lip.id) > 0,
                        is_curved ? -(all * inward) / all.norm_square() : 0.});
      });
    return list;
  }



  std::vector<CrackTip>
  crack_tips(const Triangulation<2> &mesh,
             const BoundaryRoles    &roles,
             const std::string      &wanted_by)
  {
    const std::vector<CrackTip> tips = find_crack_tips(mesh, roles);
    if (tips.empty())
      throw SceneError(
        wanted_by +
        ": the mesh has no crack tip, a vertex where a lip ([Boundary] "
        "Contact or Open crack) continues as a plane of symmetry ([Boundary] "
        "Symmetry), or where the lips of a [Boundary] Crack or Open crack "
        "meet. Give the body a crack, or turn this off.");
    if (std::all_of(tips.begin(), tips.end(), [](const CrackTip &tip) {
          return tip.two_lips;
        }))
      return tips;
    for (const CrackTip &tip : tips)
      if (tip.two_lips)
        throw SceneError(wanted_by + ": the crack at " +
                         Text::from_point(tip.position) +
                         " has two lips ([Boundary] Crack), but this needs one "
                         "lip on a plane of symmetry. Turn this off.");
    if (tips.size() > 1)
      {
        std::vector<std::string> places;
        for (const CrackTip &tip : tips)
          places.push_back(Text::from_point(tip.position));
        throw SceneError(wanted_by + ": the mesh has " +
                         std::to_string(tips.size()) + " crack tips, at " +
                         Text::join(places, " and ") +
                         ", but one is allowed. Model a part with one tip, "
                         "using symmetry, or turn this off.");
      }
    return tips;
  }



  double
  straight_length(const Triangulation<2> &mesh,
                  const BoundaryRoles    &roles,
                  const CrackTip         &tip)
  {
    double length = std::numeric_limits<double>::infinity();
    if (!tip.two_lips)
      return length;
    for (const CrackTip &other : find_crack_tips(mesh, roles))
      if (other.position != tip.position)
        length = std::min(length, other.position.distance(tip.position));
    for (const auto &cell : mesh.cell_iterators_on_level(0))
      {
        const double tiny    = 1e-8 * cell->diameter();
        const auto   side_of = [&tip](const Point<2> &local) {
          return tip.is_on_line(local) ? 0 : (local[1] > 0. ? 1 : -1);
        };
        std::set<int> sides;
        for (const unsigned int v : cell->vertex_indices())
          sides.insert(side_of(tip.local(cell->vertex(v))));
        const bool is_cut = sides.count(1) == 1 && sides.count(-1) == 1;
        for (const unsigned int f : cell->face_indices())
          {
            const auto     face = cell->face(f);
            const Point<2> a    = tip.local(face->vertex(0));
            const Point<2> b    = tip.local(face->vertex(1));
            const int      at_a = side_of(a), at_b = side_of(b);
            if (at_a == 0 && at_b == 0)
              {
                if (a[0] + b[0] < 0. &&
                    !(face->at_boundary() &&
                      tip.is_on_line(tip.local(face->center(true)))))
                  length = std::min(length, -std::max(a[0], b[0]));
              }
            else if (is_cut && at_a * at_b <= 0)
              {
                const double X = (a[0] * b[1] - b[0] * a[1]) / (b[1] - a[1]);
                if (X < -tiny)
                  length = std::min(length, -X);
              }
          }
      }
    return length;
  }



  template <int dim>
  CrackFront<dim>
  crack_front(const Triangulation<dim> &mesh, const BoundaryRoles &roles)
  {
    CrackFront<dim> front;
    const auto      add = [&front](const FaceAtEnd<dim> &lip,
                              const FaceAtEnd<dim> &) {
      front.push_back(lip.end);
    };
    for_each_end_of_lip<dim>(mesh, roles, add);
    for_each_end_of_crack<dim>(mesh, roles, add);
    return front;
  }



  std::vector<FrontEdge>
  oriented_crack_front(const Triangulation<3> &mesh, const BoundaryRoles &roles)
  {
    std::vector<FrontEdge> front;
    const auto             add = [&front](const FaceAtEnd<3> &lip,
                              const Tensor<1, 3> &inward,
                              const bool          two_lips) {
      auto [first, last] = lip.end;
      if (cross_product_3d(inward, last - first) * (first - lip.center) < 0.)
        std::swap(first, last);
      front.push_back({first, last, inward, two_lips});
    };
    for_each_end_of_lip<3>(
      mesh, roles, [&add](const FaceAtEnd<3> &lip, const FaceAtEnd<3> &plane) {
        add(lip, -plane.normal, false);
      });
    for_each_end_of_crack<3>(
      mesh, roles, [&add](const FaceAtEnd<3> &lip, const FaceAtEnd<3> &) {
        unsigned int last = 2;
        while (last > 0 && std::abs(lip.normal[last]) < 1e-6)
          --last;
        add(lip, lip.normal[last] > 0. ? lip.normal : -lip.normal, true);
      });
    return front;
  }



  template decltype(crack_front<2>) crack_front<2>;
  template decltype(crack_front<3>) crack_front<3>;
} // namespace Crevasse
