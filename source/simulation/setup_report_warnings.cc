// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/discretisation/rigid_modes.h>
#include <crevasse/material/voigt_matrix.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/parameters/automatic.h>
#include <crevasse/parameters/effects.h>
#include <crevasse/parameters/units.h>
#include <crevasse/simulation/common_errors.h>
#include <crevasse/simulation/setup_report.h>

namespace Crevasse
{
  namespace
  {
    /** Warns of steps with which a scheme is stable, but inaccurate. */
    template <int dim>
    void
    warn_of_large_steps(const Run<dim> &run, std::vector<std::string> &all)
    {
      const TimeIntegrationParameters &time = run.scene.time_integration;
      const double                     in_relaxation_times =
        run.steps.largest_step() / run.magnitudes.relaxation_times.smallest;
      if (run.integrator == nullptr || in_relaxation_times <= 2.)
        return;
      const std::string steps = Text::Message()
                                << " with steps of " << in_relaxation_times
                                << " relaxation times";
      if (run.choice.method != PeriodicMethodType::fourier &&
          time.scheme == Scheme::trapezoid)
        all.push_back("[Time integration] Scheme = trapezoid" + steps +
                      ": stress that relaxes so fast oscillates instead of "
                      "decaying; use Scheme = sdirk2");
      if (time.scheme == Scheme::exponential &&
          time.step_control != StepControlType::adaptive)
        all.push_back(
          "[Time integration] Scheme = exponential" + steps +
          " is stable, but under given loads the body creeps by at most about "
          "one elastic strain a step; use Scheme = sdirk2");
    }



    /** Warns of sizes that no solid has in the units of the scene. */
    template <int dim>
    void
    doubt_units(const Run<dim> &run, std::vector<std::string> &all)
    {
      const Units units(run.scene.units);
      if (!units.are_known())
        return;
      double     modulus  = 0.;
      const auto material = run.body.material.at(0.);
      for (const VoigtMatrix<dim> &K : material.stiffness->distinct())
        for (unsigned int d = 0; d < dim; ++d)
          modulus = std::max(modulus, 1. / inverse<dim>(K)[d][d]);
      modulus =
        dealii::Utilities::MPI::max(modulus, run.body.space.communicator());
      for (const std::string &doubt :
           units.doubts(RigidParts<dim>(run.body.space.mesh()).size(),
                        modulus,
                        run.steps.period()))
        all.push_back(doubt);
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  warnings(const Run<dim> &run)
  {
    std::vector<std::string> all = unused_parameters(run.scene);
    all.insert(all.end(),
               run.scene.tables.warnings.begin(),
               run.scene.tables.warnings.end());
    constexpr double small = 0.1;
    if (run.magnitudes.largest_thermal_strain > small)
      all.push_back(
        Text::Message()
        << "[Material] Thermal expansion and [Loads] Temperature: the thermal "
           "strain is up to "
        << run.magnitudes.largest_thermal_strain
        << "; the theory is for strains much less than 1");
    for (const CommonError &error : common_errors(run))
      all.push_back(error.warning);
    constexpr double is_jump = 0.2;
    if (run.scene.crack_tip.creep_integral && formulas_can_jump(run.scene) &&
        run.magnitudes.missed_load > is_jump)
      all.emplace_back(
        "[Crack tip] Creep integral: a load seems to jump within a step, where "
        "C(t) is wrong; let a step end at the jump ([Time integration] Steps)");
    if (run.steps.jumps_at(run.steps.period()) && !formulas_can_jump(run.scene))
      all.push_back(
        "[Loads] Period = " + Text::from_number(run.steps.period()) +
        ": loads or material jump at the end of the period, though no formula "
        "has a jump; at t = Period the tables show the load of t = 0. Check "
        "that this is the period of the formulas; a load that is applied once "
        "needs a longer Period, in which it returns to its initial value");
    if (singular_functions(run.scene).n == 3 && run.body.effects.contact.on)
      all.emplace_back(
        "[Discretisation] Singular functions = 3 with contact: the third "
        "function moves the closed lip between its nodes, so that pressure and "
        "K_I have errors of some tenths of a per cent; use 2");
    if (has_thermal_expansion(run.scene.material) &&
        run.scene.loads.reference.text().empty())
      if (const double least = least_temperature(run.body, run.steps.period());
          least > 200.)
        all.push_back(Text::Message()
                      << "[Loads] Temperature is at least " << least
                      << " everywhere and always, as a temperature in kelvin "
                         "would be, but it is the change from the temperature "
                         "without thermal strain; set Reference temperature to "
                         "that temperature");
    doubt_units(run, all);
    if (!run.split.warning.empty())
      all.push_back(run.split.warning);
    warn_of_large_steps(run, all);
    return all;
  }



  template <int dim>
  std::vector<std::string>
  table_warnings(const Run<dim> &run)
  {
    const MPI_Comm           communicator = run.body.space.communicator();
    std::vector<std::string> all;
    for (const CommonError &error : missed_rows(run))
      all.push_back(error.warning);
    for (const auto &[name, table] : *run.scene.tables.functions)
      {
        const double least =
          dealii::Utilities::MPI::min(table.least_seen, communicator);
        const double largest =
          dealii::Utilities::MPI::max(table.largest_seen, communicator);
        if (table.quantity == "theta" &&
            (least < table.x.front() || largest > table.x.back()))
          all.push_back(Text::Message()
                        << "[Tables] Files = " << table.file << ": " << name
                        << " has rows of theta from " << table.x.front()
                        << " to " << table.x.back() << ", but is needed from "
                        << least << " to " << largest
                        << ". Beyond the rows it has its first or last value");
      }
    return all;
  }



  template decltype(warnings<2>)       warnings<2>;
  template decltype(warnings<3>)       warnings<3>;
  template decltype(table_warnings<2>) table_warnings<2>;
  template decltype(table_warnings<3>) table_warnings<3>;
} // namespace Crevasse
