// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/rigid_modes.h>
#include <crevasse/discretisation/rigid_motions.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** More are a mesh with unmerged nodes; the matrix below is dense. */
    constexpr unsigned int largest_number_of_parts = 300;



    /** Connected parts of the mesh, by coarse cell: cells that share a face
     * move as one rigid body. */
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



    /** A dof's component and the part of the mesh that it belongs to. */
    using Kind = std::pair<unsigned int, unsigned int>;

    /** The dofs that this rank sees. Parts that touch in a vertex share its
     * dofs: these belong to the first part, and @p shared names the others. */
    template <int dim>
    std::map<types::global_dof_index, Kind>
    kinds_of_dofs(
      const Space<dim>                                           &space,
      const std::vector<unsigned int>                            &part_of_cell,
      std::set<std::pair<types::global_dof_index, unsigned int>> &shared)
    {
      const FESystem<dim>                    &fe = space.finite_element();
      std::map<types::global_dof_index, Kind> kinds;
      std::vector<types::global_dof_index>    indices(fe.n_dofs_per_cell());
      for (const auto &cell : space.dof_handler().active_cell_iterators())
        if (!cell->is_artificial())
          {
            auto coarse = typename Triangulation<dim>::cell_iterator(cell);
            while (coarse->level() > 0)
              coarse = coarse->parent();
            const unsigned int part = part_of_cell[coarse->index()];
            cell->get_dof_indices(indices);
            for (unsigned int i = 0; i < indices.size(); ++i)
              {
                const Kind kind(fe.system_to_component_index(i).first, part);
                if (kinds.emplace(indices[i], kind).first->second != kind)
                  shared.emplace(indices[i], part);
              }
          }
      return kinds;
    }



    void
    add_outer_product(FullMatrix<double>        &gram,
                      const std::vector<double> &violation)
    {
      for (unsigned int i = 0; i < violation.size(); ++i)
        if (violation[i] != 0.)
          for (unsigned int j = 0; j < violation.size(); ++j)
            gram(i, j) += violation[i] * violation[j];
    }



    /** The Gram matrix of what the rigid modes of all parts violate: support
     * constraints, and the ties between parts that share dofs. Its kernel is
     * the unconstrained motions. Mode m of part p has the index p n_modes + m.
     */
    template <int dim>
    FullMatrix<double>
    constraint_gram_matrix(const Space<dim>                &space,
                           const std::vector<unsigned int> &part_of_cell,
                           const unsigned int               n_parts,
                           const Point<dim>                &origin,
                           const double                     length)
    {
      std::map<types::global_dof_index, Point<dim>> support_points;
      DoFTools::map_dofs_to_support_points(space.mapping(),
                                           space.dof_handler(),
                                           support_points);
      std::set<std::pair<types::global_dof_index, unsigned int>> shared;
      const auto      kinds = kinds_of_dofs(space, part_of_cell, shared);
      const IndexSet &owned = space.dof_handler().locally_owned_dofs();

      constexpr unsigned int n = n_rigid_modes<dim>;
      FullMatrix<double>     gram(n_parts * n, n_parts * n);
      std::vector<double>    violation(gram.m());
      const auto             add = [&](const types::global_dof_index dof,
                           const unsigned int            part,
                           const double                  factor) {
        const Point<dim> x((support_points.at(dof) - origin) / length);
        for (unsigned int m = 0; m < n; ++m)
          violation[part * n + m] +=
            factor * rigid_mode<dim>(m, kinds.at(dof).first, x);
      };
      for (const auto &line : space.constraints().get_lines())
        if (owned.is_element(line.index))
          {
            std::fill(violation.begin(), violation.end(), 0.);
            add(line.index, kinds.at(line.index).second, 1.);
            for (const auto &[dof, weight] : line.entries)
              add(dof, kinds.at(dof).second, -weight);
            add_outer_product(gram, violation);
          }
      for (const auto &[dof, part] : shared)
        if (owned.is_element(dof))
          {
            std::fill(violation.begin(), violation.end(), 0.);
            add(dof, kinds.at(dof).second, 1.);
            add(dof, part, -1.);
            add_outer_product(gram, violation);
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



    /** Motions of the given modes alone that @p gram does not constrain. They
     * are then locked: later ones are orthogonal to them. */
    std::vector<std::vector<double>>
    find_and_lock(FullMatrix<double>              &gram,
                  const std::vector<unsigned int> &modes)
    {
      FullMatrix<double> block(modes.size(), modes.size());
      block.extract_submatrix_from(gram, modes, modes);
      std::vector<std::vector<double>> motions;
      for (const std::vector<double> &coefficients : kernel_of(block))
        {
          motions.emplace_back(gram.m(), 0.);
          for (unsigned int i = 0; i < modes.size(); ++i)
            motions.back()[modes[i]] = coefficients[i];
          add_outer_product(gram, motions.back());
        }
      return motions;
    }



    /** The kernel of the Gram matrix, sorted so that each motion has a name:
     * what one part can do alone before what parts can only do together, and
     * translations before what is orthogonal to them. */
    template <int dim>
    std::vector<std::vector<double>>
    free_motions(FullMatrix<double> &gram, const unsigned int n_parts)
    {
      std::vector<std::vector<double>> motions;
      const auto                       find = [&](const unsigned int begin,
                            const unsigned int end,
                            const unsigned int modes_per_part) {
        std::vector<unsigned int> modes;
        for (unsigned int part = begin; part < end; ++part)
          for (unsigned int m = 0; m < modes_per_part; ++m)
            modes.push_back(part * n_rigid_modes<dim> + m);
        for (std::vector<double> &motion : find_and_lock(gram, modes))
          motions.push_back(std::move(motion));
      };
      for (unsigned int part = 0; part < n_parts; ++part)
        {
          find(part, part + 1, dim);
          find(part, part + 1, n_rigid_modes<dim>);
        }
      if (n_parts > 1)
        {
          find(0, n_parts, dim);
          find(0, n_parts, n_rigid_modes<dim>);
        }
      return motions;
    }



    /** The parts that move, and how. */
    template <int dim>
    std::string
    describe(const std::vector<double> &motion,
             const unsigned int         n_parts,
             const Point<dim>          &origin,
             const double               length)
    {
      std::string text;
      for (unsigned int part = 0; part < n_parts; ++part)
        {
          std::array<double, n_rigid_modes<dim>> mode;
          std::copy_n(motion.begin() + part * n_rigid_modes<dim>,
                      n_rigid_modes<dim>,
                      mode.begin());
          if (std::all_of(mode.begin(), mode.end(), [](const double x) {
                return std::abs(x) < 1e-6;
              }))
            continue;
          text +=
            (text.empty() ? "" : ", ") + describe<dim>(mode, origin, length);
          if (n_parts > 1)
            text += " of part " + std::to_string(part + 1) + " of " +
                    std::to_string(n_parts);
        }
      return text + (n_parts > 1 ? " of the mesh (parts share no face)" : "");
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  find_free_rigid_motions(const Space<dim> &space)
  {
    const BoundingBox<dim> box(space.mesh().get_vertices());
    const Point<dim>       origin = box.center();
    const double           length = box.get_boundary_points().first.distance(
      box.get_boundary_points().second);

    unsigned int                    n_parts;
    const std::vector<unsigned int> part_of_cell =
      connected_parts(space.mesh(), n_parts);
    if (n_parts > largest_number_of_parts)
      throw SceneError(
        "[Geometry] Mesh file: the mesh falls into " + std::to_string(n_parts) +
        " parts that share no face; at most " +
        std::to_string(largest_number_of_parts) +
        " are allowed. Are the nodes of neighbouring cells merged?");
    FullMatrix<double> gram =
      constraint_gram_matrix(space, part_of_cell, n_parts, origin, length);

    std::vector<std::string> names;
    for (const auto &motion : free_motions<dim>(gram, n_parts))
      names.push_back(describe<dim>(motion, n_parts, origin, length));
    return names;
  }



  namespace
  {
    /** " Boundary ids without a role: 0, 1.", or nothing. */
    template <int dim>
    std::string
    ids_without_role(const Space<dim> &space)
    {
      const BoundaryRoles     &roles = space.roles();
      std::vector<std::string> ids;
      for (const types::boundary_id id : space.mesh().get_boundary_ids())
        if (roles.clamped.count(id) + roles.symmetry.count(id) +
              roles.loaded.count(id) + roles.contact.count(id) ==
            0)
          ids.push_back(std::to_string(id));
      return ids.empty() ? ""
                         : " Boundary ids of the mesh that have no role: " +
                             Text::join(ids, ", ") + ".";
    }
  } // namespace



  template <int dim>
  void
  require_no_rigid_motion(const Space<dim> &space)
  {
    const std::vector<std::string> names = find_free_rigid_motions(space);
    if (names.empty())
      return;

    std::string message = "Unconstrained rigid-body motions:";
    for (const std::string &name : names)
      message += "\n  " + name;
    message +=
      "\nContact holds in one direction only and does not count. Hold "
      "the body by [Boundary] Clamped, Symmetry or Fixed points, for "
      "example --set \"Boundary/Fixed points=" +
      std::string(dim == 2 ? "0, 0" : "0, 0, 0") + "\"." +
      ids_without_role(space);
    throw NumericalError(message);
  }



  template std::vector<std::string>
  find_free_rigid_motions<2>(const Space<2> &);
  template std::vector<std::string>
  find_free_rigid_motions<3>(const Space<3> &);
  template void
  require_no_rigid_motion<2>(const Space<2> &);
  template void
  require_no_rigid_motion<3>(const Space<3> &);
} // namespace Crevasse
