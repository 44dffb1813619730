// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/harmonic_balance/fourier.h>
#include <crevasse/material/voigt_matrix.h>
#include <crevasse/model/secular.h>

#include <deal.II/lac/linear_operator.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>


namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  dealii::Vector<double>
  Fourier<dim>::mean_on_lip(const LipPart                &part,
                            const dealii::Vector<double> &offsets,
                            const PeriodicMotion         &motion) const
  {
    auto values = harmonics.zero(dealii::Vector<double>(lip.n_nodes()));
    for (unsigned int k = 1; k < values.size(); ++k)
      values[k] = lip.restrict_to_lip(motion.displacement[k]);
    harmonics.synthesise(values);

    dealii::Vector<double> ones(part.n_nodes());
    std::fill(ones.begin(), ones.end(), 1.); // perhaps of no node
    const auto is_in_part = lip.gather(part.scatter(ones));
    auto       mean       = lip.gather(part.scatter(offsets));
    for (unsigned int i = 0; i < mean.size(); ++i)
      {
        // A node that bears no mean force is never pressed: it just touches.
        double least = std::numeric_limits<double>::max();
        for (const dealii::Vector<double> &value : values)
          least = std::min(least, value(i));
        mean(i) = lip.nodes.gap[i] + (is_in_part(i) > 0. ? mean(i) : -least);
      }
    return mean;
  }



  template <int dim>
  void
  Fourier<dim>::find_mean_displacement(const dealii::Vector<double> &on_lip,
                                       Vector                       &mean) const
  {
    mean = 0.;
    if (on_lip.size() == 0 || on_lip.linfty_norm() == 0.)
      return;
    // The displacement of least energy is that of forces at the lip,
    // A⁻¹ Lᵀ g: a back-solve for each product with L A⁻¹ Lᵀ. A slow material
    // remembers it for many periods, so that results would show how rounding
    // ended the iteration.
    constexpr double accuracy = 1e-13, accuracy_of_product = 1e-12;
    Vector           loads(mean);
    const auto       displace = [&](const LipVector &forces) {
      loads = 0.;
      mean  = 0.;
      lip.add_forces(1., forces, loads);
      linear_solver.solve(mean, loads, accuracy_of_product * forces.l2_norm());
    };
    dealii::LinearOperator<LipVector> compliance;
    compliance.vmult = [&](LipVector &opening, const LipVector &forces) {
      displace(forces);
      opening = lip.restrict_to_lip(mean);
    };
    LipVector              forces(lip.n_nodes());
    IterationNumberControl control(10 * lip.n_nodes() + 100,
                                   accuracy * on_lip.l2_norm());
    SolverCG<LipVector>(control).solve(compliance,
                                       forces,
                                       on_lip,
                                       PreconditionIdentity());
    displace(forces);
    // Exactly what is given there.
    LipVector rest(on_lip);
    rest -= lip.restrict_to_lip(mean);
    lip.add_forces(1., rest, mean);
  }



  template <int dim>
  void
  Fourier<dim>::find_mean_viscous_strain(const SecularFlow *flow,
                                         PeriodicMotion    &motion) const
  {
    using Field                   = QuadratureField<dim>;
    const unsigned int n_branches = material.fluidity.size();
    const std::size_t  n_points   = body.points.n_local_points;
    const double       stress_factor =
      material.viscosity_factor / material.stiffness_factor;

    // What is unstrained elastically: (k wᵢ K)⁻¹ s̄ᵢ.
    std::optional<Viscosity<dim>>                viscosity;
    std::optional<PointValues<VoigtMatrix<dim>>> compliance;
    if (flow != nullptr)
      {
        viscosity.emplace(body, material);
        compliance = transform(*material.stiffness, n_points, inverse<dim>);
      }

    body.strain_operator.for_each_strain(
      motion.displacement[0],
      [&](const std::size_t offset, VoigtVector<dim> strain) {
        const std::size_t point = offset / Field::n_components;
        if (!thermal_strain.empty())
          strain -= Field::get(thermal_strain[0], offset);
        for (unsigned int i = 0; i < n_branches; ++i)
          {
            const std::size_t place =
              offset * n_branches + i * Field::n_components;
            VoigtVector<dim> r = strain;
            if (flow != nullptr)
              r -=
                stress_factor / material.fractions[i] *
                ((*compliance)[point] * (viscosity->branches[i][point] *
                                         Field::get(flow->strain_rate, place)));
            if (material.plane_stress)
              r[voigt_index<dim>(2, 2)] = 0.; // nothing asks for it
            Field::set(motion.viscous_strain[0], place, r);
          }
      });
  }



#define INSTANTIATE(dim)                                                     \
  template dealii::Vector<double> Fourier<dim>::mean_on_lip(                 \
    const LipPart &, const dealii::Vector<double> &, const PeriodicMotion &) \
    const;                                                                   \
  template void Fourier<dim>::find_mean_displacement(                        \
    const dealii::Vector<double> &, Vector &) const;                         \
  template void Fourier<dim>::find_mean_viscous_strain(const SecularFlow *,  \
                                                       PeriodicMotion &) const

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
