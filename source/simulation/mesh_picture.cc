// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/grid/cell_quality.h>
#include <crevasse/grid/crack_tip.h>
#include <crevasse/grid/curved_edges.h>
#include <crevasse/model/body.h>
#include <crevasse/parameters/automatic.h>
#include <crevasse/parameters/physical_names.h>
#include <crevasse/simulation/mesh_picture.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>

#include <numeric>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    std::array<double, dim>
    coordinates(const Point<dim> &point)
    {
      std::array<double, dim> all;
      std::copy_n(point.begin_raw(), dim, all.begin());
      return all;
    }



    /** Vertices around a face of the boundary, counterclockwise as seen from
     * outside; in the plane two, with the body on the left. */
    template <int dim>
    std::vector<unsigned int>
    vertices_around(const typename Triangulation<dim>::face_iterator &face,
                    const Tensor<1, dim>                             &normal)
    {
      std::vector<unsigned int> numbers;
      for (const unsigned int v : {0, 1, 3, 2})
        if (v < face->n_vertices())
          numbers.push_back(face->vertex_index(v));
      bool is_turned;
      if constexpr (dim == 2)
        is_turned =
          cross_product_2d(face->vertex(1) - face->vertex(0)) * normal < 0.;
      else
        is_turned = cross_product_3d(face->vertex(3) - face->vertex(0),
                                     face->vertex(2) - face->vertex(1)) *
                      normal <
                    0.;
      if (is_turned)
        std::reverse(numbers.begin(), numbers.end());
      return numbers;
    }



    template <int dim>
    double
    size_of(const FEValuesBase<dim> &values)
    {
      const std::vector<double> &weights = values.get_JxW_values();
      return std::accumulate(weights.begin(), weights.end(), 0.);
    }



    /** Cells and the faces of the boundary with their numbers and sizes. */
    template <int dim>
    Summary
    cells_and_faces(const Mesh<dim> &mesh)
    {
      const unsigned int    degree = has_curved_edges(mesh) ? 2 : 1;
      const MappingQ<dim>   mapping(degree);
      const FE_Nothing<dim> no_unknowns;
      FEValues<dim>         values(mapping,
                           no_unknowns,
                           QGauss<dim>(degree + 1),
                           update_JxW_values);
      FEFaceValues<dim>     face_values(mapping,
                                    no_unknowns,
                                    QGauss<dim - 1>(degree + 1),
                                    update_JxW_values | update_normal_vectors);
      Summary cells = {{"quality", scaled_jacobians(mesh)}}, faces;
      for (const auto &cell : mesh.active_cell_iterators())
        {
          values.reinit(cell);
          cells["id"].push_back(cell->material_id());
          cells["size"].push_back(size_of(values));
          std::array<unsigned int, GeometryInfo<dim>::vertices_per_cell>
            vertices;
          for (const unsigned int v : cell->vertex_indices())
            vertices[v] = cell->vertex_index(v);
          cells["vertices"].push_back(vertices);
          for (const unsigned int f : cell->face_indices())
            if (const auto face = cell->face(f); face->at_boundary())
              {
                face_values.reinit(cell, f);
                faces["id"].push_back(face->boundary_id());
                faces["size"].push_back(size_of(face_values));
                faces["cell"].push_back(cell->active_cell_index());
                faces["vertices"].push_back(
                  vertices_around<dim>(face, face_values.normal_vector(0)));
              }
        }
      return {{"cells", cells}, {"faces", faces}};
    }
  } // namespace



  template <int dim>
  Summary
  mesh_picture(const Scene &scene, const Mesh<dim> &mesh)
  {
    const BoundaryRoles roles   = boundary_roles(scene);
    Summary             picture = cells_and_faces(mesh);
    picture["title"]            = scene.title;
    picture["dimension"]        = dim;
    picture["axisymmetric"]     = scene.is_axisymmetric();
    picture["boundaries"]       = boundary_names(scene);
    picture["materials"]        = material_names(scene);
    for (const BoundaryRole &role : boundary_role_table)
      picture["roles"][role.name] = roles.*role.ids;
    for (const Point<dim> &vertex : mesh.get_vertices())
      picture["points"].push_back(coordinates(vertex));
    for (const FixedPoint<dim> &fixed : fixed_points<dim>(scene))
      picture["fixed"].push_back({{"point", coordinates(fixed.point)},
                                  {"components", fixed.components}});
    for (const NamedPoint &probe : probes(scene))
      picture["probes"].push_back(
        {{"name", probe.name}, {"point", probe.coordinates}});
    for (const auto &[first, last] : crack_front<dim>(mesh, roles))
      picture["front"].push_back({coordinates(first), coordinates(last)});
    return picture;
  }



  template decltype(mesh_picture<2>) mesh_picture<2>;
  template decltype(mesh_picture<3>) mesh_picture<3>;
} // namespace Crevasse
