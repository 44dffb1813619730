// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/harmonic_balance/fourier.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Where only real forces and real parts of openings are seen. */
    void
    make_real(PeriodicContactProblem::Compliance &compliance)
    {
      auto matrix =
        std::make_shared<FullMatrix<std::complex<double>>>(*compliance.matrix);
      for (unsigned int i = 0; i < matrix->m(); ++i)
        for (unsigned int j = 0; j < matrix->n(); ++j)
          (*matrix)(i, j) = (compliance.factor * (*matrix)(i, j)).real();
      compliance = {matrix, 1.};
    }
  } // namespace



  template <int dim>
  ComplexVoigtVector<dim>
  Fourier<dim>::thermal_harmonic(const unsigned int n,
                                 const std::size_t  offset) const
  {
    ComplexVoigtVector<dim> strain;
    if (thermal_strain.size() > 1)
      for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
        strain[c] = {thermal_strain[2 * n - 1].local_element(offset + c),
                     thermal_strain[2 * n].local_element(offset + c)};
    return strain;
  }



  template <int dim>
  void
  Fourier<dim>::add_thermal_load(const unsigned int        n,
                                 const ComplexModuli<dim> &moduli,
                                 std::vector<Vector>      &loads) const
  {
    if (thermal_strain.size() <= 1)
      return;
    const auto add = [&](Vector &loads, const auto &part) {
      parts.strain_operator.add_transpose(loads, [&](const std::size_t offset) {
        const ComplexVoigtVector<dim> stress =
          moduli.sum[offset / n_stress_components<dim>] *
          thermal_harmonic(n, offset);
        VoigtVector<dim> result;
        for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
          result[c] = material.stiffness_factor * part(stress[c]);
        return result;
      });
    };
    add(loads[2 * n - 1], [](const Complex z) { return z.real(); });
    add(loads[2 * n], [](const Complex z) { return z.imag(); });
  }



  template <int dim>
  PeriodicContactProblem
  Fourier<dim>::respond(HarmonicResponses<dim> &responses,
                        const LipPart          &part,
                        PeriodicMotion         &motion) const
  {
    constexpr double rounding = 1e-13;
    double           largest  = 0.;
    for (const Vector &coefficient : load)
      largest = std::max(largest, coefficient.linfty_norm());

    PeriodicContactProblem problem;
    auto openings = harmonics.zero(dealii::Vector<double>(part.n_nodes()));
    for (unsigned int n = 1; n <= harmonics.n_harmonics(); ++n)
      {
        const ComplexModuli<dim> K         = moduli(n);
        Vector                  &real      = motion.displacement[2 * n - 1];
        Vector                  &imaginary = motion.displacement[2 * n];
        add_thermal_load(n, K, motion.displacement);
        const double size =
          std::max(real.linfty_norm(), imaginary.linfty_norm());
        largest              = std::max(largest, size);
        const bool is_loaded = size > rounding * largest;
        motion.loaded_harmonics += is_loaded ? 1 : 0;
        if (!is_loaded)
          {
            real      = 0.;
            imaginary = 0.;
          }
        if (!is_loaded && part.n_nodes() == 0)
          continue;

        const auto response = responses.at(n, K);
        if (is_loaded)
          {
            real /= material.stiffness_factor;
            imaginary /= material.stiffness_factor;
            response->solve(real, imaginary);
          }
        openings[2 * n - 1] = part.restrict_to_lip(real);
        openings[2 * n]     = part.restrict_to_lip(imaginary);
        problem.compliances.push_back(response->compliance());
        problem.compliances.back().factor /= material.stiffness_factor;
        if (harmonics.is_real(n))
          make_real(problem.compliances.back());
      }
    harmonics.synthesise(openings);
    problem.openings_without_contact = std::move(openings);
    return problem;
  }



  template <int dim>
  void
  Fourier<dim>::add_contact(const PeriodicContactSolution &contact,
                            HarmonicResponses<dim>        &responses,
                            const LipPart                 &part,
                            PeriodicMotion                &motion) const
  {
    for (unsigned int j = 0; j < contact.forces.size(); ++j)
      motion.contact_forces[j] = part.scatter(contact.forces[j]);
    auto forces = contact.forces;
    harmonics.analyse(forces);
    Vector real(load[0]), imaginary(load[0]);
    for (unsigned int n = 1; n <= harmonics.n_harmonics(); ++n)
      {
        real      = 0.;
        imaginary = 0.;
        part.add_forces(1. / material.stiffness_factor,
                        forces[2 * n - 1],
                        real);
        part.add_forces(1. / material.stiffness_factor,
                        forces[2 * n],
                        imaginary);
        responses.at(n, moduli(n))->solve(real, imaginary);
        motion.displacement[2 * n - 1] += real;
        motion.displacement[2 * n] += imaginary;
      }
  }



  template <int dim>
  void
  Fourier<dim>::find_viscous_strain(const unsigned int n,
                                    PeriodicMotion    &motion) const
  {
    using Field                          = QuadratureField<dim>;
    const unsigned int       n_branches  = material.fluidity.size();
    const Vector            &q_real      = motion.displacement[2 * n - 1];
    const Vector            &q_imaginary = motion.displacement[2 * n];
    const ComplexModuli<dim> K           = moduli(n);
    const Complex factor = harmonics.integral(n) * material.stiffness_factor /
                           material.viscosity_factor;

    Vector strain_real;
    parts.points.initialize(strain_real);
    parts.strain_operator.for_each_strain(
      q_real, [&](const std::size_t offset, const VoigtVector<dim> &strain) {
        Field::set(strain_real, offset, strain);
      });
    parts.strain_operator.for_each_strain(
      q_imaginary,
      [&](const std::size_t offset, const VoigtVector<dim> &imaginary) {
        const std::size_t       point  = offset / Field::n_components;
        ComplexVoigtVector<dim> strain = -thermal_harmonic(n, offset);
        for (unsigned int c = 0; c < Field::n_components; ++c)
          strain[c] +=
            Complex(strain_real.local_element(offset + c), imaginary[c]);
        for (unsigned int i = 0; i < n_branches; ++i)
          {
            const ComplexVoigtVector<dim> r =
              factor * ((*material.fluidity[i])[point] *
                        (K.branches[i][point] * strain));
            const std::size_t place =
              offset * n_branches + i * Field::n_components;
            for (unsigned int c = 0; c < Field::n_components; ++c)
              {
                motion.viscous_strain[2 * n - 1].local_element(place + c) =
                  r[c].real();
                motion.viscous_strain[2 * n].local_element(place + c) =
                  r[c].imag();
              }
          }
      });
  }



#define INSTANTIATE(dim)                                                   \
  template PeriodicContactProblem Fourier<dim>::respond(                   \
    HarmonicResponses<dim> &, const LipPart &, PeriodicMotion &) const;    \
  template void Fourier<dim>::add_contact(const PeriodicContactSolution &, \
                                          HarmonicResponses<dim> &,        \
                                          const LipPart &,                 \
                                          PeriodicMotion &) const;         \
  template void Fourier<dim>::find_viscous_strain(const unsigned int,      \
                                                  PeriodicMotion &) const

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
