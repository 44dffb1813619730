// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_elastic_comparison_h
#define crevasse_simulation_elastic_comparison_h

#include <crevasse/base/state_archive.h>
#include <crevasse/base/text.h>
#include <crevasse/model/elastic_displacement.h>
#include <crevasse/simulation/run.h>
#include <crevasse/time/observer.h>

namespace Crevasse
{
  /**
   * Compares the last period with the elastic closed form (model, §2): for a
   * homogeneous body with η = τK and loads F(t) p(x) the periodic stress is
   * F(t) s_el with the elastic solution u_el of a lip that stays open or
   * closed, and the drift per period is T β = T (F̄/τ) u_el.
   */
  template <int dim>
  class ElasticComparison : public Observer
  {
  public:
    /** Solves for u_el. The arguments must outlive the ElasticComparison.
     * @param drift q(t+T) − q(t) of the last period. */
    ElasticComparison(Run<dim> &run, const Vector &drift)
      : run(run)
      , factors(*run.load_factors)
      , drift(drift)
      , displacement(elastic_displacement(run.scene,
                                          run.body,
                                          run.systems,
                                          factors.reference,
                                          run.scene.output.elastic_comparison ==
                                            ComparedLip::closed))
    {
      const Body<dim>         &body     = run.body;
      const MaterialState<dim> material = body.material.at(0.);
      body.points.initialize(stress);
      body.strain_operator.for_each_strain(
        displacement,
        [&](const std::size_t point, const VoigtVector<dim> &strain) {
          QuadratureField<dim>::set(
            stress,
            point,
            (*material.stiffness)[point / n_stress_components<dim>] * strain);
        });
    }

    void
    observe(const Sample &sample) override
    {
      if (sample.step == factors.at_steps.size())
        return; // the end of the run is no sample of the last period
      Vector difference = sample.state.stress;
      difference.add(-factors.at_steps[sample.step], stress);
      largest_difference =
        std::max(largest_difference, difference.linfty_norm());
      largest_stress =
        std::max(largest_stress, sample.state.stress.linfty_norm());
    }

    void
    end_of_period(const PeriodReport &) override
    {
      last_period =
        largest_stress > 0. ? largest_difference / largest_stress : 0.;
      largest_difference = largest_stress = 0.;
    }

    void
    serialize(StateArchive &archive) override
    {
      archive.section("elastic comparison");
      archive.common(largest_difference);
      archive.common(largest_stress);
      archive.common(last_period);
    }

    /** summary.json "elastic_comparison": the largest |s − F s_el| over the
     * last period and all points, relative to the largest stress, and the
     * largest |q(t+T) − q(t) − T (F̄/τ) u_el|, relative to the largest
     * displacement of T (F̄/τ) u_el or, if that vanishes, of F u_el. */
    void
    summarise(Summary &summary) override
    {
      Log &log                                           = run.log;
      summary["elastic_comparison"]["stress_difference"] = last_period;
      log.line(
        Text::format("  periodic stress against F(t) s_el: difference %.2e of "
                     "the largest stress",
                     last_period));
      if (!run.body.effects.viscosity.on)
        return;
      double largest_factor = 0.;
      for (const double f : factors.at_steps)
        largest_factor = std::max(largest_factor, std::abs(f));
      const double factor = std::abs(factors.drift);
      const double size =
        (factor > 1e-10 * largest_factor ? factor : largest_factor) *
        displacement.linfty_norm();
      Vector difference = drift;
      difference.add(-factors.drift, displacement);
      const double of_drift = size > 0. ? difference.linfty_norm() / size : 0.;
      summary["elastic_comparison"]["drift_difference"] = of_drift;
      log.line(
        Text::format("  drift per period against T F_mean/tau u_el: "
                     "difference %.2e",
                     of_drift));
    }

  private:
    const Run<dim>    &run;
    const LoadFactors &factors;
    const Vector      &drift;

    Vector displacement, stress; ///< u_el and s_el at the reference loads
    double largest_difference = 0., largest_stress = 0.;
    double last_period = 0.; ///< relative difference
  };
} // namespace Crevasse

#endif
