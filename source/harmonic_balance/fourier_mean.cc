// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/harmonic_balance/fourier.h>
#include <crevasse/material/voigt_matrix.h>
#include <crevasse/model/secular.h>

#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** L A⁻¹ Lᵀ, by a back-solve for each product. */
    class LipCompliance
    {
    public:
      LipCompliance(const LipPart &lip,
                    LinearSolver  &linear_solver,
                    const Vector  &model)
        : lip(lip)
        , linear_solver(linear_solver)
        , loads(model)
        , solution(model)
      {
      }

      /** A⁻¹ Lᵀ g */
      const Vector &
      displacement(const dealii::Vector<double> &forces) const
      {
        constexpr double accuracy = 1e-12;
        loads                     = 0.;
        lip.add_forces(1., forces, loads);
        solution = 0.;
        linear_solver.solve(solution, loads, accuracy * forces.l2_norm());
        return solution;
      }

      void
      vmult(dealii::Vector<double>       &on_lip,
            const dealii::Vector<double> &forces) const
      {
        on_lip = lip.restrict_to_lip(displacement(forces));
      }

    private:
      const LipPart &lip;
      LinearSolver  &linear_solver;
      mutable Vector loads, solution;
    };
  } // namespace



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

    std::map<types::global_dof_index, double> offset_of;
    for (unsigned int i = 0; i < part.n_nodes(); ++i)
      offset_of[part.dofs()[i]] = offsets(i);
    dealii::Vector<double> mean(lip.n_nodes());
    for (unsigned int i = 0; i < mean.size(); ++i)
      if (const auto found = offset_of.find(lip.dofs()[i]);
          found != offset_of.end())
        mean(i) = lip.gaps()[i] + found->second;
      else
        {
          // A node that bears no mean force is never pressed: it just touches.
          double least = std::numeric_limits<double>::max();
          for (const dealii::Vector<double> &value : values)
            least = std::min(least, value(i));
          mean(i) = lip.gaps()[i] - least;
        }
    return mean;
  }



  template <int dim>
  void
  Fourier<dim>::find_mean_displacement(const dealii::Vector<double> &on_lip,
                                       Vector                       &mean) const
  {
    mean = 0.;
    if (on_lip.linfty_norm() == 0.)
      return;
    // The displacement of least energy is that of forces at the lip. A slow
    // material remembers it for many periods, so that results would show how
    // rounding ended the iteration.
    constexpr double       accuracy = 1e-13;
    const LipCompliance    compliance(lip, parts.linear_solver, mean);
    dealii::Vector<double> forces(lip.n_nodes());
    IterationNumberControl control(10 * lip.n_nodes() + 100,
                                   accuracy * on_lip.l2_norm());
    SolverCG<dealii::Vector<double>>(control).solve(compliance,
                                                    forces,
                                                    on_lip,
                                                    PreconditionIdentity());
    mean = compliance.displacement(forces);
    lip.prescribe(on_lip, mean);
  }



  template <int dim>
  void
  Fourier<dim>::find_mean_viscous_strain(const SecularFlow *flow,
                                         PeriodicMotion    &motion) const
  {
    using Field                   = QuadratureField<dim>;
    const unsigned int n_branches = material.fluidity.size();
    const std::size_t  n_points   = parts.points.n_local_points();
    const double       stress_factor =
      material.viscosity_factor / material.stiffness_factor;

    // What is unstrained elastically: (k wᵢ K)⁻¹ s̄ᵢ.
    std::optional<Viscosity<dim>>                viscosity;
    std::optional<PointValues<VoigtMatrix<dim>>> compliance;
    if (flow != nullptr)
      collectively(parts.space.communicator(), [&]() {
        viscosity = viscosity_of<dim>(material, n_points);
        compliance =
          transform(*material.stiffness,
                    n_points,
                    [](const VoigtMatrix<dim> &K) { return inverse<dim>(K); });
      });

    parts.strain_operator.for_each_strain(
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
