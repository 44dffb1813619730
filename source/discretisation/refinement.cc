// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/discretisation/crack_tip.h>
#include <crevasse/discretisation/refinement.h>

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/grid_refinement.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>

#include <algorithm>
#include <set>
#include <string>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    double
    distance(const Point<dim>                        &point,
             const std::pair<Point<dim>, Point<dim>> &edge)
    {
      const Tensor<1, dim> along  = edge.second - edge.first;
      const double         square = along.norm_square();
      const double         where =
        square == 0. ? 0. : (point - edge.first) * along / square;
      return point.distance(edge.first + std::clamp(where, 0., 1.) * along);
    }



    /** Divides the cells once that have a vertex on the front. */
    template <int dim>
    void
    refine_front(Mesh<dim> &mesh, const CrackFront<dim> &front)
    {
      for (const auto &cell : owned_cells(mesh))
        {
          const double tolerance = 1e-6 * cell->minimum_vertex_distance();
          for (const auto &edge : front)
            for (const unsigned int v : cell->vertex_indices())
              if (distance<dim>(cell->vertex(v), edge) <= tolerance)
                cell->set_refine_flag();
        }
      mesh.execute_coarsening_and_refinement();
    }
  } // namespace



  template <int dim>
  types::global_dof_index
  count_unknowns(const Mesh<dim> &mesh, const unsigned int degree)
  {
    DoFHandler<dim> dofs(mesh);
    dofs.distribute_dofs(FESystem<dim>(FE_Q<dim>(degree), dim));
    return dofs.n_dofs();
  }



  template <int dim>
  void
  require_affordable(const Mesh<dim>            &mesh,
                     const RefinementParameters &parameters,
                     const unsigned int          degree)
  {
    const types::global_dof_index n_unknowns = count_unknowns(mesh, degree);
    if (parameters.target_unknowns > 0 &&
        n_unknowns > parameters.target_unknowns)
      throw SceneError(
        "[Refinement] Target unknowns = " +
        std::to_string(parameters.target_unknowns) + ": the mesh has " +
        std::to_string(n_unknowns) +
        " before its first refinement; raise it, or begin with a coarser mesh "
        "([Geometry] Subdivisions and Refinements).");
  }



  template <int dim>
  std::shared_ptr<Mesh<dim>>
  graded_mesh(const std::function<std::shared_ptr<Mesh<dim>>()> &make_mesh,
              const BoundaryRoles                               &roles,
              const RefinementParameters                        &parameters,
              const unsigned int                                 degree)
  {
    const std::shared_ptr<Mesh<dim>> mesh  = make_mesh();
    const CrackFront<dim>            front = crack_front<dim>(*mesh, roles);
    if (front.empty())
      throw SceneError(
        "[Refinement] Strategy = tip: the mesh has no crack tip, where faces "
        "of "
        "the lip ([Boundary] Contact) go straight on as faces of a plane of "
        "symmetry; use adaptive or none, or look at the roles of the "
        "boundaries.");
    const unsigned int begin = mesh->n_global_levels() - 1;
    if (begin + parameters.cycles > finest_level<dim>)
      throw SceneError(
        "[Refinement] Cycles = " + std::to_string(parameters.cycles) +
        ": must be at most " + std::to_string(finest_level<dim> - begin) +
        " here; smaller cells have no coordinates of their own.");
    unsigned int n_levels =
      parameters.cycles > 0 ? parameters.cycles : finest_level<dim> - begin;
    if (parameters.target_unknowns > 0)
      {
        // On another mesh: there is no way back from too large a one.
        const std::shared_ptr<Mesh<dim>> trial = make_mesh();
        require_affordable(*trial, parameters, degree);
        const unsigned int largest = n_levels;
        for (n_levels = 0; n_levels < largest; ++n_levels)
          {
            refine_front(*trial, front);
            if (count_unknowns(*trial, degree) > parameters.target_unknowns)
              break;
          }
      }
    for (unsigned int level = 0; level < n_levels; ++level)
      refine_front(*mesh, front);
    return mesh;
  }



  namespace
  {
    /** The cells of all ranks that f(cell) holds for. */
    template <int dim, typename Function>
    std::vector<CellId>
    cells_with(const Mesh<dim> &mesh, const Function &f)
    {
      std::vector<CellId> mine, all;
      for (const auto &cell : owned_cells(mesh))
        if (f(cell))
          mine.push_back(cell->id());
      for (const auto &part :
           Utilities::MPI::all_gather(mesh.get_communicator(), mine))
        all.insert(all.end(), part.begin(), part.end());
      return all;
    }
  } // namespace



  template <int dim>
  void
  set_flags(Mesh<dim>                   &mesh,
            const dealii::Vector<float> &squares,
            const RefinementParameters  &parameters,
            const double                 share)
  {
    namespace Refinement = parallel::distributed::GridRefinement;
    const double refine  = share * parameters.refine_fraction;
    const double coarsen = parameters.coarsen_fraction;
    if (parameters.marking == Marking::bulk)
      // The squares as they are: those are what adds up.
      Refinement::refine_and_coarsen_fixed_fraction(
        mesh, squares, refine, coarsen, VectorTools::L1_norm);
    else
      Refinement::refine_and_coarsen_fixed_number(mesh,
                                                  squares,
                                                  refine,
                                                  coarsen);
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned() &&
          static_cast<unsigned int>(cell->level()) >= finest_level<dim>)
        cell->clear_refine_flag();
  }



  template <int dim>
  Marks
  flagged_cells(const Mesh<dim> &mesh)
  {
    return {cells_with(
              mesh, [](const auto &cell) { return cell->refine_flag_set(); }),
            cells_with(mesh, [](const auto &cell) {
              return cell->coarsen_flag_set();
            })};
  }



  template <int dim>
  void
  apply(const Marks &marks, Mesh<dim> &mesh)
  {
    const std::set<CellId> refined(marks.refined.begin(), marks.refined.end());
    const std::set<CellId> coarsened(marks.coarsened.begin(),
                                     marks.coarsened.end());
    for (const auto &cell : owned_cells(mesh))
      {
        const CellId id = cell->id();
        if (refined.count(id) > 0)
          cell->set_refine_flag();
        else if (coarsened.count(id) > 0)
          cell->set_coarsen_flag();
      }
    mesh.execute_coarsening_and_refinement();
  }



  template <int dim>
  void
  MeshHistory<dim>::serialize(StateArchive &archive)
  {
    std::size_t n = all.size();
    archive.common(n);
    all.resize(n);
    for (Marks &marks : all)
      for (std::vector<CellId> *cells : {&marks.refined, &marks.coarsened})
        {
          std::vector<CellId::binary_type> numbers;
          for (const CellId &cell : *cells)
            numbers.push_back(cell.template to_binary<dim>());
          archive.common_list(numbers);
          cells->assign(numbers.begin(), numbers.end());
        }
  }



#define INSTANTIATE(dim)                                                                    \
  template types::global_dof_index    count_unknowns<dim>(const Mesh<dim> &,                \
                                                       const unsigned int);              \
  template void                       require_affordable<dim>(const Mesh<dim> &,            \
                                        const RefinementParameters &, \
                                        const unsigned int);          \
  template std::shared_ptr<Mesh<dim>> graded_mesh<dim>(                                     \
    const std::function<std::shared_ptr<Mesh<dim>>()> &,                                    \
    const BoundaryRoles &,                                                                  \
    const RefinementParameters &,                                                           \
    const unsigned int);                                                                    \
  template void  set_flags<dim>(Mesh<dim> &,                                                \
                               const dealii::Vector<float> &,                              \
                               const RefinementParameters &,                               \
                               const double);                                              \
  template Marks flagged_cells<dim>(const Mesh<dim> &);                                     \
  template void  apply<dim>(const Marks &, Mesh<dim> &);                                    \
  template class MeshHistory<dim>

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
