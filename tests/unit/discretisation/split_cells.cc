// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Triangles, tetrahedra and wedges of Gmsh files, divided: conforming meshes
// with the volumes and areas of the groups, and curved edges.

#include <crevasse/discretisation/space.h>
#include <crevasse/grid/geometry.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_tools.h>

#include <array>
#include <crevasse_tests/tests.h>
#include <fstream>
#include <memory>
#include <random>
#include <tuple>

using namespace Crevasse;
using dealii::Point;

namespace
{
  struct Element
  {
    unsigned int              type, group; // of Gmsh
    std::vector<unsigned int> nodes;       // from 0
  };

  template <int dim>
  std::unique_ptr<Mesh<dim>>
  read(const std::vector<Point<3>> &nodes, const std::vector<Element> &elements)
  {
    GeometryParameters parameters;
    parameters.shape     = Shape::mesh_file;
    parameters.mesh_file = "split_cells.msh";
    std::ofstream file(parameters.mesh_file);
    file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n"
         << nodes.size() << '\n';
    file.precision(17);
    for (unsigned int i = 0; i < nodes.size(); ++i)
      file << i + 1 << ' ' << nodes[i] << '\n';
    file << "$EndNodes\n$Elements\n" << elements.size() << '\n';
    for (unsigned int i = 0; i < elements.size(); ++i)
      {
        const auto &[type, group, of_element] = elements[i];
        file << i + 1 << ' ' << type << " 2 " << group << ' ' << group;
        for (const unsigned int node : of_element)
          file << ' ' << node + 1;
        file << '\n';
      }
    file << "$EndElements\n" << std::flush;
    auto mesh = std::make_unique<Mesh<dim>>(MPI_COMM_WORLD);
    make_mesh(parameters, *mesh);
    return mesh;
  }

  /** A grid of points of the cube whose inner points are moved. */
  std::vector<Point<3>>
  grid(const unsigned int n)
  {
    std::mt19937                           random(1);
    std::uniform_real_distribution<double> shift(-0.15 / n, 0.15 / n);
    std::vector<Point<3>>                  points;
    for (unsigned int k = 0; k <= n; ++k)
      for (unsigned int j = 0; j <= n; ++j)
        for (unsigned int i = 0; i <= n; ++i)
          {
            Point<3> point(double(i) / n, double(j) / n, double(k) / n);
            for (unsigned int d = 0; d < 3; ++d)
              if (point[d] > 0. && point[d] < 1.)
                point[d] += shift(random);
            points.push_back(point);
          }
    return points;
  }

  /** Largest difference between the volumes of the materials 1 and 2, the areas
   * of the boundaries, and those of the file: all sides have the area 1. */
  void
  compare(const Mesh<3> &mesh, const std::array<double, 3> &volumes)
  {
    std::array<double, 3> own = {}, areas = {};
    for (const auto &cell : mesh.active_cell_iterators())
      {
        own[cell->material_id()] += cell->measure();
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            areas[face->boundary_id()] += face->measure();
      }
    check_below("volume of material 1", std::abs(own[1] - volumes[1]), 1e-13);
    check_below("volume of material 2", std::abs(own[2] - volumes[2]), 1e-13);
    check_below("area of boundary 1", std::abs(areas[1] - 1.), 1e-13);
    check_below("area of boundary 2", std::abs(areas[2] - 5.), 1e-13);
  }

  double
  volume(const std::vector<Point<3>>     &points,
         const std::vector<unsigned int> &t)
  {
    const auto a = points[t[1]] - points[t[0]], b = points[t[2]] - points[t[0]],
               c = points[t[3]] - points[t[0]];
    return std::abs(dealii::cross_product_3d(a, b) * c) / 6.;
  }

  /** Whether points are all in one side of the cube: 1 for z = 0, 2 for others,
   * 0 for none. */
  unsigned int
  side_of(const std::vector<Point<3>>     &points,
          const std::vector<unsigned int> &nodes)
  {
    for (const unsigned int d : {2, 0, 1})
      for (const double value : {0., 1.})
        if (std::all_of(nodes.begin(), nodes.end(), [&](const unsigned int n) {
              return points[n][d] == value;
            }))
          return d == 2 && value == 0. ? 1 : 2;
    return 0;
  }

