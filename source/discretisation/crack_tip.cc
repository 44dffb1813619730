// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/crack_tip.h>

#include <cmath>
#include <map>
#include <utility>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** The outward unit normal of a plane face of a cell. */
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



    /** A face of the lip or of the plane of symmetry at one of its vertices. */
    template <int dim>
    struct FaceAtVertex
    {
      Point<dim>     vertex, center;
      Tensor<1, dim> normal;
    };



    template <int dim>
    using FacesAtVertices =
      std::multimap<unsigned int, FaceAtVertex<dim>>; // by vertex



    template <int dim>
    FacesAtVertices<dim>
    faces_with(const std::set<types::boundary_id> &ids,
               const Triangulation<dim>           &mesh)
    {
      FacesAtVertices<dim> faces;
      for (const auto &cell : mesh.cell_iterators_on_level(0))
        for (const unsigned int f : cell->face_indices())
          if (const auto face = cell->face(f);
              face->at_boundary() && ids.count(face->boundary_id()) > 0)
            for (const unsigned int v : face->vertex_indices())
              faces.emplace(face->vertex_index(v),
                            FaceAtVertex<dim>{face->vertex(v),
                                              face->center(),
                                              outward_normal<dim>(cell, f)});
      return faces;
    }



    /** Calls f(lip face, face of the plane of symmetry) where the one goes
     * straight on as the other. */
    template <int dim, typename Function>
    void
    for_each_end_of_lip(const Triangulation<dim> &mesh,
                        const BoundaryRoles      &roles,
                        const Function           &f)
    {
      const FacesAtVertices<dim> planes = faces_with(roles.symmetry, mesh);
      for (const auto &[vertex, lip] : faces_with(roles.contact, mesh))
        {
          const auto [first, last] = planes.equal_range(vertex);
          for (auto plane = first; plane != last; ++plane)
            if (lip.normal * plane->second.normal > 1. - 1e-10)
              f(vertex, lip, plane->second);
        }
    }
  } // namespace



  Point<2>
  CrackTip::local(const Point<2> &point) const
  {
    const Tensor<1, 2> distance = point - position;
    return {distance * ahead, distance * inward};
  }



  Tensor<2, 2>
  CrackTip::to_local() const
  {
    Tensor<2, 2> rows;
    rows[0] = ahead;
    rows[1] = inward;
    return rows;
  }



  Tensor<1, 2>
  CrackTip::global(const Tensor<1, 2> &vector) const
  {
    return vector[0] * ahead + vector[1] * inward;
  }



  std::vector<CrackTip>
  find_crack_tips(const Triangulation<2> &mesh, const BoundaryRoles &roles)
  {
    std::map<unsigned int, CrackTip> tips;
    for_each_end_of_lip<2>(
      mesh,
      roles,
      [&tips](const unsigned int     vertex,
              const FaceAtVertex<2> &lip,
              const FaceAtVertex<2> &plane) {
        const Tensor<1, 2> ahead = plane.center - plane.vertex;
        if (ahead * (lip.center - lip.vertex) < 0.)
          tips[vertex] = {plane.vertex, ahead / ahead.norm(), -plane.normal};
      });
    std::vector<CrackTip> list;
    for (const auto &[vertex, tip] : tips)
      list.push_back(tip);
    return list;
  }



  CrackTip
  only_crack_tip(const Triangulation<2> &mesh,
                 const BoundaryRoles    &roles,
                 const std::string      &wanted_by)
  {
    const std::vector<CrackTip> tips = find_crack_tips(mesh, roles);
    if (tips.empty())
      throw SceneError(wanted_by +
                       ": the mesh has no crack tip, a vertex where a face of "
                       "the lip ([Boundary] Contact) goes straight on as one "
                       "of the plane of symmetry ([Boundary] Symmetry). Give "
                       "the body a crack, or turn this off.");
    if (tips.size() > 1)
      {
        std::vector<std::string> places;
        for (const CrackTip &tip : tips)
          places.push_back(Text::from_point(tip.position));
        throw SceneError(wanted_by + ": the mesh has " +
                         std::to_string(tips.size()) + " crack tips, at " +
                         Text::join(places, " and ") +
                         ", where one is allowed. Model a part with one of "
                         "them, using symmetry, or turn this off.");
      }
    return tips.front();
  }



  template <int dim>
  std::vector<Point<dim>>
  crack_front(const Triangulation<dim> &mesh, const BoundaryRoles &roles)
  {
    std::map<unsigned int, Point<dim>> vertices;
    for_each_end_of_lip<dim>(mesh,
                             roles,
                             [&vertices](const unsigned int       vertex,
                                         const FaceAtVertex<dim> &lip,
                                         const FaceAtVertex<dim> &) {
                               vertices[vertex] = lip.vertex;
                             });
    std::vector<Point<dim>> list;
    for (const auto &[vertex, point] : vertices)
      list.push_back(point);
    return list;
  }



  template std::vector<Point<2>>
  crack_front<2>(const Triangulation<2> &, const BoundaryRoles &);
  template std::vector<Point<3>>
  crack_front<3>(const Triangulation<3> &, const BoundaryRoles &);
} // namespace Crevasse
