// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/harmonic_balance/fourier.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** A mean force, or the force of an instant, that is more than rounding. */
    constexpr double smallest_force = 1e-10;



    /** Those bounds that bear a mean force. Collective.
     *
     * @param size of the forces: what is far below it is rounding. */
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
      for (const double force : flow->contact_forces)
        largest = std::max(largest, force);
      largest = Utilities::MPI::max(largest, communicator);
      for (unsigned int k = 0; k < loaded.size(); ++k)
        loaded[k] = flow->contact_forces[k] > smallest_force * largest;
      return loaded;
    }



    /** At how many instants each node bears a force. */
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
      return counts;
    }
  } // namespace



  template <int dim>
  Fourier<dim>::Fourier(const Parts &parts, const Harmonics &harmonics)
    : parts(parts)
    , harmonics(harmonics)
    , material(parts.material.at(0.))
    , lip(parts.space.communicator(),
          parts.bounds,
          std::vector<bool>(parts.bounds.dofs.size(), true))
  {
    sample_loads();
    if (parts.material.has_thermal_strain())
      sample_thermal_strain();
  }



  template <int dim>
  void
  Fourier<dim>::sample_loads()
  {
    load.resize(harmonics.n_instants());
    for (unsigned int j = 0; j < load.size(); ++j)
      {
        parts.strain_operator.initialize(load[j]);
        parts.loads.evaluate(harmonics.instant(j), load[j]);
        largest_load = std::max(largest_load, load[j].linfty_norm());
      }
    harmonics.analyse(load);
  }



  template <int dim>
  void
  Fourier<dim>::sample_thermal_strain()
  {
    using Field       = QuadratureField<dim>;
    const bool varies = parts.material.thermal_strain_varies();
    thermal_strain.resize(varies ? harmonics.n_instants() : 1);
    for (unsigned int j = 0; j < thermal_strain.size(); ++j)
      {
        const auto strain =
          parts.material.at(harmonics.instant(j)).thermal_strain;
        parts.points.initialize(thermal_strain[j]);
        for (std::size_t p = 0; p < parts.points.n_local_points(); ++p)
          Field::set(thermal_strain[j], p * Field::n_components, (*strain)[p]);
      }
    if (varies)
      harmonics.analyse(thermal_strain);
  }



  template <int dim>
  Vector
  Fourier<dim>::mean_load() const
  {
    Vector mean = load[0];
    mean /= material.viscosity_factor;
    return mean;
  }



  template <int dim>
  double
  Fourier<dim>::negligible_load() const
  {
    constexpr double rounding = 1e-12;
    return rounding * largest_load / material.viscosity_factor;
  }



  template <int dim>
  PeriodicMotion
  Fourier<dim>::solve(const SecularFlow   *flow,
                      const ContactMethod &solve_contact,
                      const double         memory) const
  {
    const MPI_Comm         communicator = parts.space.communicator();
    const LipPart          part(communicator,
                       parts.bounds,
                       loaded_bounds(flow,
                                     parts.bounds,
                                     mean_load().linfty_norm(),
                                     communicator));
    HarmonicResponses<dim> responses(
      parts.space, parts.points, material, parts.linear_solver, part, memory);

    PeriodicMotion motion;
    motion.displacement = load;
    motion.contact_forces.assign(harmonics.n_instants(),
                                 part.scatter(
                                   dealii::Vector<double>(part.n_nodes())));
    PeriodicContactProblem problem = respond(responses, part, motion);
    dealii::Vector<double> offsets(part.n_nodes());
    if (part.n_nodes() > 0)
      {
        problem.mean_forces = part.gather(flow->contact_forces);
        problem.mean_forces *= material.viscosity_factor;
        const PeriodicContactSolution contact = solve_contact(problem);
        motion.instants_of_contact            = count_instants(contact);
        add_contact(contact, responses, part, motion);
        offsets = contact.offsets;
      }

    Vector model;
    parts.points.initialize(model, material.fluidity.size());
    motion.viscous_strain = harmonics.zero(model);
    for (unsigned int n = 1; n <= harmonics.n_harmonics(); ++n)
      find_viscous_strain(n, motion);
    motion.displacement[0] = 0.;
    if (lip.n_nodes() > 0)
      find_mean_displacement(mean_on_lip(part, offsets, motion),
                             motion.displacement[0]);
    find_mean_viscous_strain(flow, motion);
    harmonics.synthesise(motion.displacement);
    harmonics.synthesise(motion.viscous_strain);
    motion.complex_factorisations = responses.n_factorisations();
    return motion;
  }



  template <int dim>
  ComplexModuli<dim>
  Fourier<dim>::moduli(const unsigned int n) const
  {
    return ComplexModuli<dim>(material,
                              harmonics.integral(n) *
                                material.stiffness_factor /
                                material.viscosity_factor,
                              parts.points.n_local_points());
  }



  template class Fourier<2>;
  template class Fourier<3>;
} // namespace Crevasse
