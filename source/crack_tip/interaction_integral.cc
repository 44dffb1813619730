// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/crack_tip/auxiliary_field.h>
#include <crevasse/crack_tip/interaction_integral.h>
#include <crevasse/crack_tip/lip_integral.h>
#include <crevasse/discretisation/cell_values.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_values.h>

#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** The strain in the plane of a stress in the plane, and what a strain
     * across the plane adds to it, as strain without stress does. */
    struct InPlane
    {
      explicit InPlane(const VoigtMatrix<2> &K)
        : twofold_mu(2. * K[3][3])
        , nu(K[0][1] / (K[0][0] + K[0][1]))
        , of_third(K[0][2] / (K[0][0] + K[0][1]))
      {
      }

      explicit InPlane(const PlaneElasticity &elasticity)
        : twofold_mu(2. * elasticity.shear_modulus())
        , nu((3. - elasticity.kappa()) / 4.)
        , of_third(0.)
      {
      }

      VoigtVector<2>
      strain(const VoigtVector<2> &s) const
      {
        VoigtVector<2> e;
        e[0] = (s[0] - nu * (s[0] + s[1])) / twofold_mu;
        e[1] = (s[1] - nu * (s[0] + s[1])) / twofold_mu;
        e[3] = 2. * s[3] / twofold_mu;
        return e;
      }

      VoigtVector<2>
      free_strain(const VoigtVector<2> &e) const
      {
        VoigtVector<2> sum = e;
        sum[0] += of_third * e[2];
        sum[1] += of_third * e[2];
        sum[2] = 0.;
        return sum;
      }

      const double twofold_mu, nu, of_third;
    };



    /** For a cell of rule 0: the polynomials through its points, at those of a
     * rule that is fine enough for their product with the kernel. */
    class KernelRules
    {
    public:
      explicit KernelRules(const Space<2> &space)
        : per_direction(std::lround(std::sqrt(space.quadratures()[0].size())))
        , polynomials(QGauss<1>(per_direction))
        , usual(space.mapping(),
                polynomials,
                QGauss<2>(per_direction + 4),
                flags)
        , fine(space.mapping(),
               polynomials,
               QIterated<2>(QGauss<1>(4), 8),
               flags)
      {
      }

      /** @param is_rough whether the kernel grows in the cell like r^(−3/2),
       * or jumps, as it does where a square ends. */
      const FEValues<2> &
      reinit(const Triangulation<2>::active_cell_iterator &cell,
             const bool                                    is_rough)
      {
        FEValues<2> &values = is_rough ? fine : usual;
        values.reinit(cell);
        return values;
      }

    private:
      const UpdateFlags flags =
        update_values | update_quadrature_points | update_JxW_values;
      const unsigned int            per_direction;
      const FE_DGQArbitraryNodes<2> polynomials;
      FEValues<2>                   usual, fine;
    };



    /** Of the squares whose τ viscous strain is multiplied by, each with its
     * factor. */
    std::vector<std::pair<SquareWeight, double>>
    weights_of_creep(const InteractionIntegral::Squares &squares)
    {
      if (squares.uniform_creep >= squares.size)
        return {};
      if (squares.uniform_creep > 0.)
        return {{{squares.size}, 1.}, {{squares.uniform_creep}, -1.}};
      return {{{squares.size}, 1.},
              {{squares.varying_creep}, -2.},
              {{2. * squares.varying_creep}, 1.}};
    }
  } // namespace



  InteractionIntegral::InteractionIntegral(const Body<2>        &body,
                                           const PointGeometry  &points,
                                           const TipRegion      &region,
                                           const LoadParameters &loads,
                                           const Squares        &squares)
    : body(body)
    , points(points)
    , region(region)
    , of_contact_forces(lip_integral(body, region.tip(), {squares.size}))
  {
    for (const LoadParameters::Force &force : loads.forces())
      for (unsigned int d = 0; force.in_volume && d < force.components->size();
           ++d)
        if (Expression value((*force.components)[d]); !value.is_zero())
          body_force.emplace_back(d, std::move(value));
    integrate_over_cells(squares);
    balance();
  }



  void
  InteractionIntegral::integrate_over_cells(const Squares &squares)
  {
    const std::vector<std::pair<SquareWeight, double>> of_creep =
      weights_of_creep(squares);
    const auto add = [&](Kernel         &kernel,
                         const Point<2> &point,
                         const double    share) {
      const auto field_of = [&](const SquareWeight &weight) {
        return AuxiliaryField(region.tip(), point, weight);
      };
      kernel.field.add(share, field_of({squares.size}));
      for (const auto &[weight, factor] : of_creep)
        kernel.of_viscous_strain += share * factor * field_of(weight).of_strain;
    };
    const auto ends_within = [&](const TipRegion::Interval &reach) {
      bool ends = TipRegion::is_within(squares.size, reach);
      for (const auto &of_weight : of_creep)
        ends = ends || TipRegion::is_within(of_weight.first.radius, reach);
      return ends;
    };

    const Space<2> &space = body.space;
    KernelRules     rules(space);
    for (const auto &cell : owned_cells(space.mesh()))
      {
        const auto &reach = region.reach(cell->active_cell_index());
        if (reach.first >= squares.size)
          continue;
        const std::size_t   first = body.points.first_point(cell);
        std::vector<Kernel> of_cell(space.quadrature(cell).size());
        for (unsigned int p = 0; p < of_cell.size(); ++p)
          of_cell[p].point = first + p;
        if (space.rule(cell) != 0)
          for (Kernel &kernel : of_cell)
            add(kernel,
                points.location[kernel.point],
                points.weight[kernel.point]);
        else
          {
            const FEValues<2> &values =
              rules.reinit(cell, reach.first == 0. || ends_within(reach));
            for (const unsigned int q : values.quadrature_point_indices())
              {
                Kernel here;
                add(here, values.quadrature_point(q), values.JxW(q));
                for (unsigned int p = 0; p < of_cell.size(); ++p)
                  of_cell[p].add(values.shape_value(p, q), here);
              }
          }
        kernels.insert(kernels.end(), of_cell.begin(), of_cell.end());
      }
  }



  void
  InteractionIntegral::balance()
  {
    const MPI_Comm communicator = body.space.communicator();
    const auto     is_at_tip    = [&](const Kernel &kernel) {
      return region.reach(points.cell[kernel.point]).first == 0.;
    };
    VoigtVector<2> sum;
    double         area = 0.;
    for (const Kernel &kernel : kernels)
      {
        sum += kernel.field.of_strain;
        if (is_at_tip(kernel))
          area += points.weight[kernel.point];
      }
    for (unsigned int c = 0; c < QuadratureField<2>::n_components; ++c)
      sum[c] = Utilities::MPI::sum(sum[c], communicator);
    area = Utilities::MPI::sum(area, communicator);
    for (Kernel &kernel : kernels)
      if (is_at_tip(kernel))
        kernel.field.of_strain -= points.weight[kernel.point] / area * sum;
  }



  double
  InteractionIntegral::of_body_force(const double t, const double kappa) const
  {
    double sum = 0.;
    for (const auto &[d, force] : body_force)
      for (const Kernel &kernel : kernels)
        sum +=
          (kernel.field.of_force[0][d] + kappa * kernel.field.of_force[1][d]) *
          force.value(points.location[kernel.point], t);
    return 4. / (kappa + 1.) * sum;
  }



  double
  InteractionIntegral::of_uniform_body(
    const Vector              &stress,
    const std::vector<double> &contact_forces,
    const double               kappa) const
  {
    double sum = 0.;
    for (const Kernel &kernel : kernels)
      {
        const VoigtVector<2> s = QuadratureField<2>::get(
          stress, kernel.point * QuadratureField<2>::n_components);
        sum += kernel.field.of_stress[0] * s +
               kappa * (kernel.field.of_stress[1] * s);
      }
    sum *= 4. / (kappa + 1.);
    for (std::size_t i = 0; i < of_contact_forces.size(); ++i)
      sum += of_contact_forces[i] * contact_forces[i];
    return Utilities::MPI::sum(sum, body.space.communicator());
  }



  double
  InteractionIntegral::value(const double            t,
                             const Sample           &sample,
                             const MaterialState<2> &material,
                             const PlaneElasticity  &at_tip) const
  {
    using Field         = QuadratureField<2>;
    const double      k = material.stiffness_factor;
    const InPlane     tip_law(at_tip);
    const std::size_t n_branches =
      sample.viscous_strain.size() > 0 ? material.fractions.size() : 0;

    double of_strain = 0.;
    for (const Kernel &kernel : kernels)
      {
        const std::size_t    offset = kernel.point * Field::n_components;
        const VoigtVector<2> s      = Field::get(sample.state.stress, offset);
        const InPlane        law((*material.stiffness)[kernel.point]);
        VoigtVector<2>       strain = (law.strain(s) - tip_law.strain(s)) / k;
        if (material.thermal_strain != nullptr)
          strain += law.free_strain((*material.thermal_strain)[kernel.point]);
        of_strain += kernel.field.of_strain * strain;
        for (unsigned int i = 0; i < n_branches; ++i)
          of_strain += material.fractions[i] *
                       (kernel.of_viscous_strain *
                        law.free_strain(Field::get(sample.viscous_strain,
                                                   offset * n_branches +
                                                     i * Field::n_components)));
      }
    const double of_variation =
      k * at_tip.modulus() * of_strain + of_body_force(t, at_tip.kappa());
    return of_uniform_body(sample.state.stress,
                           sample.state.contact_forces,
                           at_tip.kappa()) -
           Utilities::MPI::sum(of_variation, body.space.communicator());
  }
} // namespace Crevasse
