// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/discretisation/marking.h>
#include <crevasse/discretisation/refinement.h>

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/grid_refinement.h>

#include <set>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    std::vector<CellId>
    of_all_ranks(const std::vector<CellId> &mine, const MPI_Comm communicator)
    {
      std::vector<CellId> all;
      for (const auto &part : Utilities::MPI::all_gather(communicator, mine))
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
    Marks mine;
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          if (cell->refine_flag_set())
            mine.refined.push_back(cell->id());
          else if (cell->coarsen_flag_set())
            mine.coarsened.push_back(cell->id());
        }
    return {of_all_ranks(mine.refined, mesh.get_communicator()),
            of_all_ranks(mine.coarsened, mesh.get_communicator())};
  }



  template <int dim>
  void
  apply(const Marks &marks, Mesh<dim> &mesh)
  {
    const std::set<CellId> refined(marks.refined.begin(), marks.refined.end());
    const std::set<CellId> coarsened(marks.coarsened.begin(),
                                     marks.coarsened.end());
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
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
  MeshHistory<dim>::MeshHistory(const MakeMesh &make_mesh)
    : make_first(make_mesh)
  {
  }



  template <int dim>
  std::shared_ptr<Mesh<dim>>
  MeshHistory<dim>::make() const
  {
    const std::shared_ptr<Mesh<dim>> mesh = make_first();
    for (const Marks &marks : all)
      apply<dim>(marks, *mesh);
    return mesh;
  }



  template <int dim>
  std::shared_ptr<Mesh<dim>>
  MeshHistory<dim>::make_with(const Marks &next) const
  {
    const std::shared_ptr<Mesh<dim>> mesh = make();
    apply<dim>(next, *mesh);
    return mesh;
  }



  template <int dim>
  void
  MeshHistory<dim>::add(const Marks &marks)
  {
    all.push_back(marks);
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



#define INSTANTIATE(dim)                                       \
  template void  set_flags<dim>(Mesh<dim> &,                   \
                               const dealii::Vector<float> &, \
                               const RefinementParameters &,  \
                               const double);                 \
  template Marks flagged_cells<dim>(const Mesh<dim> &);        \
  template void  apply<dim>(const Marks &, Mesh<dim> &);       \
  template class MeshHistory<dim>

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
