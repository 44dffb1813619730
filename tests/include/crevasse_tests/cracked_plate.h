// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_tests_cracked_plate_h
#define crevasse_tests_cracked_plate_h

#include <crevasse/discretisation/stiffness.h>
#include <crevasse/material/voigt_matrix.h>

#include <crevasse_tests/contact_body.h>
#include <memory>
#include <vector>

enum class LipShape
{
  straight,
  shallow, ///< parallel to a near side
  wavy,
  kinked,
  bimaterial ///< straight, between two materials
};

/** A plate |x|, |y| < 5 of modulus 1, clamped below and loaded above, with a
 * crack of length 2 in its middle whose lips bear friction: in plane strain,
 * with equal cells along the crack and growing ones beyond. */
class CrackedPlate : public ContactBody<2>
{
public:
  /** @param n_cells even number of cells along the crack. */
  CrackedPlate(const LipShape shape, const unsigned int n_cells)
    : ContactBody<2>(mesh(shape, n_cells),
                     1,
                     roles(),
                     {},
                     Crevasse::VolumetricStrain::full,
                     "0; 1")
  {
    using Matrix        = Crevasse::VoigtMatrix<2>;
    const Matrix strong = Crevasse::isotropic_stiffness<2>(1., 0.3, false);
    std::vector<std::uint32_t> which(points.n_local_points);
    for (const auto &cell : space.mesh().active_cell_iterators())
      {
        const auto begin = which.begin() + points.offset(cell) /
                                             Crevasse::n_stress_components<2>;
        std::fill(begin,
                  begin + space.quadrature(cell).size(),
                  shape == LipShape::bimaterial && cell->center()[1] < 0.);
      }
    Crevasse::assemble_stiffness(
      space,
      points,
      Crevasse::PointValues<Matrix>({strong, 0.02 * strong}, std::move(which)),
      matrix);
  }

  Crevasse::SparseMatrix matrix;

private:
  static constexpr double half = 5.;

  static double
  height(const LipShape shape, const double x)
  {
    switch (shape)
      {
        case LipShape::shallow:
          return 4.;
        case LipShape::wavy:
          return 0.1 * std::sin(3. * dealii::numbers::PI * x);
        case LipShape::kinked:
          return 0.4 * std::max(x, 0.);
        default:
          return 0.;
      }
  }

  static Crevasse::BoundaryRoles
  roles()
  {
    Crevasse::BoundaryRoles roles;
    roles.clamped      = {2};
    roles.loaded       = {3};
    roles.crack        = {1};
    roles.has_friction = true;
    return roles;
  }

  /** Lines from 0 to the side: @p n equal cells to 1 first, then growing ones.
   */
  static std::vector<double>
  lines(const unsigned int n, const double size)
  {
    std::vector<double> at = {0.};
    for (unsigned int i = 1; i <= n; ++i)
      at.push_back(i / double(n));
    for (double h = size; at.back() < half; h *= 1.4)
      at.push_back(at.back() + 1.6 * h < half ? at.back() + h : half);
    std::vector<double> both;
    for (unsigned int i = at.size() - 1; i > 0; --i)
      both.push_back(-at[i]);
    both.insert(both.end(), at.begin(), at.end());
    return both;
  }

  static std::shared_ptr<const Crevasse::Mesh<2>>
  mesh(const LipShape shape, const unsigned int n_cells)
  {
    const unsigned int        n = n_cells / 2;
    const std::vector<double> X = lines(n, 1. / n), Y = lines(0, 1. / n);
    const unsigned int        nx = X.size(), ny = Y.size(), middle = ny / 2;
    const auto                on_lip = [&](const unsigned int i) {
      return std::abs(X[i]) < 1. - 1e-10;
    };
    std::vector<dealii::Point<2>> vertices;
    std::vector<unsigned int>     upper(nx); // copies above the crack
    for (unsigned int j = 0; j < ny; ++j)
      for (unsigned int i = 0; i < nx; ++i)
        vertices.push_back(place(shape, X[i], Y[j]));
    for (unsigned int i = 0; i < nx; ++i)
      {
        upper[i] = on_lip(i) ? vertices.size() : middle * nx + i;
        if (on_lip(i))
          vertices.push_back(vertices[middle * nx + i]);
      }
    std::vector<dealii::CellData<2>> cells;
    dealii::SubCellData              sides;
    const auto                       add_side =
      [&](const unsigned int a, const unsigned int b, const unsigned int id) {
        sides.boundary_lines.emplace_back();
        sides.boundary_lines.back().vertices    = {a, b};
        sides.boundary_lines.back().boundary_id = id;
      };
    const auto vertex =
      [&](const unsigned int i, const unsigned int j, const bool is_above) {
        return j == middle && is_above ? upper[i] : j * nx + i;
      };
    for (unsigned int j = 0; j + 1 < ny; ++j)
      for (unsigned int i = 0; i + 1 < nx; ++i)
        {
          const bool is_above = j >= middle;
          cells.emplace_back();
          cells.back().vertices = {vertex(i, j, is_above),
                                   vertex(i + 1, j, is_above),
                                   vertex(i, j + 1, is_above),
                                   vertex(i + 1, j + 1, is_above)};
        }
    for (unsigned int i = 0; i + 1 < nx; ++i)
      {
        add_side(i, i + 1, 2);
        add_side((ny - 1) * nx + i, (ny - 1) * nx + i + 1, 3);
        if (std::abs(X[i] + X[i + 1]) < 2.)
          {
            add_side(middle * nx + i, middle * nx + i + 1, 1);
            add_side(upper[i], upper[i + 1], 1);
          }
      }
    auto mesh = std::make_shared<Crevasse::Mesh<2>>(MPI_COMM_WORLD);
    mesh->create_triangulation(vertices, cells, sides);
    return mesh;
  }

  /** A node of the grid, moved so that y = 0 is the line of the crack. */
  static dealii::Point<2>
  place(const LipShape shape, const double x, const double y)
  {
    const double shift = height(shape, std::max(-1., std::min(1., x)));
    return {x, y + shift * (1. - std::abs(y) / half)};
  }
};

#endif
