// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/nodal_functions.h>

#include <deal.II/numerics/vector_tools.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** A coordinate of the point, in all components. */
    template <int dim>
    class Coordinate : public Function<dim>
    {
    public:
      explicit Coordinate(const unsigned int axis)
        : Function<dim>(dim)
        , axis(axis)
      {
      }

      double
      value(const Point<dim> &point, const unsigned int) const override
      {
        return point[axis];
      }

    private:
      const unsigned int axis;
    };
  } // namespace



  template <int dim>
  std::map<types::global_dof_index, Point<dim>>
  nodes_on(const Space<dim>        &space,
           const types::boundary_id id,
           const unsigned int       component)
  {
    ComponentMask mask(dim, false);
    mask.set(component, true);
    std::map<types::global_dof_index, Point<dim>> points;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        std::map<types::global_dof_index, double> coordinates;
        VectorTools::interpolate_boundary_values(space.mapping,
                                                 space.dof_handler,
                                                 id,
                                                 Coordinate<dim>(axis),
                                                 coordinates,
                                                 mask);
        for (const auto &[dof, coordinate] : coordinates)
          points[dof][axis] = coordinate;
      }
    return points;
  }



  template <int dim>
  NodalFunctions<dim>::NodalFunctions(const Space<dim> &space,
                                      const Numbers    &numbers)
    : space(space)
    , numbers(numbers)
    , hanging(DoFTools::extract_locally_relevant_dofs(space.dof_handler))
  {
    DoFTools::make_hanging_node_constraints(space.dof_handler, hanging);
    hanging.close();
  }



  template <int dim>
  typename NodalFunctions<dim>::Parts
  NodalFunctions<dim>::parts_of(const types::global_dof_index dof) const
  {
    if (const auto own = numbers.find(dof); own != numbers.end())
      return {{own->second, 1.}};
    Parts parts;
    if (const auto *masters = hanging.get_constraint_entries(dof))
      for (const auto &[master, factor] : *masters)
        if (const auto own = numbers.find(master); own != numbers.end())
          parts.emplace_back(own->second, factor);
    return parts;
  }



  template <int dim>
  std::vector<VoigtVector<dim>>
  NodalFunctions<dim>::strains_of_shape(const unsigned int   i,
                                        const FEValues<dim> &values) const
  {
    const unsigned int component =
      space.finite_element.system_to_component_index(i).first;
    std::vector<VoigtVector<dim>> strains;
    double                        trace = 0., volume = 0.;
    const auto                    trace_of = [](const VoigtVector<dim> &e) {
      return e[0] + e[1] + e[2];
    };
    for (const unsigned int q : values.quadrature_point_indices())
      {
        Tensor<2, dim> gradient;
        gradient[component] = values.shape_grad(i, q);
        strains.push_back(voigt_strain<dim>(gradient));
        if (space.roles.has_axis && component == 0)
          strains.back()[2] =
            values.shape_value(i, q) / values.quadrature_point(q)[0];
        trace += trace_of(strains.back()) * values.JxW(q);
        volume += values.JxW(q);
      }
    if (space.volumetric_strain == VolumetricStrain::mean)
      for (VoigtVector<dim> &strain : strains)
        {
          const double change = (trace / volume - trace_of(strain)) / 3.;
          for (const unsigned int c : {0, 1, 2})
            strain[c] += change;
        }
    return strains;
  }



  template decltype(nodes_on<2>) nodes_on<2>;
  template decltype(nodes_on<3>) nodes_on<3>;
  template class NodalFunctions<2>;
  template class NodalFunctions<3>;
} // namespace Crevasse
