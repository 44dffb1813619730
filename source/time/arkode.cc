// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/base/text.h>
#include <crevasse/time/arkode.h>
#include <crevasse/time/arkode_driver.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <arkode/arkode_butcher_dirk.h>
#include <arkode/arkode_butcher_erk.h>
#include <cmath>

namespace Crevasse
{
  namespace
  {
    struct Choice
    {
      const char *name;
      int         id;
      /** Ratio of the estimated error of a step, by the embedded method of
       * lower order, to the error of the stress over periods: measured
       * (doc/time_schemes.md). */
      double excess;
      double limit = no_stability_limit;
    };

    // Methods by order, from 2 on. Implicit ones are L-stable and have one γ on
    // the diagonal, so that equal steps have equal matrices, and the last stage
    // at the end of the step (Kennedy and Carpenter, Appl. Numer. Math. 44,
    // 2003 and 146, 2019). ARKODE's defaults are not used: its SDIRK-2-1-2 is
    // not L-stable, and the estimates of the others grow with stiffness.
    constexpr Choice explicit_choices[] = {
      {"Heun-Euler 2(1)", ARKODE_HEUN_EULER_2_1_2, 5., 2.},
      {"Bogacki-Shampine 3(2)",
       ARKODE_BOGACKI_SHAMPINE_4_2_3,
       4.,
       2.512745326618329},
      {"Zonneveld 4(3)", ARKODE_ZONNEVELD_5_3_4, 20., 2.785293563405282},
      {"Dormand-Prince 5(4)",
       ARKODE_DORMAND_PRINCE_7_4_5,
       1.,
       3.306567892634947}};

    /** Implicit methods by order; the first is "sdirk2". */
    constexpr Choice implicit_choices[] = {
      {"SDIRK2(1)", ARKODE_DIRK_NONE, 10.},
      {"ESDIRK3(2)5L[2]SA", ARKODE_ESDIRK325L2SA_5_2_3, 1.},
      {"ARK4(3)6L[2]SA-ESDIRK", ARKODE_ARK436L2SA_DIRK_6_3_4, 1.},
      {"ESDIRK5(4)7L[2]SA2", ARKODE_ESDIRK547L2SA2_7_4_5, 1.}};



    const Choice &
    choice_of(const TimeIntegrationParameters &parameters)
    {
      return (parameters.scheme == Scheme::arkode_implicit
                ? implicit_choices
                : explicit_choices)[parameters.order - 2];
    }



    using Table =
      std::unique_ptr<ARKodeButcherTableMem, void (*)(ARKodeButcherTable)>;

    Table
    make_table(const TimeIntegrationParameters &parameters)
    {
      const int          id    = choice_of(parameters).id;
      ARKodeButcherTable table = nullptr;
      if (parameters.scheme == Scheme::arkode_explicit)
        table = ARKodeButcherTable_LoadERK(static_cast<ARKODE_ERKTableID>(id));
      else if (parameters.order == 2)
        {
          // The weights of the embedded method differ by ±γ²: it multiplies a
          // stiff component by −(1−γ), so that the estimate stays bounded.
          constexpr double gamma = 1. - dealii::numbers::SQRT1_2;
          constexpr double shift = gamma * gamma;
          double           c[]   = {gamma, 1.};
          double           a[]   = {gamma, 0., 1. - gamma, gamma};
          double           b[]   = {1. - gamma, gamma};
          double           d[]   = {1. - gamma + shift, gamma - shift};
          table = ARKodeButcherTable_Create(2, 2, 1, c, a, b, d);
        }
      else
        table =
          ARKodeButcherTable_LoadDIRK(static_cast<ARKODE_DIRKTableID>(id));
      return {table, &ARKodeButcherTable_Free};
    }



    IntegratorProperties
    properties_of(const TimeIntegrationParameters &parameters)
    {
      const Choice        &choice = choice_of(parameters);
      const Table          table  = make_table(parameters);
      const int            n      = table->stages;
      IntegratorProperties all;
      all.name            = name_of(parameters.scheme) + " with " + choice.name;
      all.stability_limit = choice.limit;
      if (parameters.step_control == StepControlType::adaptive)
        {
          all.name += ", adaptive steps";
          all.quadrature.nodes = {0., 0.5, 1.};
          all.controls_steps   = true;
          all.repeats_steps    = false;
          return all;
        }
      all.quadrature = {{table->c, table->c + n}, {table->b, table->b + n}};
      all.begins_explicitly =
        parameters.scheme == Scheme::arkode_implicit && table->A[0][0] == 0.;
      return all;
    }



