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

#include <crevasse/output/probe.h>
#include <crevasse/scene/problems.h>
#include <crevasse/scene/text.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Below this a shape function value is rounding. */
    constexpr double negligible = 1e-12;



    /** The locally owned cell around a point and the point in it; an invalid
     * iterator if this rank has none. */
    template <int dim>
    std::pair<typename DoFHandler<dim>::active_cell_iterator, Point<dim>>
    locate(const Space<dim> &space, const Point<dim> &point)
    {
      const auto found =
        GridTools::find_active_cell_around_point(space.mapping(),
                                                 space.dof_handler(),
                                                 point);
      if (found.first.state() == IteratorState::valid &&
          found.first->is_locally_owned())
        return found;
      return {space.dof_handler().end(), Point<dim>()};
    }
  } // namespace



  template <int dim>
  ProbeEvaluator<dim>::ProbeEvaluator(const Probe<dim>           &probe,
                                      const Space<dim>           &space,
                                      const StressRecovery<dim>  &recovery,
                                      const ContactBoundary<dim> &lip)
    : probe(probe)
    , communicator(space.communicator())
    , recovery(recovery)
    , lip(lip)
  {
    const auto [cell, unit_point] = locate(space, probe.point);
    const bool found              = (cell != space.dof_handler().end());

    // The first of the ranks that found the point speaks for it.
    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
    const unsigned int none = Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int owner =
      Utilities::MPI::min(found ? rank : none, communicator);
    if (owner == none)
      {
        throw SceneError("[Output] Probes: " + probe.name + " at " +
                         Text::from_point(probe.point) +
                         " lies outside the mesh.");
      }

    DofWeights at_nodes;
    owns_point = (rank == owner);
    if (owns_point)
      {
        find_displacement_weights(cell, unit_point, space);
        find_lip_weights(cell, unit_point, space);
        at_nodes = nodal_weights(cell, unit_point, recovery);
      }
    is_on_lip      = Utilities::MPI::max(is_on_lip ? 1 : 0, communicator) == 1;
    stress_weights = recovery.weights_of(at_nodes);
  }



  template <int dim>
  void
  ProbeEvaluator<dim>::find_displacement_weights(
    const typename DoFHandler<dim>::active_cell_iterator &cell,
    const Point<dim>                                     &unit_point,
    const Space<dim>                                     &space)
  {
    const FESystem<dim>                 &fe = space.finite_element();
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    cell->get_dof_indices(indices);
    for (unsigned int i = 0; i < indices.size(); ++i)
      {
        const double value = fe.shape_value(i, unit_point);
        if (std::abs(value) < negligible)
          continue;
        DofWeights &weights =
          displacement_weights[fe.system_to_component_index(i).first];
        if (!space.constraints().is_constrained(indices[i]))
          weights.emplace_back(indices[i], value);
        else
          for (const auto &[dof, factor] :
               *space.constraints().get_constraint_entries(indices[i]))
            weights.emplace_back(dof, factor * value);
      }
  }



  template <int dim>
  typename ProbeEvaluator<dim>::DofWeights
  ProbeEvaluator<dim>::nodal_weights(
    const typename DoFHandler<dim>::active_cell_iterator &cell,
    const Point<dim>                                     &unit_point,
    const StressRecovery<dim>                            &recovery) const
  {
    const typename DoFHandler<dim>::active_cell_iterator nodal_cell(
      &cell->get_triangulation(),
      cell->level(),
      cell->index(),
      &recovery.dof_handler());
    const FiniteElement<dim>            &fe = nodal_cell->get_fe();
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    nodal_cell->get_dof_indices(indices);
    DofWeights weights;
    for (unsigned int i = 0; i < indices.size(); ++i)
      if (std::abs(fe.shape_value(i, unit_point)) > negligible)
        weights.emplace_back(indices[i], fe.shape_value(i, unit_point));
    return weights;
  }



  template <int dim>
  void
  ProbeEvaluator<dim>::find_lip_weights(
    const typename DoFHandler<dim>::active_cell_iterator &cell,
    const Point<dim>                                     &unit_point,
    const Space<dim>                                     &space)
  {
    for (const unsigned int f : cell->face_indices())
      {
        // Faces 2d and 2d+1 are where the unit coordinate d is 0 and 1.
        const double distance = std::abs(unit_point[f / 2] - f % 2);
        if (!cell->face(f)->at_boundary() || distance > 1e-10 ||
            space.roles().contact.count(cell->face(f)->boundary_id()) == 0)
          continue;

        // At a corner of two lips the first one speaks.
        is_on_lip = true;
        gap       = lip.gap_at(probe.point);
        FEFaceValues<dim> face(space.mapping(),
                               space.finite_element(),
                               QMidpoint<dim - 1>(),
                               update_normal_vectors);
        face.reinit(cell, f);
        normal = -face.normal_vector(0);
        for (unsigned int k = 0; k < lip.nodes().size(); ++k)
          if (std::abs(normal[lip.nodes()[k].component]) > 0.5)
            for (const auto &[dof, weight] :
                 displacement_weights[lip.nodes()[k].component])
              if (dof == lip.nodes()[k].dof)
                lip_weights.emplace_back(k, weight);
        return;
      }
  }



  template <int dim>
  const std::string &
  ProbeEvaluator<dim>::name() const
  {
    return probe.name;
  }



  template <int dim>
  bool
  ProbeEvaluator<dim>::on_lip() const
  {
    return is_on_lip;
  }



  template <int dim>
  Tensor<1, dim>
  ProbeEvaluator<dim>::displacement(const Vector &displacement) const
  {
    Tensor<1, dim> value;
    for (unsigned int d = 0; d < dim; ++d)
      for (const auto &[dof, weight] : displacement_weights[d])
        value[d] += weight * displacement(dof);
    return Utilities::MPI::sum(value, communicator);
  }



  template <int dim>
  VoigtVector<dim>
  ProbeEvaluator<dim>::stress(const Vector &stress) const
  {
    return recovery.evaluate(stress, stress_weights);
  }



  template <int dim>
  std::array<double, 2>
  ProbeEvaluator<dim>::opening_and_pressure(const State &state) const
  {
    // The rank that owns the point knows its normal; elsewhere it is zero.
    const double opening =
      displacement(state.displacement) * normal - (is_on_lip ? gap : 0.);
    double pressure = 0.;
    for (const auto &[k, weight] : lip_weights)
      pressure += weight * state.contact_forces[k] / lip.nodes()[k].weight;

    std::array<double, 2> values{{owns_point ? opening : 0., pressure}};
    Utilities::MPI::sum(ArrayView<const double>(values.data(), values.size()),
                        communicator,
                        ArrayView<double>(values.data(), values.size()));
    return values;
  }



  template <int dim>
  std::vector<ProbeEvaluator<dim>>
  make_probes(const std::string          &probes,
              const Space<dim>           &space,
              const StressRecovery<dim>  &recovery,
              const ContactBoundary<dim> &lip)
  {
    std::vector<ProbeEvaluator<dim>> evaluators;
    for (const Probe<dim> &probe : parse_probes<dim>(probes))
      evaluators.emplace_back(probe, space, recovery, lip);
    return evaluators;
  }



  template class ProbeEvaluator<2>;
  template std::vector<ProbeEvaluator<2>>
  make_probes<2>(const std::string &,
                 const Space<2> &,
                 const StressRecovery<2> &,
                 const ContactBoundary<2> &);
} // namespace Crevasse
