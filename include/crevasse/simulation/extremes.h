// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_extremes_h
#define crevasse_simulation_extremes_h

#include <crevasse/base/series_extremes.h>
#include <crevasse/discretisation/rigid_modes.h>
#include <crevasse/grid/singular_place.h>
#include <crevasse/simulation/run.h>
#include <crevasse/time/period_observer.h>

namespace Crevasse
{
  /** Records the largest stress, displacement, opening and viscous strain of
   * a run, or of its last period, the largest contact force and pressure of its
   * last period, and the rounding of the stress. */
  template <int dim>
  class Extremes : public PeriodObserver
  {
  public:
    /** Updates the largest values in the state of the run, also after other
     * meshes. */
    explicit Extremes(Run<dim> &run)
      : run(run)
      , body(run.body)
      , state(run.state)
    {
    }

    void
    observe(const Sample &sample) override
    {
      if (run.choice.periods_are_iterates() && sample.step == 0)
        state.largest_displacement = state.largest_opening = viscous_strain =
          0.;
      if (sample.viscous_strain.size() > 0)
        viscous_strain =
          std::max(viscous_strain, largest_strain(sample.viscous_strain));
      PeriodObserver::observe(sample);
      state.largest_displacement =
        std::max(state.largest_displacement, displacement.back());
      state.largest_opening = std::max(state.largest_opening, opening.back());
    }

    void
    before_jump(const Sample &sample) override
    {
      observe(sample);
    }

    void
    end_of_period(const PeriodReport &report) override
    {
      state.largest_stress =
        std::max(run.choice.periods_are_iterates() ? 0. : state.largest_stress,
                 report.largest_stress);
      find_largest();
    }

    void
    serialize(StateArchive &archive) override
    {
      archive.common(viscous_strain);
      PeriodObserver::serialize(archive);
      for (auto *const series : all())
        archive.common(*series);
    }

    /** Adds "extremes". "stress_rounding" is relative to the maximum: stress
     * is K times the small difference of strains that may be large. */
    void
    summarise(Summary &summary) override
    {
      find_largest();
      // Stress has kinks where lips change: those of the last period were
      // found.
      state.largest_stress = std::max(state.largest_stress, largest_of(stress));
      Summary &extremes    = summary["extremes"];
      extremes["stress"]   = state.largest_stress;
      extremes["displacement"] = state.largest_displacement;
      if (const std::string why =
            why_stress_is_unbounded(body.space.mesh(), body.space.roles);
          !why.empty() && state.largest_stress > 0.)
        {
          summary["no_largest_stress"] = why;
          run.log.line("  largest stress at quadrature points " +
                       Text::from_number(state.largest_stress, 4) + ": " + why);
        }
      constexpr double small    = 0.1;
      const double     diagonal = RigidParts<dim>(body.space.mesh()).size();
      if (state.largest_displacement > small * diagonal)
        warn(
          Text::Message()
            << "displacements reach " << state.largest_displacement
            << " in a body of diagonal " << diagonal
            << ": the theory is for small strains. Check that loads, lengths "
               "and moduli use one system of units, and that the body may "
               "creep this long",
          run.log,
          summary);
      if (body.effects.contact.on)
        {
          extremes["opening"]       = state.largest_opening;
          extremes["contact_force"] = largest_of(force);
          extremes["pressure"]      = largest_of(pressure);
        }
      if (!body.effects.viscosity.on)
        return;
      double     stiffness = 0.;
      const auto material  = body.material.at(0.);
      for (const VoigtMatrix<dim> &K : material.stiffness->distinct())
        stiffness = std::max(stiffness, K.norm());
      stiffness =
        dealii::Utilities::MPI::max(stiffness, body.space.communicator());
      summary["certificate"]["stress_rounding"] =
        state.largest_stress == 0.
          ? 0.
          : std::numeric_limits<double>::epsilon() * stiffness *
              viscous_strain / state.largest_stress;
    }

    LipTotals lip; ///< state at the last sample

  private:
    void
    clear() override
    {
      for (auto *const series : all())
        series->clear();
    }

    void
    insert(const Sample &sample, const std::size_t k) override
    {
      const State &now = sample.state;
      if (body.effects.contact.on)
        lip = body.lip.totals(now.displacement, now.contact_forces);
      const double moved =
        body.nodal_displacement(now.displacement, now.instant, 0.)
          .linfty_norm();
      const auto add = [k](std::vector<double> &series, const double value) {
        series.insert(series.begin() + k, value);
      };
      add(stress, now.stress.linfty_norm());
      add(displacement, moved);
      add(opening, lip.largest_opening);
      add(force, lip.force);
      add(pressure, lip.largest_pressure);
    }

    double
    largest_of(const std::vector<double> &series) const
    {
      return std::max(0., SeriesExtremes(instants, series).largest.value);
    }

    /** Takes what was larger between the steps of the period. */
    void
    find_largest()
    {
      state.largest_displacement =
        std::max(state.largest_displacement, largest_of(displacement));
      state.largest_opening =
        std::max(state.largest_opening, largest_of(opening));
    }

    std::array<std::vector<double> *, 5>
    all()
    {
      return {{&stress, &displacement, &opening, &force, &pressure}};
    }

    double
    largest_strain(const Vector &r) const
    {
      if (!body.law.hardens())
        return r.linfty_norm();
      Vector strains = r;
      body.material.convert(&CreepPoint<dim>::strains, strains);
      return strains.linfty_norm();
    }

    const Run<dim>  &run;
    const Body<dim> &body;
    RunState        &state;
    double           viscous_strain = 0.; ///< its largest component

    /** Largest values at the instants of the last period. */
    std::vector<double> stress, displacement, opening, force, pressure;
  };
} // namespace Crevasse

#endif
