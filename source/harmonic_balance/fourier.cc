// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/harmonic_balance/fourier.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Relative size below which a (mean) contact force counts as rounding. */
    constexpr double smallest_force = 1e-10;



    /** Marks the bounds that bear a mean force. Collective.
     *
     * @param size of the forces: much smaller forces are rounding. */
    std::vector<bool>
    loaded_bounds(const SecularFlow      *flow,
                  const UnilateralBounds &bounds,
                  const double            size,
                  const MPI_Comm          communicator)
    {
      std::vector<bool> loaded(bounds.dofs.size(), false);
      if (flow == nullptr)
        return loaded;
      double largest = size;
      for (const double force : flow->contact_forces.normal)
        largest = std::max(largest, force);
      largest = Utilities::MPI::max(largest, communicator);
      for (unsigned int k = 0; k < loaded.size(); ++k)
        loaded[k] = flow->contact_forces.normal[k] > smallest_force * largest;
      return loaded;
    }



    /** Number of instants at which each node that is ever closed bears a force.
     */
    std::vector<unsigned int>
    count_instants(const PeriodicContactSolution &contact)
    {
      double largest = 0.;
      for (const auto &forces : contact.forces)
        largest = std::max(largest, double(forces.linfty_norm()));
      std::vector<unsigned int> counts(contact.offsets.size(), 0);
      for (const auto &forces : contact.forces)
        for (unsigned int i = 0; i < counts.size(); ++i)
          counts[i] += forces(i) > smallest_force * largest ? 1 : 0;
      counts.erase(std::remove(counts.begin(), counts.end(), 0), counts.end());
      return counts;
    }



    /** Replaces a compliance by its real part, for the last of an even N. */
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
  Fourier<dim>::Fourier(const Body<dim> &body,
                        const Harmonics &harmonics,
                        LinearSolver    &linear_solver)
    : body(body)
    , harmonics(harmonics)
    , linear_solver(linear_solver)
    , material(body.material.at(0.))
    , bounds(unilateral_bounds(body.lip, body.space))
    , lip(body.space.communicator(),
          bounds,
          std::vector<bool>(bounds.dofs.size(), true))
    , load(harmonics.n_instants)
  {
    for (unsigned int j = 0; j < load.size(); ++j)
      {
        body.strain_operator.initialize(load[j]);
        body.loads.evaluate(harmonics.instant(j), load[j]);
        largest_load = std::max(largest_load, load[j].linfty_norm());
      }
    harmonics.analyse(load);

    using Field = QuadratureField<dim>;
    if (!body.material.has_free_strain())
      return;
    const bool varies = body.material.free_strain_varies();
    thermal_strain.resize(varies ? harmonics.n_instants : 1);
    for (unsigned int j = 0; j < thermal_strain.size(); ++j)
      {
        const auto strain = body.material.at(harmonics.instant(j)).free_strain;
        body.points.initialize(thermal_strain[j]);
        for (std::size_t p = 0; p < body.points.n_local_points; ++p)
          Field::set(thermal_strain[j], p * Field::n_components, (*strain)[p]);
      }
    if (varies)
      harmonics.analyse(thermal_strain);
  }



  template <int dim>
  PeriodicMotion
  Fourier<dim>::solve(const SecularFlow   *flow,
                      const ContactMethod &solve_contact,
                      const double         memory) const
  {
    const MPI_Comm communicator = body.space.communicator();
    const LipPart  part(
      communicator,
      bounds,
      has_spring()
         ? std::vector<bool>(bounds.dofs.size(), true)
         : loaded_bounds(flow, bounds, load[0].linfty_norm(), communicator));
    HarmonicResponses<dim> responses(
      body, material, linear_solver, part, memory);

    PeriodicMotion motion;
    motion.displacement = load;
    motion.contact_forces.assign(harmonics.n_instants,
                                 std::vector<double>(bounds.dofs.size()));
    PeriodicContactProblem problem = respond(responses, part, motion);
    dealii::Vector<double> offsets(part.n_nodes());
    if (part.n_nodes() > 0)
      {
        problem.mean_forces                   = flow == nullptr
                                                  ? dealii::Vector<double>(part.n_nodes())
                                                  : part.gather(flow->contact_forces.normal);
        const PeriodicContactSolution contact = solve_contact(problem);
        motion.instants_of_contact            = count_instants(contact);
        add_contact(contact, responses, part, motion);
        offsets = contact.offsets;
      }

    Vector model;
    body.points.initialize(model, material.fluidity.size());
    motion.viscous_strain = harmonics.zero(model);
    for (unsigned int n = 1; n <= harmonics.n_harmonics(); ++n)
      find_viscous_strain(n, motion);
    if (!has_spring())
      motion.displacement[0] = 0.;
    if (lip.n_nodes() > 0 && !has_spring())
      find_mean_displacement(mean_on_lip(part, offsets, motion),
                             motion.displacement[0]);
    find_mean_viscous_strain(flow, motion);
    harmonics.synthesise(motion.displacement);
    harmonics.synthesise(motion.viscous_strain);
    motion.complex_factorisations = responses.n_factorisations;
    return motion;
  }



  template <int dim>
  VoigtVector<dim, std::complex<double>>
  Fourier<dim>::thermal_harmonic(const unsigned int n,
                                 const std::size_t  offset) const
  {
    VoigtVector<dim, Complex> strain;
    if (thermal_strain.size() > (n == 0 ? 0 : 1))
      for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
        strain[c] = {thermal_strain[real_part(n)].local_element(offset + c),
                     n == 0 ? 0.
                            : thermal_strain[2 * n].local_element(offset + c)};
    return strain;
  }



  template <int dim>
  void
  Fourier<dim>::add_thermal_load(const unsigned int        n,
                                 const ComplexModuli<dim> &moduli,
                                 Vector                   &real,
                                 Vector                   &imaginary) const
  {
    if (thermal_strain.size() <= (n == 0 ? 0 : 1))
      return;
    for (Vector *const load : {&real, &imaginary})
      body.strain_operator.add_transpose(*load, [&](const std::size_t offset) {
        const VoigtVector<dim, Complex> stress =
          moduli.sum[offset / n_stress_components<dim>] *
          thermal_harmonic(n, offset);
        VoigtVector<dim> result;
        for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
          result[c] = material.stiffness_factor *
                      (load == &real ? stress[c].real() : stress[c].imag());
        return result;
      });
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
    auto   openings = harmonics.zero(dealii::Vector<double>(part.n_nodes()));
    Vector none(load[0]); // imaginary part of the mean
    none = 0.;
    for (unsigned int n = first_harmonic(); n <= harmonics.n_harmonics(); ++n)
      {
        const ComplexModuli<dim> K    = moduli(n);
        Vector                  &real = motion.displacement[real_part(n)];
        Vector &imaginary = n == 0 ? none : motion.displacement[2 * n];
        add_thermal_load(n, K, real, imaginary);
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

        const HarmonicResponse response = responses.at(n, K);
        if (is_loaded)
          {
            real /= material.stiffness_factor;
            imaginary /= material.stiffness_factor;
            response.solve(real, imaginary);
          }
        openings[real_part(n)]                  = part.restrict_to_lip(real);
        PeriodicContactProblem::Compliance unit = response.compliance;
        unit.factor /= material.stiffness_factor;
        if (n == 0)
          {
            for (unsigned int i = 0; i < part.n_nodes(); ++i)
              openings[0](i) -= part.nodes.gap[i];
            problem.mean_compliance = unit;
            continue;
          }
        openings[2 * n] = part.restrict_to_lip(imaginary);
        problem.compliances.push_back(unit);
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
    const double factor = 1. / material.stiffness_factor;
    Vector       real(load[0]), imaginary(load[0]);
    for (unsigned int n = first_harmonic(); n <= harmonics.n_harmonics(); ++n)
      {
        real      = 0.;
        imaginary = 0.;
        part.add_forces(factor, forces[real_part(n)], real);
        if (n > 0)
          part.add_forces(factor, forces[2 * n], imaginary);
        responses.at(n, moduli(n)).solve(real, imaginary);
        motion.displacement[real_part(n)] += real;
        if (n > 0)
          motion.displacement[2 * n] += imaginary;
      }
  }



  template <int dim>
  void
  Fourier<dim>::find_viscous_strain(const unsigned int n,
                                    PeriodicMotion    &motion) const
  {
    using Field                         = QuadratureField<dim>;
    const unsigned int       n_branches = material.fluidity.size();
    const ComplexModuli<dim> K          = moduli(n);
    Vector                  &real       = motion.viscous_strain[2 * n - 1];
    Vector                  &imaginary  = motion.viscous_strain[2 * n];

    Vector strain_real;
    body.points.initialize(strain_real);
    body.strain_operator.for_each_strain(
      motion.displacement[2 * n - 1],
      [&](const std::size_t offset, const VoigtVector<dim> &strain) {
        Field::set(strain_real, offset, strain);
      });
    body.strain_operator.for_each_strain(
      motion.displacement[2 * n],
      [&](const std::size_t offset, const VoigtVector<dim> &strain_imaginary) {
        const std::size_t         point  = offset / Field::n_components;
        VoigtVector<dim, Complex> strain = -thermal_harmonic(n, offset);
        for (unsigned int c = 0; c < Field::n_components; ++c)
          strain[c] +=
            Complex(strain_real.local_element(offset + c), strain_imaginary[c]);
        for (unsigned int i = 0; i < n_branches; ++i)
          {
            const VoigtVector<dim, Complex> r =
              kappa(n) * ((*material.fluidity[i])[point] *
                          (K.branches[i][point] * strain));
            const std::size_t place =
              offset * n_branches + i * Field::n_components;
            for (unsigned int c = 0; c < Field::n_components; ++c)
              {
                real.local_element(place + c)      = r[c].real();
                imaginary.local_element(place + c) = r[c].imag();
              }
          }
      });
  }



  template class Fourier<2>;
  template class Fourier<3>;
} // namespace Crevasse
