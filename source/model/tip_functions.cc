// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/model/tip_functions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** The size of the smallest cell at the tip, over all ranks. */
    double
    cell_size_at(const CrackTip &tip, const Mesh<2> &mesh)
    {
      double size = std::numeric_limits<double>::max();
      for (const auto &cell : mesh.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int v : cell->vertex_indices())
            if (cell->vertex(v).distance(tip.position) <
                1e-8 * cell->diameter())
              size = std::min(size, cell->minimum_vertex_distance());
      return Utilities::MPI::min(size, mesh.get_communicator());
    }
  } // namespace



  PlaneElasticity
  elasticity_at(const CrackTip         &tip,
                const Triangulation<2> &mesh,
                const MaxwellLaw<2>    &law,
                const Temperature<2>   &temperature,
                const double            t,
                const std::string      &wanted_by)
  {
    const std::string where = wanted_by + ": the stiffness at the crack tip " +
                              Text::from_point(tip.position);
    std::optional<VoigtMatrix<2>> stiffness;
    for (const auto &cell : mesh.cell_iterators_on_level(0))
      for (const unsigned int v : cell->vertex_indices())
        {
          if (cell->vertex(v).distance(tip.position) > 1e-8 * cell->diameter())
            continue;
          const VoigtMatrix<2> here =
            law.stiffness().at(Place<2>{tip.position,
                                        t,
                                        temperature.value(tip.position, t),
                                        cell->material_id()});
          if (stiffness && (here - *stiffness).norm() > 1e-8 * here.norm())
            throw SceneError(where +
                             " is not the same on all sides of it: the fields "
                             "of a crack between two materials are others.");
          stiffness = here;
        }
    AssertThrow(stiffness, ExcInternalError());
    if (!PlaneElasticity::is_isotropic(*stiffness))
      throw SceneError(where +
                       " is not isotropic, but the fields around a tip "
                       "are known to this program for isotropic "
                       "bodies only.");
    return PlaneElasticity(*stiffness);
  }



  template <int dim>
  SingularFunctions
  tip_functions(const Scene            &scene,
                const Mesh<dim>        &mesh,
                const BoundaryRoles    &roles,
                const MaxwellLaw<dim>  &law,
                const Temperature<dim> &temperature)
  {
    const unsigned int n = scene.discretisation.singular_functions;
    if constexpr (dim == 2)
      if (n > 0)
        {
          const std::string wanted_by =
            "[Discretisation] Singular functions = " + std::to_string(n);
          const CrackTip tip = only_crack_tip(mesh, roles, wanted_by);
          return make_singular_functions(
            n,
            tip,
            elasticity_at(tip, mesh, law, temperature, 0., wanted_by),
            cell_size_at(tip, mesh));
        }
    return {};
  }



  template SingularFunctions
  tip_functions<2>(const Scene &,
                   const Mesh<2> &,
                   const BoundaryRoles &,
                   const MaxwellLaw<2> &,
                   const Temperature<2> &);
  template SingularFunctions
  tip_functions<3>(const Scene &,
                   const Mesh<3> &,
                   const BoundaryRoles &,
                   const MaxwellLaw<3> &,
                   const Temperature<3> &);
} // namespace Crevasse