  void
  tetrahedra()
  {
    section("tetrahedra");
    const unsigned int    n       = 3;
    const auto            points  = grid(n);
    std::array<double, 3> volumes = {};
    std::vector<Element>  elements;
    const unsigned int    steps[] = {1, n + 1, (n + 1) * (n + 1)};
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          {
            std::array<unsigned int, 3> order = {{0, 1, 2}};
            do // the six tetrahedra of a cube, along its diagonal
              {
                std::vector<unsigned int> t = {i + j * steps[1] + k * steps[2]};
                for (const unsigned int d : order)
                  t.push_back(t.back() + steps[d]);
                elements.push_back({4, i == 0 ? 1u : 2u, t});
                volumes[i == 0 ? 1 : 2] += volume(points, t);
                for (unsigned int skipped = 0; skipped < 4; ++skipped)
                  {
                    std::vector<unsigned int> face = t;
                    face.erase(face.begin() + skipped);
                    if (const auto side = side_of(points, face))
                      elements.push_back({2, side, face});
                  }
            } while (std::next_permutation(order.begin(), order.end()));
          }
    const auto mesh = read<3>(points, elements);
    check("four hexahedra of each",
          mesh->n_active_cells() == 4 * 6 * n * n * n);
    compare(*mesh, volumes);
  }

  /** Wedges beside hexahedra, which are divided in one direction. */
  void
  wedges()
  {
    section("wedges");
    const unsigned int n      = 2;
    const auto         points = [&]() {
      auto all = grid(n);
      for (auto &point : all) // plane faces: volumes in closed form
        for (unsigned int d = 0; d < 3; ++d)
          point[d] = std::round(n * point[d]) / n;
      return all;
    }();
    std::vector<Element> elements;
    const auto add_sides = [&](const std::vector<unsigned int> &face) {
      if (const auto side = side_of(points, face))
        elements.push_back({face.size() == 3 ? 2u : 3u, side, face});
    };
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          {
            const unsigned int a = i + 3 * j + 9 * k, b = a + 1, c = a + 4,
                               d = a + 3;
            if (i == 0)
              {
                elements.push_back(
                  {5, 1, {a, b, c, d, a + 9, b + 9, c + 9, d + 9}});
                add_sides({a, b, c, d});
                add_sides({a + 9, b + 9, c + 9, d + 9});
              }
            else
              for (const auto &[u, v, w] :
                   {std::make_tuple(a, b, c), std::make_tuple(a, c, d)})
                {
                  elements.push_back({6, 2, {u, v, w, u + 9, v + 9, w + 9}});
                  add_sides({u, v, w});
                  add_sides({u + 9, v + 9, w + 9});
                }
            add_sides({a, b, b + 9, a + 9});
            add_sides({b, c, c + 9, b + 9});
            add_sides({c, d, d + 9, c + 9});
            add_sides({d, a, a + 9, d + 9});
          }
    const auto mesh = read<3>(points, elements);
    // Edges along y are edges of triangles, and so are those along x on the
    // right; the left hexahedra have only the first in common with them.
    check("three hexahedra of a wedge, two of a hexahedron",
          mesh->n_active_cells() == 4 * 6 + 4 * 2);
    compare(*mesh, {{0., 0.5, 0.5}});
  }

  /** Area of a disc of one triangle fan of second order, with arcs, and the
   * largest distance of the nodes on the rim from the circle. */
  void
  curved()
  {
    section("curved");
    const unsigned int    n      = 12;
    std::vector<Point<3>> points = {Point<3>()};
    std::vector<Element>  elements;
    const auto            at = [](const double r, const double part) {
      const double phi = 2. * dealii::numbers::PI * part;
      return Point<3>(r * std::cos(phi), r * std::sin(phi), 0.);
    };
    for (unsigned int i = 0; i < 2 * n; ++i)
      points.push_back(at(1., 0.5 * i / n)); // node 1 + i
    for (unsigned int i = 0; i < n; ++i)
      points.push_back(at(0.5, double(i) / n)); // node 1 + 2 n + i
    for (unsigned int i = 0; i < n; ++i)
      {
        const unsigned int next = (i + 1) % n, a = 1 + 2 * i, b = 1 + 2 * next;
        elements.push_back(
          {9, 1, {0, a, b, 1 + 2 * n + i, a + 1, 1 + 2 * n + next}});
        elements.push_back({8, 1, {a, b, a + 1}});
      }
    const auto                mesh = read<2>(points, elements);
    const dealii::MappingQ<2> mapping(4);
    double                    distance = 0., length = 0.;
    for (const auto &cell : mesh->active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
          {
            for (const double part : {0., 0.25, 0.5, 1.})
              distance =
                std::max(distance,
                         std::abs(face->get_manifold()
                                    .get_intermediate_point(face->vertex(0),
                                                            face->vertex(1),
                                                            part)
                                    .norm() -
                                  1.));
            length += face->measure();
          }
    check("three quadrilaterals of each", mesh->n_active_cells() == 3 * n);
    check_below("distance of the rim from the circle", distance, 1e-14);
    check_below("area - pi",
                std::abs(dealii::GridTools::volume(*mesh, mapping) -
                         dealii::numbers::PI),
                1e-7);
  }
} // namespace

void
split_cells()
{
  tetrahedra();
  wedges();
  curved();
}
