// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_stress_intensity_h
#define crevasse_postprocess_stress_intensity_h

#include <crevasse/crack_tip/interaction_integral.h>
#include <crevasse/crack_tip/nested_fits.h>
#include <crevasse/time/step_list.h>

namespace Crevasse
{
  /**
   * K_I of a run at its instants: by the integrals over two squares, where the
   * field at the tip is Williams' series (the moduli are isotropic there and
   * the same on all sides), and by the fit. Squares and discs end where another
   * boundary or material begins. Where the tip has two lips there are K_II and
   * T too, and no fit.
   */
  class StressIntensity
  {
  public:
    /** All 0 where nothing creeps and the node next to the tip is closed. In
     * bodies of revolution of_stress is K over the smaller square. */
    struct Estimate
    {
      double intensity, of_stress;
      /** The difference between the integrals over two squares; without the
       * integral, between the fits to two discs. */
      double error;
    };

    /** What the integrals over the larger square give, and how much those over
     * the smaller one differ. */
    struct ModeEstimate
    {
      double intensity, error;
    };

    /** Collective. Arguments must outlive this object.
     * @throw SceneError if the tip is not one whose field is known, or [Crack
     * tip] Radius or Method does not fit it. */
    StressIntensity(const Scene                                &scene,
                    const Body<2>                              &body,
                    const CrackTip                             &tip,
                    const StepList                             &steps,
                    const std::shared_ptr<const PointGeometry> &geometry);

    StressIntensity(const StressIntensity &) = delete;

    /** The parameter that asks for it, as "[Section] Name = value". */
    static std::string
    setting(const Scene &scene)
    {
      return "[Crack tip] Stress intensity = " +
             name_of(scene.crack_tip.stress_intensity);
    }

    /** Collective. @param t within the period. @param material of that.
     * @param at_tip elasticity(t) */
    Estimate
    evaluate(const double            t,
             const Sample           &sample,
             const MaterialState<2> &material,
             const PlaneElasticity  &at_tip) const;

    /** K_I, K_II and T of a tip with two lips. Collective. */
    std::array<ModeEstimate, 3>
    evaluate_modes(const double            t,
                   const Sample           &sample,
                   const MaterialState<2> &material,
                   const PlaneElasticity  &at_tip) const;

    /** What is found. */
    std::vector<CrackMode>
    modes() const
    {
      if (!region.tip.two_lips)
        return {CrackMode::opening};
      return {CrackMode::opening, CrackMode::sliding, CrackMode::constant};
    }

    /** "interaction integral" or "williams fit" */
    std::string
    method() const
    {
      return name_of(!integrals.empty()
                       ? StressIntensityMethod::interaction_integral
                       : StressIntensityMethod::williams_fit);
    }

    /** Why it is the fit; empty: it is not. */
    const std::string &
    why_no_integral() const
    {
      return no_integral;
    }

    /** That of the law at the tip at an instant within the period, without its
     * factor k. @throw SceneError if K is not known with it; not at instants
     * of the first period's steps. */
    PlaneElasticity
    elasticity(const double t) const
    {
      return body.material.stiffness_varies ? find_elasticity(t)
                                            : first_elasticity;
    }

    /** Where another boundary or another stiffness begins. */
    double
    largest_radius() const
    {
      return uniform.stiffness > 0. ? uniform.stiffness
                                    : region.largest_radius();
    }

    /** Of the square, or of the largest disc of the fit. */
    double
    radius() const
    {
      return integrals.empty() ? fit_radius : square;
    }

    const Scene                               &scene;
    const Body<2>                             &body;
    const std::shared_ptr<const PointGeometry> geometry; ///< keeps points
    const PointGeometry                       &points;
    const TipRegion                            region;

  private:
    /** Half the sides of squares, over the whole period; 0: it varies from the
     * tip on. */
    struct UniformRadii
    {
      double stiffness;
      /** Where besides all points creep alike. */
      double creep;
    };

    /** Over the larger and the smaller square. */
    using Integrals = std::pair<InteractionIntegral, InteractionIntegral>;

    PlaneElasticity
    find_elasticity(const double t) const;

    UniformRadii
    find_uniform_radii(const StepList &steps) const;

    /** Why the integral is not taken; empty: it is.
     * @throw SceneError if Method asks for it where it is not right. */
    std::string
    find_no_integral(const StepList &steps) const;

    /** Of a body of revolution: @throw SceneError if K is not known. */
    void
    require_ring() const;

    Integrals
    make_integrals(const CrackMode mode) const;

    /** Of a mode, by its place in modes(). Collective. */
    ModeEstimate
    integrate(const unsigned int      mode,
              const double            t,
              const Sample           &sample,
              const MaterialState<2> &material,
              const PlaneElasticity  &at_tip) const;

    double
    open_length_of(const State &state) const
    {
      return open_length(body.lip,
                         region.tip,
                         state,
                         body.space.communicator());
    }

    /** Whether K_I is 0. Creep may have left a singular stress at a closed tip.
     */
    bool
    stays_closed(const double open) const
    {
      return open == 0. && !body.effects.viscosity.on;
    }

    /** InteractionIntegral::Squares::creep, of as many cells or more. */
    double
    creep_square(const double size, const unsigned int cells) const;

    /** Whether more than forces on the boundary and creep makes stress: else it
     * is Williams' series where the body is uniform, and viscous strain is
     * compatible there. On rings that holds close to the tip only. */
    bool
    is_disturbed() const
    {
      return (body.space.roles.has_axis &&
              scene.material.viscosity == ViscosityType::isotropic) ||
             Effects::first_on(body.effects.free_strains) != nullptr ||
             Effects::first_on(body.effects.volume_forces) != nullptr;
    }

    double
    choose_fit_radius() const;

    const PlaneElasticity     first_elasticity; ///< at t = 0
    const UniformRadii        uniform;
    const std::string         no_integral; ///< why; empty: there is one
    const double              square;      ///< of the integral
    std::vector<Integrals>    integrals;   ///< of each of modes(), or none
    double                    fit_radius = 0.;
    std::optional<NestedFits> fits; ///< with one lip in the plane
  };
} // namespace Crevasse

#endif
