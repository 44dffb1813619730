// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/range.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/material_field.h>
#include <crevasse/material/voigt_matrix.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    std::string
    describe(const Place<dim> &place)
    {
      return "at " + Text::from_point(place.point) +
             ", t = " + Text::from_number(place.t) +
             " (theta = " + Text::from_number(place.temperature) +
             ", material = " + std::to_string(place.material) + ")";
    }



    /** The parameters that free strains come from. */
    template <typename FreeStrains>
    std::string
    names_of(const FreeStrains &strains)
    {
      std::string names;
      bool        are_thermal = false;
      for (const auto *strain : strains)
        {
          names += (names.empty() ? "" : ", ") +
                   strain->value.formulas.front().parameter();
          are_thermal = are_thermal || strain->is_thermal;
        }
      return names + (are_thermal ? " and [Loads] Temperature" : "");
    }



    /** No more than the mean over the period of what has these values at these
     * instants: of each interval the lesser of its ends, beside a jump too. */
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
  template <typename Value>
  void
  MaterialField<dim>::find_miss(const Property<Value> &property,
                                const double           t,
                                unsigned int          &n_checked,
                                Miss                  &worst) const
  {
    const bool          with_temperature = property.depends_on("theta");
    std::vector<double> values, last_values;
    const std::size_t n = varies_in_space(property) ? n_points : std::size_t(1);
    for (std::size_t p = 0; p < n; ++p)
      {
        const Place<dim> here = place(p, t, with_temperature);
        property.evaluate(here, values);
        if (values == last_values)
          continue;
        last_values = values;
        for (unsigned int i = 0; i < property.requirements.size(); ++i)
          {
            const auto  &requirement = property.requirements[i];
            const double excess      = requirement.excess(values);
            if (excess > 0. &&
                (n_checked + i < worst.requirement ||
                 (n_checked + i == worst.requirement && excess > worst.excess)))
              worst = {n_checked + i,
                       excess,
                       requirement.name + ": " + requirement.shown + ' ' +
                         Text::from_number(requirement.actual(values)) + ' ' +
                         describe(here) + "; " + requirement.range.text() +
                         '.'};
          }
      }
    n_checked += property.requirements.size();
  }



  template <int dim>
  void
  MaterialField<dim>::check_requirements(
    const std::vector<double> &instants) const
  {
    Miss       worst;
    const bool varies = stiffness_varies() || fluidity_varies();
    collectively(communicator, [&]() {
      for (const double t : instants)
        {
          unsigned int n_checked = 0;
          find_miss(law.stiffness(), t, n_checked, worst);
          for (const auto &branch : law.branches())
            find_miss(branch.fluidity, t, n_checked, worst);
          if (!varies)
            break;
        }
    });
    // Of all ranks, that which misses the same requirement most speaks.
    const unsigned int first =
      Utilities::MPI::min(worst.requirement, communicator);
    const double excess =
      Utilities::MPI::max(worst.requirement == first ? worst.excess : 0.,
                          communicator);
    collectively(communicator, [&]() {
      if (excess > 0. && worst.requirement == first && worst.excess == excess)
        throw SceneError(worst.message);
    });
  }



  template <int dim>
  RelaxationRates
  MaterialField<dim>::extreme_rates(const MaterialState<dim> &state) const
  {
    RelaxationRates all{std::numeric_limits<double>::infinity(), 0., true};
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
  MaterialField<dim>::validate_and_bound(const std::vector<double> &instants,
                                         const double period) const
  {
    constexpr double   infinity = std::numeric_limits<double>::infinity();
    MaterialState<dim> factors;
    for (const double t : instants)
      set_factors(t, factors);
    check_requirements(instants);
    if (law.branches().empty())
      return {infinity, infinity, infinity, 1., false};

    const bool          rates_vary = stiffness_varies() || fluidity_varies();
    RelaxationRates     now, all{infinity, 0., true};
    std::vector<double> least_rates, fluidity_factors; // of all instants
    for (const double t : instants)
      {
        if (rates_vary || t == instants.front())
          {
            const MaterialState<dim> state = at(t);
            collectively(communicator, [&]() { now = extreme_rates(state); });
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
    all.largest             = Utilities::MPI::max(all.largest, communicator);
    const double mean_least = lower_mean(instants, least_rates, period);
    const bool   relaxes =
      Utilities::MPI::min(all.all ? 1 : 0, communicator) == 1;
    return {all.largest > 0. ? 1. / all.largest : infinity,
            std::isfinite(all.least) ? 1. / all.least : infinity,
            std::isfinite(mean_least) ? 1. / mean_least : infinity,
            lower_mean(instants, fluidity_factors, period),
            relaxes};
  }



  template <int dim>
  double
  MaterialField<dim>::largest_thermal_strain(
    const std::vector<double> &instants) const
  {
    if (!has_thermal_strain())
      return 0.;
    double largest = 0.;
    collectively(communicator, [&]() {
      for (const double t : instants)
        {
          const std::shared_ptr<const Vectors> strains =
            thermal_strain_varies() ? evaluate_thermal_strain(t)
                                    : constant.thermal_strain;
          const std::size_t n =
            strains->is_uniform() ? std::size_t(1) : n_points;
          for (std::size_t p = 0; p < n; ++p)
            {
              for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
                largest = std::max(largest, std::abs((*strains)[p][i]));
              if (!(largest <= Ranges::largest))
                throw SceneError(
                  names_of(free_strains) + ": the thermal strain is " +
                  Text::from_number(largest) + ' ' +
                  describe(place(p, t, true)) +
                  "; it must be at most 1e70, and the theory of small strains "
                  "is for much less than 1.");
            }
          if (!thermal_strain_varies())
            break;
        }
    });
    return Utilities::MPI::max(largest, communicator);
  }



  template void
  MaterialField<2>::check_requirements(const std::vector<double> &) const;
  template void
  MaterialField<3>::check_requirements(const std::vector<double> &) const;
  template RelaxationTimes
  MaterialField<2>::validate_and_bound(const std::vector<double> &,
                                       const double) const;
  template RelaxationTimes
  MaterialField<3>::validate_and_bound(const std::vector<double> &,
                                       const double) const;
  template double
  MaterialField<2>::largest_thermal_strain(const std::vector<double> &) const;
  template double
  MaterialField<3>::largest_thermal_strain(const std::vector<double> &) const;
} // namespace Crevasse
