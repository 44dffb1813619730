// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/postprocess/probe.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_tools.h>

#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Below this a shape function value is rounding. */
    constexpr double negligible = 1e-12;



    /** The lip face of a cell on which a point of it lies, if there is one. At
     * a corner of two lips the first one speaks. */
    template <int dim>
    unsigned int
    lip_face(const typename DoFHandler<dim>::active_cell_iterator &cell,
             const Point<dim>                                     &unit_point,
             const BoundaryRoles                                  &roles)
    {
      for (const unsigned int f : cell->face_indices())
        // Faces 2d and 2d+1 are where the unit coordinate d is 0 and 1.
        if (cell->face(f)->at_boundary() &&
            std::abs(unit_point[f / 2] - f % 2) <= 1e-10 &&
            roles.contact.count(cell->face(f)->boundary_id()) > 0)
          return f;
      return numbers::invalid_unsigned_int;
    }



    /** The entries of a vector that this rank owns and that are not zero. */
    std::vector<std::pair<types::global_dof_index, double>>
    owned_entries(const Vector &weights)
    {
      std::vector<std::pair<types::global_dof_index, double>> entries;
      for (const auto dof : weights.locally_owned_elements())
        if (weights(dof) != 0.)
          entries.emplace_back(dof, weights(dof));
      return entries;
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
    Place place = find_place(space);
    place.found = is_chosen(place);
    find_displacement_weights(place, space);
    find_stress_weights(place);
    find_lip_weights(place, space);
  }



  template <int dim>
  typename ProbeEvaluator<dim>::Place
  ProbeEvaluator<dim>::find_place(const Space<dim> &space) const
  {
    Place place;
    for (const auto &[cell, unit_point] :
         GridTools::find_all_active_cells_around_point(space.mapping(),
                                                       space.dof_handler(),
                                                       probe.point))
      {
        if (!cell->is_locally_owned())
          continue;
        const unsigned int face =
          lip_face<dim>(cell, unit_point, space.roles());
        if (!place.found || (place.lip_face == numbers::invalid_unsigned_int &&
                             face != numbers::invalid_unsigned_int))
          place = {cell, unit_point, true, face};
      }
    return place;
  }



  template <int dim>
  bool
  ProbeEvaluator<dim>::is_chosen(const Place &place) const
  {
    // Ranks that see the lip there come first, then any that sees the point.
    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
    const unsigned int none = 2 * Utilities::MPI::n_mpi_processes(communicator);
    unsigned int       order = none;
    if (place.found)
      order = place.lip_face != numbers::invalid_unsigned_int ? rank
                                                              : none / 2 + rank;
    const unsigned int first = Utilities::MPI::min(order, communicator);
    if (first == none)
      throw SceneError("[Output] Probes: " + probe.name + " at " +
                       Text::from_point(probe.point) +
                       " lies outside the mesh.");
    return order == first;
  }



  template <int dim>
  void
  ProbeEvaluator<dim>::find_displacement_weights(const Place      &place,
                                                 const Space<dim> &space)
  {
    const FESystem<dim>                 &fe = space.finite_element();
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    std::vector<Vector>                  weights(dim, space.ghosted_vector());
    if (place.found)
      {
        place.cell->get_dof_indices(indices);
        for (unsigned int i = 0; i < indices.size(); ++i)
          {
            const double value = fe.shape_value(i, place.unit_point);
            if (std::abs(value) < negligible)
              continue;
            Vector &component = weights[fe.system_to_component_index(i).first];
            if (!space.constraints().is_constrained(indices[i]))
              component(indices[i]) += value;
            else
              for (const auto &[dof, factor] :
                   *space.constraints().get_constraint_entries(indices[i]))
                component(dof) += factor * value;
          }
      }
    if (place.found)
      add_singular_values(place, space, weights);
    for (unsigned int d = 0; d < dim; ++d)
      {
        weights[d].compress(VectorOperation::add);
        displacement_weights[d] = owned_entries(weights[d]);
      }
  }



  template <int dim>
  void
  ProbeEvaluator<dim>::add_singular_values(const Place         &place,
                                           const Space<dim>    &space,
                                           std::vector<Vector> &weights)
  {
    if constexpr (dim == 2)
      if (const SingularShapes *shapes = space.singular_shapes())
        {
          FEValues<dim> values(space.mapping(),
                               space.finite_element(),
                               Quadrature<dim>(place.unit_point),
                               update_values | update_quadrature_points);
          values.reinit(place.cell);
          std::vector<Tensor<1, dim>> shape;
          for (unsigned int k = 0; k < shapes->size(); ++k)
            {
              shapes->values(k, values, shape);
              for (unsigned int d = 0; d < dim; ++d)
                if (std::abs(shape[0][d]) > negligible)
                  weights[d](space.singular_unknown(k)) += shape[0][d];
            }
        }
  }



  template <int dim>
  void
  ProbeEvaluator<dim>::find_stress_weights(const Place &place)
  {
    DofWeights weights;
    if (place.found)
      {
        const Cell                nodal_cell(&place.cell->get_triangulation(),
                              place.cell->level(),
                              place.cell->index(),
                              &recovery.dof_handler());
        const FiniteElement<dim> &fe = nodal_cell->get_fe();
        std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
        nodal_cell->get_dof_indices(indices);
        for (unsigned int i = 0; i < indices.size(); ++i)
          {
            const double value = fe.shape_value(i, place.unit_point);
            if (std::abs(value) > negligible)
              weights.emplace_back(indices[i], value);
          }
      }
    stress_weights = recovery.weights_of(weights);
  }



  template <int dim>
  void
  ProbeEvaluator<dim>::find_lip_weights(const Place      &place,
                                        const Space<dim> &space)
  {
    Vector weights = space.ghosted_vector();
    collectively(communicator, [&]() {
      if (!place.found || place.lip_face == numbers::invalid_unsigned_int)
        return;
      is_on_lip                               = true;
      const unsigned int                   f  = place.lip_face;
      const FESystem<dim>                 &fe = space.finite_element();
      std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
      place.cell->get_dof_indices(indices);
      FEFaceValues<dim> face(space.mapping(),
                             fe,
                             QMidpoint<dim - 1>(),
                             update_normal_vectors);
      face.reinit(place.cell, f);
      normal = -face.normal_vector(0);
      for (unsigned int i = 0; i < indices.size(); ++i)
        {
          const double value = fe.shape_value(i, place.unit_point);
          if (std::abs(value) < negligible || !fe.has_support_on_face(i, f) ||
              std::abs(normal[fe.system_to_component_index(i).first]) < 0.5)
            continue;
          weights(indices[i]) += value;
          gap += value * lip.gap_at(space.mapping().transform_unit_to_real_cell(
                           place.cell, fe.unit_support_point(i)));
        }
    });
    is_on_lip = Utilities::MPI::max(is_on_lip ? 1 : 0, communicator) == 1;
    normal    = Utilities::MPI::sum(normal, communicator);
    gap       = Utilities::MPI::sum(gap, communicator);

    weights.compress(VectorOperation::add);
    lip.gather_from_held_nodes(weights);
    for (unsigned int k = 0; k < lip.nodes().size(); ++k)
      {
        const LipNode<dim> &node   = lip.nodes()[k];
        const double        weight = weights(node.dof);
        if (weight != 0.)
          pressure_weights.emplace_back(k, weight / node.weight);
      }
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
  double
  ProbeEvaluator<dim>::normal_component(
    const Tensor<1, dim> &displacement) const
  {
    return displacement * normal;
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
    double pressure = 0.;
    for (const auto &[k, weight] : pressure_weights)
      pressure += weight * state.contact_forces[k];
    return {{displacement(state.displacement) * normal - gap,
             Utilities::MPI::sum(pressure, communicator)}};
  }



  template <int dim>
  std::vector<ProbeEvaluator<dim>>
  make_probes(const std::vector<NamedPoint> &probes,
              const Space<dim>              &space,
              const StressRecovery<dim>     &recovery,
              const ContactBoundary<dim>    &lip)
  {
    std::vector<ProbeEvaluator<dim>> evaluators;
    for (const NamedPoint &probe : probes)
      evaluators.emplace_back(Probe<dim>{probe.name,
                                         to_point<dim>(probe.coordinates)},
                              space,
                              recovery,
                              lip);
    return evaluators;
  }



  template class ProbeEvaluator<2>;
  template class ProbeEvaluator<3>;
  template std::vector<ProbeEvaluator<2>>
  make_probes<2>(const std::vector<NamedPoint> &,
                 const Space<2> &,
                 const StressRecovery<2> &,
                 const ContactBoundary<2> &);
  template std::vector<ProbeEvaluator<3>>
  make_probes<3>(const std::vector<NamedPoint> &,
                 const Space<3> &,
                 const StressRecovery<3> &,
                 const ContactBoundary<3> &);
} // namespace Crevasse
