// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/discretisation/material_field.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Lower bound of the mean over the period of a function with these values:
     * uses the lesser end of each interval between instants, also at jumps. */
    double
    lower_mean(const std::vector<double> &instants,
               const std::vector<double> &values,
               const double               period)
    {
      double mean = 0.;
      for (std::size_t k = 0; k < instants.size(); ++k)
        {
          const bool   is_last = k + 1 == instants.size();
          const double end     = is_last ? period : instants[k + 1];
          const double value   = is_last ? values.front() : values[k + 1];
          mean += (end - instants[k]) / period * std::min(values[k], value);
        }
      return mean;
    }
  } // namespace



  template <int dim>
  RelaxationRates
  MaterialField<dim>::extreme_rates(const MaterialState<dim> &state) const
  {
    RelaxationRates all{std::numeric_limits<double>::infinity(), 0., true};
    if (state.creep != nullptr) // depends on stress
      return {std::numeric_limits<double>::infinity(), 0., false};
    for (unsigned int i = 0; i < state.fluidity.size(); ++i)
      {
        const double fraction = state.fractions[i];
        const auto   rates    = combine(*state.fluidity[i],
                                   *state.stiffness,
                                   n_points,
                                   relaxation_rates<dim>);
        for (const RelaxationRates &here : rates.distinct())
          {
            all.least   = std::min(all.least, fraction * here.least);
            all.largest = std::max(all.largest, fraction * here.largest);
            all.all     = all.all && here.all;
          }
      }
    return all;
  }



  template <int dim>
  RelaxationTimes
  MaterialField<dim>::relaxation_times(const std::vector<double> &instants,
                                       const double               period) const
  {
    constexpr double    infinity = std::numeric_limits<double>::infinity();
    MaterialState<dim>  factors;
    const bool          rates_vary = stiffness_varies || fluidity_varies;
    RelaxationRates     now, all{infinity, 0., true};
    std::vector<double> least_rates, fluidity_factors; // at all instants
    double              creep_exponent = 1.;
    for (const double t : instants)
      {
        if (rates_vary || t == instants.front())
          {
            const MaterialState<dim> state = at(t);
            collectively(communicator, [&]() { now = extreme_rates(state); });
            if (state.creep != nullptr)
              for (const CreepPoint<dim> &creep : state.creep->distinct())
                creep_exponent =
                  std::max(creep_exponent,
                           law.creep->least_exponent(creep.constants));
            now.least = Utilities::MPI::min(now.least, communicator);
          }
        set_factors(t, factors);
        const double factor =
          factors.stiffness_factor / factors.viscosity_factor;
        all.least   = std::min(all.least, now.least * factor);
        all.largest = std::max(all.largest, now.largest * factor);
        all.all     = all.all && now.all;
        least_rates.push_back(now.least * factor);
        fluidity_factors.push_back(1. / factors.viscosity_factor);
      }
    if (law.branches.empty())
      return {infinity, infinity, infinity, 1., false};
    all.largest             = Utilities::MPI::max(all.largest, communicator);
    const double mean_least = lower_mean(instants, least_rates, period);
    const bool   relaxes = !Utilities::MPI::logical_or(!all.all, communicator);
    return {all.largest > 0. ? 1. / all.largest : infinity,
            std::isfinite(all.least) ? 1. / all.least : infinity,
            std::isfinite(mean_least) ? 1. / mean_least : infinity,
            lower_mean(instants, fluidity_factors, period),
            relaxes,
            Utilities::MPI::max(creep_exponent, communicator)};
  }



  template <int dim>
  double
  MaterialField<dim>::largest_thermal_strain(
    const std::vector<double> &instants) const
  {
    if (!has_thermal_strain)
      return 0.;
    double largest = 0.;
    collectively(communicator, [&]() {
      for (const double t : instants)
        {
          const std::shared_ptr<const Vectors> strains =
            thermal_strain_varies ? evaluate_thermal_strain(t)
                                  : constant.thermal_strain;
          const std::size_t n =
            strains->is_uniform() ? std::size_t(1) : n_points;
          for (std::size_t p = 0; p < n; ++p)
            for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
              largest = std::max(largest, std::abs((*strains)[p][i]));
          if (!thermal_strain_varies)
            break;
        }
    });
    return Utilities::MPI::max(largest, communicator);
  }



  template <int dim>
  VoigtVector<dim>
  MaterialField<dim>::thermal_strain(
    const Property<VoigtVector<dim>> &expansion,
    Place<dim>                        here) const
  {
    const double     reference = temperature.reference;
    const double     origin    = law.mean_expansion_from.value_or(reference);
    VoigtVector<dim> strain = expansion.at(here) * (here.temperature - origin);
    if (origin == reference)
      return strain;
    here.temperature = reference;
    return strain -= expansion.at(here) * (reference - origin);
  }



  template <int dim>
  std::shared_ptr<const typename MaterialField<dim>::Vectors>
  MaterialField<dim>::evaluate_free_strain(
    const std::shared_ptr<const Vectors> &thermal,
    const double                          t) const
  {
    if (imposed == nullptr)
      return thermal;
    std::vector<VoigtVector<dim>> strains(n_points);
    for (std::size_t p = 0; thermal != nullptr && p < n_points; ++p)
      strains[p] = (*thermal)[p];
    imposed->add_strains(imposed->values(t), -1., strains);
    return std::make_shared<const Vectors>(std::move(strains));
  }



  template <int dim>
  std::size_t
  MaterialField<dim>::memory_of_variation(const MaterialState<dim> &state) const
  {
    std::size_t bytes = 0;
    if (stiffness_varies)
      bytes += state.stiffness->memory_consumption();
    for (unsigned int i = 0; i < fluidity_is_free.size(); ++i)
      if (fluidity_is_free[i])
        bytes += state.fluidity[i]->memory_consumption();
    if (free_strain_varies())
      bytes += state.free_strain->memory_consumption();
    if (state.creep != nullptr && constant.creep == nullptr)
      bytes += state.creep->memory_consumption();
    return bytes;
  }



  template std::size_t
  MaterialField<2>::memory_of_variation(const MaterialState<2> &) const;
  template std::size_t
  MaterialField<3>::memory_of_variation(const MaterialState<3> &) const;
  template RelaxationTimes
  MaterialField<2>::relaxation_times(const std::vector<double> &,
                                     const double) const;
  template RelaxationTimes
  MaterialField<3>::relaxation_times(const std::vector<double> &,
                                     const double) const;
  template double
  MaterialField<2>::largest_thermal_strain(const std::vector<double> &) const;
  template double
  MaterialField<3>::largest_thermal_strain(const std::vector<double> &) const;
  template VoigtVector<2>
  MaterialField<2>::thermal_strain(const Property<VoigtVector<2>> &,
                                   Place<2>) const;
  template VoigtVector<3>
  MaterialField<3>::thermal_strain(const Property<VoigtVector<3>> &,
                                   Place<3>) const;
  template std::shared_ptr<const PointValues<VoigtVector<2>>>
  MaterialField<2>::evaluate_free_strain(
    const std::shared_ptr<const PointValues<VoigtVector<2>>> &,
    const double) const;
  template std::shared_ptr<const PointValues<VoigtVector<3>>>
  MaterialField<3>::evaluate_free_strain(
    const std::shared_ptr<const PointValues<VoigtVector<3>>> &,
    const double) const;
} // namespace Crevasse
