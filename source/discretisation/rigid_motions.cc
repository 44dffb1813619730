// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/discretisation/rigid_modes.h>
#include <crevasse/discretisation/rigid_motions.h>
#include <crevasse/scene/problems.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Connected parts of the mesh, by coarse cell: cells that share a face
     * hold each other. */
    template <int dim>
    std::vector<unsigned int>
    connected_parts(const Triangulation<dim> &mesh, unsigned int &n_parts)
    {
      std::vector<unsigned int> part(mesh.n_cells(0),
                                     numbers::invalid_unsigned_int);
      n_parts = 0;
      for (const auto &seed : mesh.cell_iterators_on_level(0))
        {
          if (part[seed->index()] != numbers::invalid_unsigned_int)
            continue;
          std::vector<typename Triangulation<dim>::cell_iterator> front = {
            seed};
          part[seed->index()] = n_parts;
          while (!front.empty())
            {
              const auto cell = front.back();
              front.pop_back();
              for (const unsigned int f : cell->face_indices())
                if (!cell->at_boundary(f) && part[cell->neighbor(f)->index()] ==
                                               numbers::invalid_unsigned_int)
                  {
                    part[cell->neighbor(f)->index()] = n_parts;
                    front.push_back(cell->neighbor(f));
                  }
            }
          ++n_parts;
        }
      return part;
    }



    template <int dim>
    std::string
    describe(const std::array<double, n_rigid_modes<dim>> &mode,
             const Point<dim>                             &origin,
             const double                                  length)
    {
      constexpr const char *planes[] = {"x1-x2", "x1-x3", "x2-x3"};
      std::ostringstream    text;
      double                rotation = 0.;
      for (unsigned int m = dim; m < n_rigid_modes<dim>; ++m)
        rotation = std::max(rotation, std::abs(mode[m]));

      if (rotation < 1e-6)
        {
          text << "translation along";
          for (unsigned int d = 0; d < dim; ++d)
            if (std::abs(mode[d]) > 1e-6)
              text << " x" << d + 1;
          return text.str();
        }
      text << "rotation in the plane";
      for (unsigned int m = dim; m < n_rigid_modes<dim>; ++m)
        if (std::abs(mode[m]) > 1e-6)
          text << ' ' << planes[m - dim];
      if (dim == 2)
        {
          // u = t + w (−y, x) = 0 at the centre of rotation.
          const auto rounded = [&](const double x) {
            return std::abs(x) < 1e-10 * length ? 0. : x;
          };
          text << " about (" << rounded(origin[0] - length * mode[1] / mode[2])
               << ", " << rounded(origin[1] + length * mode[0] / mode[2])
               << ')';
        }
      return text.str();
    }



    /** For each part, the Gram matrix of the rigid modes' violations of the
     * support constraints; its kernel is what the supports leave free. */
    template <int dim>
    std::vector<double>
    constraint_gram_matrices(const Space<dim>                &space,
                             const std::vector<unsigned int> &part_of_cell,
                             const unsigned int               n_parts,
                             const Point<dim>                &origin,
                             const double                     length)
    {
      const FESystem<dim>                          &fe = space.finite_element();
      std::map<types::global_dof_index, Point<dim>> support_points;
      DoFTools::map_dofs_to_support_points(space.mapping(),
                                           space.dof_handler(),
                                           support_points);

      // component and part of each dof that this rank sees
      std::map<types::global_dof_index, std::pair<unsigned int, unsigned int>>
                                           kind;
      std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
      for (const auto &cell : space.dof_handler().active_cell_iterators())
        if (!cell->is_artificial())
          {
            auto coarse = typename Triangulation<dim>::cell_iterator(cell);
            while (coarse->level() > 0)
              coarse = coarse->parent();
            cell->get_dof_indices(indices);
            for (unsigned int i = 0; i < indices.size(); ++i)
              kind[indices[i]] = {fe.system_to_component_index(i).first,
                                  part_of_cell[coarse->index()]};
          }

      constexpr unsigned int n = n_rigid_modes<dim>;
      std::vector<double>    gram(n_parts * n * n, 0.);
      const auto             mode_at = [&](const types::global_dof_index dof,
                               const unsigned int            m) {
        const Point<dim> x((support_points.at(dof) - origin) / length);
        return rigid_mode<dim>(m, kind.at(dof).first, x);
      };
      for (const auto &line : space.constraints().get_lines())
        {
          if (!space.dof_handler().locally_owned_dofs().is_element(line.index))
            continue;
          std::array<double, n> violation;
          for (unsigned int m = 0; m < n; ++m)
            {
              violation[m] = mode_at(line.index, m);
              for (const auto &[dof, weight] : line.entries)
                violation[m] -= weight * mode_at(dof, m);
            }
          double *block = &gram[kind.at(line.index).second * n * n];
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              block[i * n + j] += violation[i] * violation[j];
        }
      Utilities::MPI::sum(gram, space.communicator(), gram);
      return gram;
    }



    std::vector<std::vector<double>>
    kernel_of(const FullMatrix<double> &symmetric_matrix)
    {
      const unsigned int       n = symmetric_matrix.m();
      LAPACKFullMatrix<double> matrix(n);
      matrix = symmetric_matrix;
      dealii::Vector<double> eigenvalues;
      FullMatrix<double>     eigenvectors;
      const double           everything = std::numeric_limits<double>::max();
      matrix.compute_eigenvalues_symmetric(
        -everything, everything, 0., eigenvalues, eigenvectors);

      std::vector<std::vector<double>> kernel;
      for (unsigned int k = 0; k < n; ++k)
        if (eigenvalues[k] <= 1e-12) // the modes are scaled to unit size
          {
            kernel.emplace_back(n);
            for (unsigned int i = 0; i < n; ++i)
              kernel.back()[i] = eigenvectors(i, k);
          }
      return kernel;
    }



    /** The kernel of a Gram matrix, sorted into pure translations and what is
     * orthogonal to them, so that each mode has a name. */
    template <int dim>
    std::vector<std::array<double, n_rigid_modes<dim>>>
    free_modes(FullMatrix<double> gram)
    {
      std::vector<std::array<double, n_rigid_modes<dim>>> modes;

      FullMatrix<double> translations(dim, dim);
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          translations(i, j) = gram(i, j);
      for (const std::vector<double> &direction : kernel_of(translations))
        {
          modes.emplace_back();
          modes.back().fill(0.);
          for (unsigned int i = 0; i < dim; ++i)
            {
              modes.back()[i] = direction[i];
              for (unsigned int j = 0; j < dim; ++j)
                gram(i, j) += direction[i] * direction[j];
            }
        }
      for (const std::vector<double> &motion : kernel_of(gram))
        {
          modes.emplace_back();
          std::copy(motion.begin(), motion.end(), modes.back().begin());
        }
      return modes;
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  find_free_rigid_motions(const Space<dim> &space)
  {
    constexpr unsigned int n = n_rigid_modes<dim>;

    const BoundingBox<dim> box(space.mesh().get_vertices());
    const Point<dim>       origin = box.center();
    const double           length = box.get_boundary_points().first.distance(
      box.get_boundary_points().second);

    unsigned int                    n_parts;
    const std::vector<unsigned int> part_of_cell =
      connected_parts(space.mesh(), n_parts);
    const std::vector<double> gram =
      constraint_gram_matrices(space, part_of_cell, n_parts, origin, length);

    std::vector<std::string> names;
    for (unsigned int part = 0; part < n_parts; ++part)
      {
        FullMatrix<double> matrix(n, n);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            matrix(i, j) = gram[part * n * n + i * n + j];
        for (const auto &mode : free_modes<dim>(matrix))
          {
            names.push_back(describe<dim>(mode, origin, length));
            if (n_parts > 1)
              names.back() += " of part " + std::to_string(part + 1) + " of " +
                              std::to_string(n_parts) +
                              " of the mesh (parts share no face)";
          }
      }
    return names;
  }



  template <int dim>
  void
  require_no_rigid_motion(const Space<dim> &space)
  {
    const std::vector<std::string> names = find_free_rigid_motions(space);
    if (names.empty())
      return;

    std::string message =
      "The supports leave the body free to move as a rigid one:";
    for (const std::string &name : names)
      message += "\n  " + name;
    message +=
      "\nContact holds in one direction only and does not count. Hold "
      "the body by [Boundary] Clamped, Symmetry or Fixed points, for "
      "example --set \"Boundary/Fixed points=0, 0\".";
    throw NumericalError(message);
  }



  template std::vector<std::string>
  find_free_rigid_motions<2>(const Space<2> &);
  template void
  require_no_rigid_motion<2>(const Space<2> &);
} // namespace Crevasse
