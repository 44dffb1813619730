// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/postprocess/principal_stresses.h>
#include <crevasse/postprocess/probe.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int no_face = numbers::invalid_unsigned_int;



    /** Degrees of freedom of a cell and the values of their shape functions at
     * a point; 0 if the value is rounding. */
    template <int dim>
    std::vector<std::pair<types::global_dof_index, double>>
    shape_values(const typename DoFHandler<dim>::active_cell_iterator &cell,
                 const Point<dim>                                     &place)
    {
      constexpr double                     negligible = 1e-12;
      const FiniteElement<dim>            &fe         = cell->get_fe();
      std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
      cell->get_dof_indices(indices);
      std::vector<std::pair<types::global_dof_index, double>> values;
      for (unsigned int i = 0; i < indices.size(); ++i)
        {
          const double value = fe.shape_value(i, place);
          values.emplace_back(indices[i],
                              std::abs(value) < negligible ? 0. : value);
        }
      return values;
    }



    /** The lip face of a cell on which a point of it lies, if any. At a corner
     * of two lips the first is used. */
    template <int dim>
    unsigned int
    lip_face(const typename DoFHandler<dim>::active_cell_iterator &cell,
             const Point<dim>                                     &unit_point,
             const BoundaryRoles                                  &roles)
    {
      for (const unsigned int f : cell->face_indices())
        // Faces 2d and 2d+1 have the unit coordinate x_d = 0 and 1.
        if (cell->face(f)->at_boundary() &&
            std::abs(unit_point[f / 2] - f % 2) <= 1e-10 &&
            roles.is_lip(cell->face(f)->boundary_id()))
          return f;
      return no_face;
    }



    /** Cells of this rank that contain a point, with its unit coordinates, on
     * all lips there; deal.II finds only those that share a vertex. */
    template <int dim>
    std::vector<
      std::pair<typename DoFHandler<dim>::active_cell_iterator, Point<dim>>>
    cells_around(const Space<dim> &space, const Point<dim> &point)
    {
      std::vector<
        std::pair<typename DoFHandler<dim>::active_cell_iterator, Point<dim>>>
        found;
      for (const auto &cell : owned_cells(space.dof_handler))
        if (cell->center().distance(point) < cell->diameter())
          try
            {
              const Point<dim> unit =
                space.mapping.transform_real_to_unit_cell(cell, point);
              if (GeometryInfo<dim>::distance_to_unit_cell(unit) < 1e-10)
                found.emplace_back(cell, unit);
            }
          catch (const typename Mapping<dim>::ExcTransformationFailed &)
            {
            } // not in this cell
      return found;
    }
  } // namespace



  template <int dim>
  ProbeEvaluator<dim>::ProbeEvaluator(const NamedPoint               &probe,
                                      const Space<dim>               &space,
                                      const StressRecovery<dim>      &recovery,
                                      const ContactBoundary<dim>     &lip,
                                      const ImposedDisplacement<dim> *imposed)
    : name(probe.name)
    , point(to_point<dim>(probe.coordinates))
    , communicator(space.communicator())
    , recovery(recovery)
    , lip(lip)
    , imposed(imposed != nullptr && imposed->is_on ? imposed : nullptr)
  {
    const Place place    = find_place(space, false);
    displacement_weights = displacement_at(place, space);
    std::vector<std::pair<types::global_dof_index, double>> weights;
    if (place.found)
      weights = shape_values<dim>({&place.cell->get_triangulation(),
                                   place.cell->level(),
                                   place.cell->index(),
                                   &recovery.dof_handler},
                                  place.unit_point);
    stress_weights =
      recovery.weights_of(weights,
                          place.found ? recovery.material_of(place.cell) : 0);
    find_lip_weights(place, space);
    if (!on_lip)
      return;
    const Place other = find_place(space, true);
    other_lip_weights = displacement_at(other, space);
    if (Utilities::MPI::max(other.found ? 1 : 0, communicator) == 1)
      side_of_crack = Tensor<1, dim>() + normal; // turns −0 into 0
  }



  template <int dim>
  typename ProbeEvaluator<dim>::Place
  ProbeEvaluator<dim>::find_place(const Space<dim> &space,
                                  const bool        on_other_lip)
  {
    // Order of preference: cells with the point on a lip; at an interface the
    // cell on the left, below or in front, or most so; the lowest rank.
    using Order = std::array<double, 2 * dim + 3>;
    Order outside;
    outside.fill(1.);
    Order        first = outside;
    Place        place;
    unsigned int least = numbers::invalid_unsigned_int, most = 0;
    for (const auto &[cell, unit_point] : cells_around(space, point))
      {
        const unsigned int face = lip_face<dim>(cell, unit_point, space.roles);
        const bool         on_crack =
          face != no_face &&
          space.roles.crack.count(cell->face(face)->boundary_id()) > 0;
        if (on_other_lip && !(on_crack && faces_other_lip(space, cell, face)))
          continue;
        Order                order{{0., face == no_face ? 1. : 0.}};
        const Tensor<1, dim> offset = cell->center() - point;
        const double         length = offset.norm(); // 0 at the center
        for (unsigned int d = 0;
             d < dim && (recovery.has_interfaces() || on_crack);
             ++d)
          {
            const double along = length > 0. ? offset[d] / length : 0.;
            order[2 + d]       = along > -0.1 ? 1. : 0.;
            order[2 + dim + d] = std::round(1000. * along);
          }
        order.back() = Utilities::MPI::this_mpi_process(communicator);
        least        = std::min(least, recovery.material_of(cell));
        most         = std::max(most, recovery.material_of(cell));
        if (order < first)
          {
            first = order;
            place = {cell, unit_point, true, face};
          }
      }
    const Order mine = first;
    for (const Order &of_rank : Utilities::MPI::all_gather(communicator, first))
      first = std::min(first, of_rank);
    if (first == outside && on_other_lip)
      return place;
    if (first == outside)
      throw SceneError("[Output] Probes: " + name + " at " +
                       Text::from_point(point) + " lies outside the mesh.");
    place.found = mine == first;
    if (on_other_lip)
      return place;
    if (Utilities::MPI::min(least, communicator) <
        Utilities::MPI::max(most, communicator))
      side_of_interface =
        Utilities::MPI::sum(place.found ? Tensor<1, dim>(place.cell->center())
                                        : Tensor<1, dim>(),
                            communicator);
    return place;
  }



  template <int dim>
  bool
  ProbeEvaluator<dim>::faces_other_lip(
    const Space<dim>                                     &space,
    const typename DoFHandler<dim>::active_cell_iterator &cell,
    const unsigned int                                    face) const
  {
    FEFaceValues<dim> values(space.mapping,
                             space.finite_element,
                             QMidpoint<dim - 1>(),
                             update_normal_vectors);
    values.reinit(cell, face);
    return values.normal_vector(0) * normal > 0.5;
  }



  template <int dim>
  typename ProbeEvaluator<dim>::DisplacementWeights
  ProbeEvaluator<dim>::displacement_at(const Place      &place,
                                       const Space<dim> &space) const
  {
    const FESystem<dim> &fe = space.finite_element;
    DisplacementWeights  of_components;
    for (unsigned int d = 0; d < dim; ++d)
      {
        Vector weights = space.ghosted_vector();
        if (place.found)
          {
            const auto values = shape_values<dim>(place.cell, place.unit_point);
            for (unsigned int i = 0; i < values.size(); ++i)
              if (const auto [dof, value] = values[i];
                  fe.system_to_component_index(i).first == d)
                {
                  space.constraints.distribute_local_to_global(dof,
                                                               value,
                                                               weights);
                  if (imposed != nullptr)
                    for (const auto &[node, part] :
                         imposed->functions->parts_of(dof))
                      of_components[d].of_imposed.emplace_back(node,
                                                               part * value);
                }
          }
        if constexpr (dim == 2)
          if (const SingularShapes *shapes = space.singular_shapes();
              shapes != nullptr && place.found)
            {
              FEValues<dim> at_place(space.mapping,
                                     fe,
                                     Quadrature<dim>(place.unit_point),
                                     update_values | update_quadrature_points);
              at_place.reinit(place.cell);
              std::vector<std::vector<Tensor<1, dim>>> shape;
              shapes->values(at_place, shape);
              for (unsigned int k = 0; k < shapes->size(); ++k)
                weights(space.singular_unknown(k)) += shape[k][0][d];
            }
        weights.compress(VectorOperation::add);
        for (unsigned int i = 0; i < weights.locally_owned_size(); ++i)
          if (weights.local_element(i) != 0.)
            of_components[d].of_unknowns.emplace_back(i,
                                                      weights.local_element(i));
      }
    return of_components;
  }



  template <int dim>
  void
  ProbeEvaluator<dim>::find_lip_weights(const Place      &place,
                                        const Space<dim> &space)
  {
    const unsigned int f       = place.lip_face;
    Vector             weights = space.ghosted_vector();
    collectively(communicator, [&]() {
      if (!place.found || f == no_face)
        return;
      on_lip                  = true;
      const FESystem<dim> &fe = space.finite_element;
      FEFaceValues<dim>    face(space.mapping,
                             fe,
                             QMidpoint<dim - 1>(),
                             update_normal_vectors);
      face.reinit(place.cell, f);
      normal            = -face.normal_vector(0);
      const auto values = shape_values<dim>(place.cell, place.unit_point);
      for (unsigned int i = 0; i < values.size(); ++i)
        {
          const double value = values[i].second;
          if (value == 0. || !fe.has_support_on_face(i, f))
            continue;
          weights(values[i].first) += value;
          if (fe.system_to_component_index(i).first == 0)
            gap += value * lip.gap_at(space.mapping.transform_unit_to_real_cell(
                             place.cell, fe.unit_support_point(i)));
        }
    });
    on_lip = Utilities::MPI::max(on_lip ? 1 : 0, communicator) == 1;
    normal = Utilities::MPI::sum(normal, communicator);
    gap    = Utilities::MPI::sum(gap, communicator);

    const std::vector<double> factors = lip.of_contact_forces(weights);
    for (unsigned int k = 0; k < factors.size(); ++k)
      if (factors[k] != 0.)
        pressure_weights.emplace_back(k, factors[k]);
  }



  template <int dim>
  Tensor<1, dim>
  ProbeEvaluator<dim>::apply(const DisplacementWeights &weights,
                             const Vector              &displacement)
  {
    Tensor<1, dim> value;
    for (unsigned int d = 0; d < dim; ++d)
      for (const auto &[i, weight] : weights[d].of_unknowns)
        value[d] += weight * displacement.local_element(i);
    return value;
  }



  template <int dim>
  Tensor<1, dim>
  ProbeEvaluator<dim>::imposed_at(const DisplacementWeights &weights,
                                  const double               t,
                                  const double               time) const
  {
    Tensor<1, dim> value;
    for (unsigned int d = 0; imposed != nullptr && d < dim; ++d)
      value[d] = imposed->value(weights[d].of_imposed, t, time);
    return value;
  }



  template <int dim>
  double
  ProbeEvaluator<dim>::local_pressure(const ContactForces &contact_forces) const
  {
    double pressure = 0.;
    for (const auto &[k, weight] : pressure_weights)
      pressure += weight * contact_forces.normal[k];
    return pressure;
  }



  template <int dim>
  typename ProbeEvaluator<dim>::Values
  ProbeEvaluator<dim>::local_values(const Sample &sample) const
  {
    const auto at = [&](const DisplacementWeights &weights) {
      Tensor<1, dim> u = apply(weights, sample.state.displacement);
      if (sample.secular_flow != nullptr)
        u += sample.time * apply(weights, sample.secular_flow->velocity);
      return u + imposed_at(weights, sample.state.instant, sample.time);
    };
    const Tensor<1, dim>   u = at(displacement_weights);
    const VoigtVector<dim> stress =
      StressRecovery<dim>::evaluate(sample.state.stress, stress_weights);
    Values values;
    auto   next = std::copy(u.begin_raw(), u.end_raw(), values.begin());
    next        = std::copy(stress.begin_raw(), stress.end_raw(), next);
    *next++     = (u - at(other_lip_weights)) * normal;
    *next       = local_pressure(sample.state.contact_forces);
    return values;
  }



  template <int dim>
  std::vector<std::string>
  ProbeEvaluator<dim>::columns() const
  {
    std::vector<std::string> names = {"t"};
    for (unsigned int d = 0; d < dim; ++d)
      names.push_back("u_" + std::to_string(d + 1));
    for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
      names.push_back(std::string("s_") + voigt_name<dim>(c));
    names.emplace_back("largest_shear_stress");
    if (on_lip)
      names.insert(names.end(), {"opening", "pressure"});
    return names;
  }



  template <int dim>
  std::vector<double>
  ProbeEvaluator<dim>::row(const double time, const Values &values) const
  {
    std::vector<double> row = {time};
    row.insert(row.end(), values.begin(), values.end() - 2);
    VoigtVector<dim> stress;
    std::copy(values.begin() + dim, values.end() - 2, stress.begin_raw());
    const auto principal =
      principal_stresses<3>(stress_tensor<dim>(stress)).first;
    row.push_back((principal[2] - principal[0]) / 2.);
    if (on_lip)
      row.insert(row.end(), {values[values.size() - 2] - gap, values.back()});
    return row;
  }



  template class ProbeEvaluator<2>;
  template class ProbeEvaluator<3>;
} // namespace Crevasse
