// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/rigid_modes.h>
#include <crevasse/discretisation/rigid_motions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Names of the non-zero entries from @p begin to @p end. */
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



    /** Description of the motion of one part; empty if it rests. */
    template <int dim>
    std::string
    describe(const std::vector<double> &mode, const RigidParts<dim> &parts)
    {
      const std::string axes = nonzero(mode, 0, dim, {"x1", "x2", "x3"});
      const std::string planes =
        nonzero(mode, dim, mode.size(), {"x1-x2", "x1-x3", "x2-x3"});
      if (planes.empty())
        return axes.empty() ? axes : "translation along" + axes;
      if (dim == 3)
        return "rotation in the plane" + planes;
      // Centre of rotation: u = t + w (−y, x) = 0.
      const double     length  = parts.size();
      const Point<dim> middle  = parts.body.center();
      const auto       rounded = [&](const double x) {
        return std::abs(x) < 1e-10 * length ? 0. : x;
      };
      return Text::Message()
             << "rotation in the plane" << planes << " about ("
             << rounded(middle[0] - length * mode[1] / mode[2]) << ", "
             << rounded(middle[1] + length * mode[0] / mode[2]) << ')';
    }



    /** Description of the moving parts and their motions. */
    template <int dim>
    std::string
    describe_all(const std::vector<double> &motion,
                 const RigidParts<dim>     &parts)
    {
      std::vector<std::string> moving;
      for (unsigned int part = 0; part < parts.n_parts; ++part)
        {
          const auto        begin = motion.begin() + part * parts.n_modes;
          const std::string text =
            describe<dim>({begin, begin + parts.n_modes}, parts);
          if (text.empty())
            continue;
          moving.push_back(text);
          if (parts.n_parts > 1)
            moving.back() += " of part " + std::to_string(part + 1) + " of " +
                             std::to_string(parts.n_parts);
        }
      return Text::join(moving, ", ") +
             (parts.n_parts > 1 ? " of the mesh (parts share no face)" : "");
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



    /** Component of each dof that this rank sees, and the parts of the mesh
     * that share the dof. */
    using Memberships =
      std::map<types::global_dof_index,
               std::pair<unsigned int, std::set<unsigned int>>>;

    template <int dim>
    Memberships
    memberships(const Space<dim> &space, const RigidParts<dim> &parts)
    {
      const FESystem<dim>                 &fe = space.finite_element;
      Memberships                          all;
      std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
      for (const auto &cell : space.dof_handler.active_cell_iterators())
        if (!cell->is_artificial())
          {
            const unsigned int part = parts.part(cell);
            cell->get_dof_indices(indices);
            for (unsigned int i = 0; i < indices.size(); ++i)
              {
                auto &[component, parts_there] = all[indices[i]];
                component = fe.system_to_component_index(i).first;
                parts_there.insert(part);
              }
          }
      return all;
    }



    /** Gram matrix of the constraints that the rigid modes of all parts
     * violate: supports, and ties between parts that share dofs. Its kernel
     * consists of the unconstrained motions. */
    template <int dim>
    FullMatrix<double>
    constraint_gram_matrix(const Space<dim>      &space,
                           const RigidParts<dim> &parts)
    {
      constexpr unsigned int n_modes = RigidParts<dim>::n_modes;
      std::map<types::global_dof_index, Point<dim>> support_points;
      DoFTools::map_dofs_to_support_points(space.mapping,
                                           space.dof_handler,
                                           support_points);
      const auto      dofs  = memberships(space, parts);
      const IndexSet &owned = space.dof_handler.locally_owned_dofs();

      FullMatrix<double>  gram(parts.n_parts * n_modes);
      std::vector<double> violation;
      const auto          add = [&](const types::global_dof_index dof,
                           const unsigned int            part,
                           const double                  factor) {
        for (unsigned int m = 0; m < n_modes; ++m)
          violation[part * n_modes + m] +=
            factor * parts.mode(m, dofs.at(dof).first, support_points.at(dof));
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
      // Rings are strained by all motions except along the axis.
      for (unsigned int i = 0; space.roles.has_axis && i < gram.m(); ++i)
        if (i % n_modes != 1)
          gram(i, i) += 1.;
      return gram;
    }



    /** Gram matrix of the mean square of the openings of all nodes of the lips,
     * or of some: a motion in its kernel slides along the lips. */
    template <int dim>
    FullMatrix<double>
    opening_gram_matrix(const Space<dim>        &space,
                        const RigidParts<dim>   &parts,
                        const std::vector<bool> &some = {})
    {
      const auto        &nodes = space.lip.nodes;
      FullMatrix<double> gram(parts.n_parts * parts.n_modes);
      if (nodes.empty())
        return gram;
      FullMatrix<double> openings(nodes.size(), gram.m());
      for (unsigned int m = 0; m < gram.m(); ++m)
        {
          std::vector<double> mode(gram.m());
          mode[m] = 1.;
          const Vector u =
            space.from_nodal_values(parts.displacement(space, mode));
          for (unsigned int i = 0; i < nodes.size(); ++i)
            if ((some.empty() || some[i]) && nodes[i].has_unknown() &&
                u.in_local_range(nodes[i].unknown))
              openings(i, m) = u(nodes[i].unknown);
        }
      openings.Tmmult(gram, openings);
      gram /= nodes.size();
      Utilities::MPI::sum(gram, space.communicator(), gram);
      return gram;
    }



    /** Finds motions of these modes that @p gram does not constrain, and then
     * locks them: later motions are orthogonal to them. */
    std::vector<std::vector<double>>
    find_and_lock(FullMatrix<double>              &gram,
                  const std::vector<unsigned int> &modes)
    {
      FullMatrix<double> block(modes.size()), eigenvectors;
      block.extract_submatrix_from(gram, modes, modes);
      LAPACKFullMatrix<double> matrix(modes.size());
      matrix = block;
      dealii::Vector<double> eigenvalues;
      // Modes are scaled to unit size, which the tolerance assumes.
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



    /** Basis of the kernel of a Gram matrix. For simple names, single parts
     * come before several parts together, and translations before motions
     * orthogonal to them. */
    template <int dim>
    std::vector<std::vector<double>>
    kernel(FullMatrix<double> gram, const RigidParts<dim> &parts)
    {
      std::vector<std::vector<double>> all;
      const auto add = [&](const unsigned int begin, const unsigned int end) {
        for (const unsigned int n_modes : {unsigned(dim), parts.n_modes})
          {
            std::vector<unsigned int> modes;
            for (unsigned int part = begin; part < end; ++part)
              for (unsigned int m = 0; m < n_modes; ++m)
                modes.push_back(part * parts.n_modes + m);
            for (const auto &motion : find_and_lock(gram, modes))
              all.push_back(motion);
          }
      };
      for (unsigned int part = 0; part < parts.n_parts; ++part)
        add(part, part + 1);
      if (parts.n_parts > 1)
        add(0, parts.n_parts);
      return all;
    }



    template <int dim>
    RigidParts<dim>
    parts_of(const Space<dim> &space)
    {
      const RigidParts<dim> parts(space.mesh());
      // More parts mean a mesh with unmerged nodes; the Gram matrix is dense.
      if (parts.n_parts > 300)
        throw SceneError("[Geometry] Mesh file: the mesh falls into " +
                         std::to_string(parts.n_parts) +
                         " parts that share no face; at most 300 are allowed. "
                         "Merge the nodes of neighbouring cells.");
      return parts;
    }



    template <int dim>
    std::vector<std::string>
    names_of(const std::vector<std::vector<double>> &motions,
             const RigidParts<dim>                  &parts)
    {
      std::vector<std::string> names;
      for (const auto &motion : motions)
        names.push_back(describe_all<dim>(motion, parts));
      return names;
    }



    /** Text " Boundary ids without a role: 0, 1.", or empty. */
    template <int dim>
    std::string
    ids_without_role(const Space<dim> &space)
    {
      const BoundaryRoles     &roles = space.roles;
      std::vector<std::string> ids;
      for (const types::boundary_id id : space.mesh().get_boundary_ids())
        if (!roles.is_lip(id) &&
            !(roles.clamped.count(id) || roles.displaced.count(id) ||
              roles.symmetry.count(id) || roles.loaded.count(id)))
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
    const RigidParts<dim> parts = parts_of(space);
    return names_of(kernel(constraint_gram_matrix(space, parts), parts), parts);
  }



  template <int dim>
  std::vector<RigidMotion>
  rigid_motions_held_by_contact(const Space<dim> &space)
  {
    const RigidParts<dim> parts = parts_of(space);
    FullMatrix<double>    gram  = constraint_gram_matrix(space, parts);
    const auto            free  = kernel(gram, parts);
    if (free.empty())
      return {};
    // Of the size of a motion; find_and_lock() takes a millionth.
    constexpr double steep = 1e-3;
    gram.add(steep * steep, opening_gram_matrix(space, parts));
    if (const auto sliding = kernel(gram, parts); !sliding.empty())
      throw NumericalError(
        "Unconstrained rigid-body motions:\n  " +
        Text::join(names_of(sliding, parts), "\n  ") +
        (space.roles.contact.empty() && space.roles.crack.empty()
           ? "\n"
           : "\nContact does not stop them: they open or close a lip by less "
             "than a thousandth of their size. ") +
        "Hold each part that moves by [Boundary] "
        "Clamped, Symmetry or Fixed points (vertices of the mesh): " +
        (dim == 2 ? "\"x, y; X, y: 2\""
                  : "\"x, y, z; X, y, z: 2, 3; x, Y, z: 3\"") +
        " stop all motions of a free part." + ids_without_role(space));
    std::vector<RigidMotion> motions;
    for (const auto &motion : free)
      motions.push_back(
        {describe_all(motion, parts),
         space.from_nodal_values(parts.displacement(space, motion))});
    return motions;
  }



  template <int dim>
  void
  require_held(const Space<dim> &space, const std::vector<bool> &pressed)
  {
    const RigidParts<dim> parts = parts_of(space);
    FullMatrix<double>    gram  = constraint_gram_matrix(space, parts);
    gram.add(1., opening_gram_matrix(space, parts, pressed));
    if (const auto free = kernel(gram, parts); !free.empty())
      throw NumericalError(
        "Unconstrained rigid-body motions:\n  " +
        Text::join(names_of(free, parts), "\n  ") +
        "\nContact could stop them, but no load presses a lip that does: the "
        "position is undetermined. Hold the body by [Boundary] Clamped, "
        "Symmetry or Fixed points, or press it on its lips.");
  }



  std::string
  what_contact_holds(const std::vector<RigidMotion> &motions)
  {
    return "contact alone holds the body against " + motions.front().name;
  }



  template decltype(find_free_rigid_motions<2>) find_free_rigid_motions<2>;
  template decltype(find_free_rigid_motions<3>) find_free_rigid_motions<3>;
  template decltype(rigid_motions_held_by_contact<2>)
    rigid_motions_held_by_contact<2>;
  template decltype(rigid_motions_held_by_contact<3>)
                                     rigid_motions_held_by_contact<3>;
  template decltype(require_held<2>) require_held<2>;
  template decltype(require_held<3>) require_held<3>;
} // namespace Crevasse
