// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/crack_tip/interaction_integral.h>
#include <crevasse/discretisation/cell_values.h>
#include <crevasse/discretisation/polar_field.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** q and its gradient, in the coordinates of the tip. */
    struct Weight
    {
      const double radius;

      double
      value(const Point<2> &local) const
      {
        return factor(local[0]) * factor(local[1]);
      }

      Tensor<1, 2>
      gradient(const Point<2> &local) const
      {
        return Tensor<1, 2>({slope(local[0]) * factor(local[1]),
                             factor(local[0]) * slope(local[1])});
      }

      double
      factor(const double x) const
      {
        const double s = x / radius;
        return std::abs(s) >= 1. ? 0. : (1. - s * s) * (1. - s * s);
      }

      double
      slope(const double x) const
      {
        const double s = x / radius;
        return std::abs(s) >= 1. ? 0. : -4. * s * (1. - s * s) / radius;
      }
    };



    /** u^a: K_I = 1 */
    PolarField
    unit_field(const PlaneElasticity &elasticity)
    {
      PolarField field = williams_term(1, elasticity.kappa());
      field *=
        1. / (2. * elasticity.shear_modulus() * std::sqrt(2. * numbers::PI));
      return field;
    }



    /** The integrand of 2 I at a point, times E'/2, for any gradient of u in
     * the coordinates of the tip. */
    struct Integrand
    {
      const PlaneElasticity &elasticity;
      const Tensor<2, 2>     unit_gradient, unit_stress;
      const Tensor<1, 2>     weight_gradient;

      double
      operator()(const Tensor<2, 2> &gradient, const double dilatation) const
      {
        const Tensor<2, 2> stress = elasticity.stress(gradient, dilatation);
        double             sum    = 0.;
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int j = 0; j < 2; ++j)
            sum += (stress[i][j] * unit_gradient[i][0] +
                    unit_stress[i][j] * gradient[i][0]) *
                     weight_gradient[j] -
                   stress[i][j] * unit_gradient[i][j] * weight_gradient[0];
        return elasticity.modulus() * sum;
      }
    };



    /** That of the gradient of a shape function over a cell. It has one
     * component d, and so its gradient is e_d ⊗ ∇φ. */
    double
    integral_of_shape(const FEValues<2>            &values,
                      const unsigned int            i,
                      const CrackTip               &tip,
                      const std::vector<Integrand> &at_points,
                      const bool                    mean_volume)
    {
      const unsigned int d = values.get_fe().system_to_component_index(i).first;
      const Tensor<1, 2> direction({tip.ahead[d], tip.inward[d]});
      double             mean = 0., volume = 0.;
      if (mean_volume)
        for (const unsigned int q : values.quadrature_point_indices())
          {
            mean += values.shape_grad(i, q)[d] * values.JxW(q);
            volume += values.JxW(q);
          }

      double sum = 0.;
      for (const unsigned int q : values.quadrature_point_indices())
        {
          const Tensor<1, 2> slope    = values.shape_grad(i, q);
          const Tensor<2, 2> gradient = outer_product(
            direction, Tensor<1, 2>({slope * tip.ahead, slope * tip.inward}));
          sum += at_points[q](gradient,
                              mean_volume ? mean / volume : trace(gradient)) *
                 values.JxW(q);
        }
      return sum;
    }



    /** Adds those of the gradients of singular functions over a cell. */
    void
    add_singular_functions(const Space<2>               &space,
                           const CrackTip               &tip,
                           const FEValues<2>            &values,
                           const std::vector<Integrand> &at_points,
                           Vector                       &functional)
    {
      if (space.singular_shapes() == nullptr)
        return;
      const Tensor<2, 2>        turn = tip.to_local();
      std::vector<Tensor<2, 2>> gradients;
      for (unsigned int k = 0; k < space.singular_shapes()->size(); ++k)
        {
          space.singular_shapes()->gradients(k, values, gradients);
          double sum = 0.;
          for (const unsigned int q : values.quadrature_point_indices())
            {
              const Tensor<2, 2> gradient =
                turn * gradients[q] * transpose(turn);
              sum += at_points[q](gradient, trace(gradient)) * values.JxW(q);
            }
          functional(space.singular_unknown(k)) += sum;
        }
    }



    /** A rule on a face of the lip, of the weight 1/√r, exact for polynomials
     * as they occur: r = s² makes it smooth. */
    Quadrature<1>
    inverse_root_rule(const double r_0, const double r_1)
    {
      const QGauss<1>       gauss(8);
      const double          s_0 = std::sqrt(r_0), s_1 = std::sqrt(r_1);
      std::vector<Point<1>> nodes;
      std::vector<double>   weights;
      for (unsigned int k = 0; k < gauss.size(); ++k)
        {
          const double s = s_0 + gauss.point(k)[0] * (s_1 - s_0);
          nodes.emplace_back((s * s - r_0) / (r_1 - r_0));
          weights.push_back(gauss.weight(k) * 2. * (s_1 - s_0) / (r_1 - r_0));
        }
      return Quadrature<1>(nodes, weights);
    }



    /** Those of displacements over the square. */
    Vector
    integrate_over_cells(const Body<2>   &body,
                         const TipRegion &region,
                         const double     radius)
    {
      const Space<2>        &space      = body.space;
      const CrackTip        &tip        = region.tip();
      const PlaneElasticity &elasticity = region.elasticity();
      const PolarField       unit       = unit_field(elasticity);
      const Weight           weight{radius};
      const bool             mean_volume =
        space.volumetric_strain() == VolumetricStrain::mean;

      // Independent of the points where the stress is: u is known everywhere.
      const FESystem<2> &fe = space.finite_element();
      const UpdateFlags  flags =
        update_gradients | update_quadrature_points | update_JxW_values;
      FEValues<2> regular(space.mapping(), fe, QGauss<2>(fe.degree + 4), flags);
      CellValues<2> near_tip(space, flags);

      Vector functional;
      body.strain_operator.initialize(functional);
      std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
      dealii::Vector<double>               cell_vector(fe.n_dofs_per_cell());
      for (const auto &cell : space.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned() &&
            region.distance(cell->active_cell_index()) < radius)
          {
            if (space.rule(cell) == 0)
              regular.reinit(cell);
            const FEValues<2> &values =
              space.rule(cell) == 0 ? regular : near_tip.reinit(cell);
            std::vector<Integrand> at_points;
            for (const Point<2> &point : values.get_quadrature_points())
              {
                const Tensor<2, 2> gradient = unit.gradient(tip.local(point));
                at_points.push_back({elasticity,
                                     gradient,
                                     elasticity.stress(gradient),
                                     weight.gradient(tip.local(point))});
              }
            cell->get_dof_indices(dofs);
            for (const unsigned int i : values.dof_indices())
              cell_vector[i] =
                integral_of_shape(values, i, tip, at_points, mean_volume);
            space.constraints().distribute_local_to_global(cell_vector,
                                                           dofs,
                                                           functional);
            add_singular_functions(space, tip, values, at_points, functional);
          }
      functional.compress(VectorOperation::add);
      return functional;
    }



    /** Those of the pressure along the lip, for its nodes. */
    std::vector<double>
    integrate_over_lip(const Body<2>  &body,
                       const CrackTip &tip,
                       const double    radius)
    {
      const Space<2>                      &space = body.space;
      const Weight                         weight{radius};
      const FESystem<2>                   &fe = space.finite_element();
      std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
      Vector per_pressure = space.ghosted_vector();
      for (const auto &cell : space.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int f : cell->face_indices())
            {
              if (!cell->at_boundary(f) || space.roles().contact.count(
                                             cell->face(f)->boundary_id()) == 0)
                continue;
              const Point<2> a   = tip.local(cell->face(f)->vertex(0));
              const Point<2> b   = tip.local(cell->face(f)->vertex(1));
              const double   r_a = -a[0], r_b = -b[0];
              // Another lip may be anywhere.
              if (std::abs(a[1]) + std::abs(b[1]) > 1e-8 * (b - a).norm() ||
                  r_a + r_b <= 0. || std::min(r_a, r_b) >= radius)
                continue;
              FEFaceValues<2> values(space.mapping(),
                                     fe,
                                     inverse_root_rule(std::max(r_a, 0.),
                                                       std::max(r_b, 0.)),
                                     update_values | update_quadrature_points |
                                       update_JxW_values);
              values.reinit(cell, f);
              cell->get_dof_indices(dofs);
              for (const unsigned int i : values.dof_indices())
                {
                  const unsigned int d = fe.system_to_component_index(i).first;
                  if (!fe.has_support_on_face(i, f) ||
                      std::abs(tip.inward[d]) < 0.5)
                    continue;
                  for (const unsigned int q : values.quadrature_point_indices())
                    per_pressure(dofs[i]) +=
                      2. / std::sqrt(2. * numbers::PI) *
                      values.shape_value(i, q) *
                      weight.value(tip.local(values.quadrature_point(q))) *
                      values.JxW(q);
                }
            }
      per_pressure.compress(VectorOperation::add);
      body.lip.gather_from_held_nodes(per_pressure);
      std::vector<double> of_forces;
      for (const LipNode<2> &node : body.lip.nodes())
        of_forces.push_back(per_pressure(node.dof) / node.weight);
      return of_forces;
    }
  } // namespace



  double
  IntensityFunctional::value(const Vector              &v,
                             const std::vector<double> &contact_forces) const
  {
    double of_forces = 0.;
    for (std::size_t k = 0; k < of_contact_forces.size(); ++k)
      of_forces += of_contact_forces[k] * contact_forces[k];
    return of_vector * v +
           Utilities::MPI::sum(of_forces, v.get_mpi_communicator());
  }



  IntensityFunctional
  interaction_integral(const Body<2>   &body,
                       const TipRegion &region,
                       const double     radius)
  {
    return {integrate_over_cells(body, region, radius),
            integrate_over_lip(body, region.tip(), radius)};
  }



  IntensityFunctional
  weight_function(Vector                   &&influence,
                  const UnilateralBounds    &bounds,
                  const std::vector<double> &of_lip)
  {
    std::vector<double> of_contact_forces(of_lip);
    of_contact_forces.resize(bounds.dofs.size(), 0.);
    for (std::size_t k = 0; k < of_contact_forces.size(); ++k)
      of_contact_forces[k] += bounds.sign[k] * influence(bounds.dofs[k]);
    return {std::move(influence), std::move(of_contact_forces)};
  }
} // namespace Crevasse