    class Arkode : public Integrator
    {
    public:
      explicit Arkode(const TimeIntegrationParameters &parameters)
        : Integrator(properties_of(parameters))
        , parameters(parameters)
      {
      }

      void
      start(RateEquation &f,
            const double  t,
            const Vector &r,
            Vector       &rate) override
      {
        equation.attach(f);
        if (!is_continuing)
          equation.forget();
        equation.show(t, r, rate);
      }

      void
      advance(const TimeStep &step) override
      {
        equation.attach(step.f);
        if (driver == nullptr)
          make_driver(step);
        else if (!is_continuing || driver->time() != step.t)
          // A step of a list may be repeated with another length.
          driver->restart(step.t, step.r, properties.controls_steps);
        is_continuing             = true;
        constexpr double rounding = 1e-10;
        if (properties.begins_explicitly &&
            step.length * step.f.relaxation_rate() > 1.)
          driver->controlled_step(step.length);
        else if (!properties.controls_steps)
          driver->fixed_step(step.length);
        else
          // End a step at each sample, so as not to miss an event there.
          while (driver->time() < step.t + (1. - rounding) * step.length)
            if (driver->evolve(step.t + step.length))
              {
                ++n_events;
                driver->restart(driver->time(), Vector(driver->state()), false);
              }
        step.r = driver->state();
      }

      IntegratorStatistics
      statistics() const override
      {
        if (driver == nullptr)
          return {};
        IntegratorStatistics all = driver->statistics();
        all.emplace_back("evaluations", equation.last().n_evaluations());
        if (properties.controls_steps && parameters.locate_contact_events)
          all.emplace_back("contact_events", n_events);
        return all;
      }

      void
      serialize(StateArchive &archive) override
      {
        archive.section("arkode");
        equation.serialize(archive);
        archive.at_points(allowed_errors);
        archive.common(is_continuing);
        archive.common(n_events);
        if (archive.is_loading())
          driver.reset(); // recreated when needed
      }

    private:
      /** Creates the driver, to begin with this step. */
      void
      make_driver(const TimeStep &step)
      {
        // Steps of a list are controlled with nonlinear creep.
        const bool has_error =
          properties.controls_steps ||
          (properties.begins_explicitly && step.f.stress_scale() > 0.);
        if (has_error && allowed_errors.size() == 0)
          allowed_errors = tolerances(step.f, step.r);
        driver = std::make_unique<ArkodeDriver>(parameters.scheme ==
                                                  Scheme::arkode_implicit,
                                                make_table(parameters).get(),
                                                equation,
                                                step.t,
                                                step.r);
        if (has_error)
          driver->control_steps(allowed_errors);
        if (!properties.controls_steps)
          return;
        if (properties.stability_limit != no_stability_limit)
          driver->limit_steps(properties.stability_limit);
        if (parameters.locate_contact_events)
          driver->seek_events();
      }

      /** Allowed error of r in a step, see make_arkode(). Solves for the
       * elastic body at some instants. */
      Vector
      tolerances(const RateEquation &f, const Vector &r)
      {
        const double     scale          = f.stress_scale();
        constexpr double of_listed_step = 0.1;
        double           stress         = properties.controls_steps
                                            ? parameters.relative_tolerance * scale +
                              parameters.absolute_tolerance
                                            : of_listed_step * scale;
        constexpr double rounding       = 1e-13;
        if (stress < rounding * scale)
          throw NumericalError(
            "[Time integration] Relative tolerance = " +
            Text::from_number(parameters.relative_tolerance) +
            " is below the rounding error of the stress. Set it, or Absolute "
            "tolerance, to at least 1e-13 times the largest stress.");
        if (stress == 0.) // no load: any tolerance
          stress = 1.;
        Vector result;
        f.strain_per_stress(r, result);
        // ARKODE's norm is the root mean square of all entries.
        result *= choice_of(parameters).excess * stress /
                  std::sqrt(static_cast<double>(result.size()));
        return result;
      }

      const TimeIntegrationParameters parameters;

      CachedRate                    equation;
      std::unique_ptr<ArkodeDriver> driver;         ///< made with first r
      Vector                        allowed_errors; ///< by tolerances()
      std::size_t                   n_events = 0;
    };
  } // namespace



  std::unique_ptr<Integrator>
  make_arkode(const TimeIntegrationParameters &parameters)
  {
    return std::make_unique<Arkode>(parameters);
  }
} // namespace Crevasse
