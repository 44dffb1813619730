// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/rigid_modes.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/function.h>
#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/numerics/vector_tools.h>

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/connected_components.hpp>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** What coordinates are scaled by, so that modes have unit size. */
    template <int dim>
    double
    size(const BoundingBox<dim> &body)
    {
      const auto &corners = body.get_boundary_points();
      return corners.first.distance(corners.second);
    }



    template <int dim>
    constexpr unsigned int n_modes = dim *(dim + 1) / 2;



    /** Component @p c at @p x of mode @p m: translations come first, then
     * rotations in the planes 12, 13, 23 about the middle of the body. */
    template <int dim>
    double
    rigid_mode(const unsigned int      m,
               const unsigned int      c,
               const Point<dim>       &x,
               const BoundingBox<dim> &body)
    {
      if (m < dim)
        return m == c ? 1. : 0.;
      const unsigned int   a      = (m - dim == 2 ? 1 : 0);
      const unsigned int   b      = (m - dim == 0 ? 1 : 2);
      const Tensor<1, dim> scaled = (x - body.center()) / size(body);
      return c == a ? -scaled[b] : (c == b ? scaled[a] : 0.);
    }
  } // namespace



  template <int dim>
  std::vector<Vector>
  rigid_modes(const Space<dim> &space)
  {
    const auto          body = GridTools::compute_bounding_box(space.mesh());
    std::vector<Vector> modes(n_modes<dim>, make_vector(space.dof_handler));
    for (unsigned int m = 0; m < modes.size(); ++m)
      {
        std::vector<std::function<double(const Point<dim> &)>> components;
        for (unsigned int c = 0; c < dim; ++c)
          components.push_back([m, c, &body](const Point<dim> &x) {
            return rigid_mode<dim>(m, c, x, body);
          });
        VectorTools::interpolate(space.mapping,
                                 space.dof_handler,
                                 FunctionFromFunctionObjects<dim>(components),
                                 modes[m]);
        if (space.lip.n_unknowns > 0)
          modes[m] = space.from_nodal_values(modes[m]);
      }
    return modes;
  }



  namespace
  {
    /** Connected parts of the mesh, by coarse cell: cells that share a face
     * move as one rigid body. */
    template <int dim>
    std::vector<unsigned int>
    connected_parts(const Triangulation<dim> &mesh)
    {
      boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>
        neighbors(mesh.n_cells(0));
      for (const auto &cell : mesh.cell_iterators_on_level(0))
        for (const unsigned int f : cell->face_indices())
          if (!cell->at_boundary(f))
            boost::add_edge(cell->index(),
                            cell->neighbor(f)->index(),
                            neighbors);
      std::vector<unsigned int> part(mesh.n_cells(0));
      boost::connected_components(neighbors, part.data());
      return part;
    }



    /** The names of the entries from @p begin to @p end that are not 0. */
    std::string
    nonzero(const std::vector<double>       &entries,
            const unsigned int               begin,
            const unsigned int               end,
            const std::vector<const char *> &names)
    {
      std::string text;
      for (unsigned int i = begin; i < end; ++i)
        if (std::abs(entries[i]) > 1e-6)
          text += std::string(" ") + names[i - begin];
      return text;
    }



    /** A motion of one part; empty if it rests. */
    template <int dim>
    std::string
    describe(const std::vector<double> &mode, const BoundingBox<dim> &body)
    {
      const std::string axes = nonzero(mode, 0, dim, {"x1", "x2", "x3"});
      const std::string planes =
        nonzero(mode, dim, n_modes<dim>, {"x1-x2", "x1-x3", "x2-x3"});
      if (planes.empty())
        return axes.empty() ? axes : "translation along" + axes;
      if (dim == 3)
        return "rotation in the plane" + planes;
      // u = t + w (−y, x) = 0 at the centre of rotation.
      const double length  = size(body);
      const auto   rounded = [&](const double x) {
        return std::abs(x) < 1e-10 * length ? 0. : x;
      };
      std::ostringstream text;
      text << "rotation in the plane" << planes << " about ("
           << rounded(body.center()[0] - length * mode[1] / mode[2]) << ", "
           << rounded(body.center()[1] + length * mode[0] / mode[2]) << ')';
      return text.str();
    }



    /** The parts that move, and how. */
    template <int dim>
    std::string
    describe_all(const std::vector<double> &motion,
                 const BoundingBox<dim>    &body)
    {
      const std::size_t        n_parts = motion.size() / n_modes<dim>;
      std::vector<std::string> parts;
      for (std::size_t part = 0; part < n_parts; ++part)
        {
          const auto        begin = motion.begin() + part * n_modes<dim>;
          const std::string text =
            describe<dim>({begin, begin + n_modes<dim>}, body);
          if (text.empty())
            continue;
          parts.push_back(text);
          if (n_parts > 1)
            parts.back() += " of part " + std::to_string(part + 1) + " of " +
                            std::to_string(n_parts);
        }
      return Text::join(parts, ", ") +
             (n_parts > 1 ? " of the mesh (parts share no face)" : "");
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



    /** The component of each dof that this rank sees, and the parts of the mesh
     * that share it. */
    using Memberships =
      std::map<types::global_dof_index,
               std::pair<unsigned int, std::set<unsigned int>>>;

    template <int dim>
    Memberships
    memberships(const Space<dim>                &space,
                const std::vector<unsigned int> &part_of_cell)
    {
      const FESystem<dim>                 &fe = space.finite_element;
      Memberships                          all;
      std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
      for (const auto &cell : space.dof_handler.active_cell_iterators())
        if (!cell->is_artificial())
          {
            auto coarse = typename Triangulation<dim>::cell_iterator(cell);
            while (coarse->level() > 0)
              coarse = coarse->parent();
            cell->get_dof_indices(indices);
            for (unsigned int i = 0; i < indices.size(); ++i)
              {
                auto &[component, parts] = all[indices[i]];
                component = fe.system_to_component_index(i).first;
                parts.insert(part_of_cell[coarse->index()]);
              }
          }
      return all;
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
                           const BoundingBox<dim>          &body)
    {
      std::map<types::global_dof_index, Point<dim>> support_points;
      DoFTools::map_dofs_to_support_points(space.mapping,
                                           space.dof_handler,
                                           support_points);
      const auto      dofs  = memberships(space, part_of_cell);
      const IndexSet &owned = space.dof_handler.locally_owned_dofs();

      FullMatrix<double>  gram(n_parts * n_modes<dim>);
      std::vector<double> violation;
      const auto          add = [&](const types::global_dof_index dof,
                           const unsigned int            part,
                           const double                  factor) {
        for (unsigned int m = 0; m < n_modes<dim>; ++m)
          violation[part * n_modes<dim> + m] +=
            factor * rigid_mode<dim>(m,
                                     dofs.at(dof).first,
                                     support_points.at(dof),
                                     body);
      };
      const auto first_part = [&](const types::global_dof_index dof) {
        return *dofs.at(dof).second.begin();
      };
      for (const auto &line : space.supports_and_hanging.get_lines())
        if (owned.is_element(line.index))
          {
            violation.assign(gram.m(), 0.);
            add(line.index, first_part(line.index), 1.);
            for (const auto &[dof, weight] : line.entries)
              add(dof, first_part(dof), -weight);
            add_outer_product(gram, violation);
          }
      for (const auto &[dof, membership] : dofs)
        if (owned.is_element(dof) && membership.second.size() > 1)
          for (const unsigned int part : membership.second)
            {
              violation.assign(gram.m(), 0.);
              add(dof, first_part(dof), 1.);
              add(dof, part, -1.);
              add_outer_product(gram, violation);
            }
      Utilities::MPI::sum(gram, space.communicator(), gram);
      return gram;
    }



    /** Motions of the first @p modes_per_part modes of some parts that @p gram
     * does not constrain. They are then locked: later ones are orthogonal to
     * them. */
    template <int dim>
    std::vector<std::vector<double>>
    find_and_lock(FullMatrix<double> &gram,
                  const unsigned int  begin,
                  const unsigned int  end,
                  const unsigned int  modes_per_part)
    {
      std::vector<unsigned int> modes;
      for (unsigned int part = begin; part < end; ++part)
        for (unsigned int m = 0; m < modes_per_part; ++m)
          modes.push_back(part * n_modes<dim> + m);
      FullMatrix<double> block(modes.size()), eigenvectors;
      block.extract_submatrix_from(gram, modes, modes);
      LAPACKFullMatrix<double> matrix(modes.size());
      matrix = block;
      dealii::Vector<double> eigenvalues;
      // The modes are scaled to unit size.
      matrix.compute_eigenvalues_symmetric(
        -1., 1e-12, 0., eigenvalues, eigenvectors);

      std::vector<std::vector<double>> motions;
      for (unsigned int k = 0; k < eigenvalues.size(); ++k)
        {
          motions.emplace_back(gram.m(), 0.);
          for (unsigned int i = 0; i < modes.size(); ++i)
            motions.back()[modes[i]] = eigenvectors(i, k);
          add_outer_product(gram, motions.back());
        }
      return motions;
    }



    /** " Boundary ids without a role: 0, 1.", or nothing. */
    template <int dim>
    std::string
    ids_without_role(const Space<dim> &space)
    {
      const BoundaryRoles     &roles = space.roles;
      std::vector<std::string> ids;
      for (const types::boundary_id id : space.mesh().get_boundary_ids())
        if (roles.clamped.count(id) + roles.symmetry.count(id) +
                roles.loaded.count(id) ==
              0 &&
            !roles.is_lip(id))
          ids.push_back(std::to_string(id));
      return ids.empty() ? ""
                         : " Boundary ids of the mesh that have no role: " +
                             Text::join(ids, ", ") + ".";
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  find_free_rigid_motions(const Space<dim> &space)
  {
    const std::vector<unsigned int> parts = connected_parts(space.mesh());
    const unsigned int              n_parts =
      1 + *std::max_element(parts.begin(), parts.end());
    // More are a mesh with unmerged nodes; the Gram matrix is dense.
    if (n_parts > 300)
      throw SceneError(
        "[Geometry] Mesh file: the mesh falls into " + std::to_string(n_parts) +
        " parts that share no face; at most 300 are allowed. Are the nodes of "
        "neighbouring cells merged?");

    // So that each motion has a name: parts alone before parts together, and
    // translations before what is orthogonal to them.
    const auto         body = GridTools::compute_bounding_box(space.mesh());
    FullMatrix<double> gram =
      constraint_gram_matrix(space, parts, n_parts, body);
    std::vector<std::string> names;
    const auto name = [&](const unsigned int begin, const unsigned int end) {
      for (const unsigned int modes_per_part : {unsigned(dim), n_modes<dim>})
        for (const auto &motion :
             find_and_lock<dim>(gram, begin, end, modes_per_part))
          names.push_back(describe_all<dim>(motion, body));
    };
    for (unsigned int part = 0; part < n_parts; ++part)
      name(part, part + 1);
    if (n_parts > 1)
      name(0, n_parts);
    return names;
  }



  template <int dim>
  void
  require_no_rigid_motion(const Space<dim> &space)
  {
    const std::vector<std::string> names = find_free_rigid_motions(space);
    if (!names.empty())
      throw NumericalError(
        "Unconstrained rigid-body motions:\n  " + Text::join(names, "\n  ") +
        "\nContact holds in one direction only and does not count. Hold "
        "the body by [Boundary] Clamped, Symmetry or Fixed points, for "
        "example --set \"Boundary/Fixed points=" +
        (dim == 2 ? "0, 0" : "0, 0, 0") + "\"." + ids_without_role(space));
  }



#define INSTANTIATE(dim)                                                  \
  template std::vector<Vector>      rigid_modes<dim>(const Space<dim> &); \
  template std::vector<std::string> find_free_rigid_motions<dim>(         \
    const Space<dim> &);                                                  \
  template void require_no_rigid_motion<dim>(const Space<dim> &)

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
