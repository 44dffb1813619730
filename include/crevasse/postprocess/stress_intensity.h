// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_stress_intensity_h
#define crevasse_postprocess_stress_intensity_h

#include <crevasse/crack_tip/arc_integral.h>
#include <crevasse/crack_tip/interaction_integral.h>
#include <crevasse/crack_tip/nested_fits.h>
#include <crevasse/time/step_list.h>

namespace Crevasse
{
  /**
   * Computes K_I at the instants of a run by integrals over two squares, with
   * the fit of Williams' series as a check, or by the fit. Squares end at other
   * boundaries, discs also at other materials. T is computed, too, unless the
   * body is one of revolution; if the tip has two lips, also K_II, and there is
   * no fit.
   */
  class StressIntensity
  {
  public:
    /** K_I, K_II and T, and their errors, as far as they are computed. K_I is 0
     * if nothing creeps and the node next to the tip is closed. */
    struct Estimate
    {
      std::array<double, 2> intensity;
      /** Differences between integrals over two squares, or between fits to two
       * discs. */
      std::array<double, 2> error;
      double                t_stress, t_stress_error;
      /** K_I of the fit or, without a fit, over the smaller square. */
      double of_stress;
      /** Length of closed lips next to a tip between two materials; else 0. */
      double contact_zone;
    };

    /** Collective. The arguments must outlive the StressIntensity.
     * @throw SceneError if the field at the tip is not known, or if [Crack tip]
     * Radius or Method does not suit it. */
    StressIntensity(const Scene                                &scene,
                    const Body<2>                              &body,
                    const CrackTip                             &tip,
                    const StepList                             &steps,
                    const std::shared_ptr<const PointGeometry> &geometry);

    StressIntensity(const StressIntensity &) = delete;

    /** The parameter that requests K, as "[Section] Name = value". */
    static std::string
    setting(const Scene &scene)
    {
      return "[Crack tip] Stress intensity = " +
             name_of(scene.crack_tip.stress_intensity);
    }

    /** Estimates K. Collective. @param t within the period. @param material at
     * the instant t. @param at_tip elasticity(t) */
    Estimate
    evaluate(const double            t,
             const Sample           &sample,
             const MaterialState<2> &material,
             const TipElasticity    &at_tip) const;

    /** InteractionIntegral::factor_of_stress() of one of the modes(), also
     * where K_I is that of the fit. */
    Vector
    factor_of_stress(const CrackMode         mode,
                     const MaterialState<2> &material,
                     const TipElasticity    &at_tip) const
    {
      return integral_of(mode).factor_of_stress(material, at_tip);
    }

    /** The integral over the larger square for one of the modes(). */
    const InteractionIntegral &
    integral_of(const CrackMode mode) const
    {
      return std::find_if(integrals.begin(),
                          integrals.end(),
                          [mode](const auto &one) { return one.first == mode; })
        ->second.first;
    }

    /** The modes that are computed. */
    std::vector<CrackMode>
    modes() const
    {
      std::vector<CrackMode> list = {CrackMode::opening};
      if (region.tip.two_lips)
        list.push_back(CrackMode::sliding);
      if (has_t_stress())
        list.push_back(CrackMode::constant);
      return list;
    }

    /** The modes() that factor_of_stress() knows: none on an arc between two
     * materials, where G is. */
    std::vector<CrackMode>
    linear_modes() const
    {
      return is_on_arc() ? std::vector<CrackMode>() : modes();
    }

    /** Whether T is computed: by the integral, where the stress at the tip
     * stays Williams' series. */
    bool
    has_t_stress() const
    {
      return (region.tip.two_lips || !body.space.roles.has_axis) && !uses_fit &&
             why.empty() && !first_elasticity.interface;
    }

    /** Name of the method, "interaction integral", "williams fit" or, on an
     * arc between two materials, "energy release rate". */
    std::string
    method() const
    {
      return is_on_arc() ? "energy release rate"
             : uses_fit  ? name_of(StressIntensityMethod::williams_fit)
                         : name_of(StressIntensityMethod::interaction_integral);
    }

    /** Whether the tip is on an arc between two materials: K is no linear
     * function of the stress then. */
    bool
    is_on_arc() const
    {
      return first_elasticity.interface && region.path.is_curved();
    }

    /** Elasticity of the law at the tip at an instant within the period,
     * without the factor k. @throw SceneError if K is not known with it; never
     * at instants of the first period's steps. */
    TipElasticity
    elasticity(const double t) const
    {
      return body.material.stiffness_varies ? find_elasticity(t)
                                            : first_elasticity;
    }

    /** Distance of the tip to another boundary or, unless the stiffness varies
     * from the tip on, another stiffness. */
    double
    uniform_radius() const
    {
      return uniform.stiffness > 0. ? uniform.stiffness
                                    : region.largest_radius();
    }

    /** Relative error of K that the mesh leaves for fields of known K. */
    double
    error_of_known_fields() const
    {
      return square.error;
    }

    /** Error of T that the mesh leaves for fields of a unit K. */
    double
    t_stress_error_of_known_fields() const
    {
      return square.error_of_T;
    }

    /** Size of the square, or of the largest disc of the fit. */
    double
    radius() const
    {
      return uses_fit ? fit_radius : square.size;
    }

    /** Whether the lips between two materials are closed so far from the tip
     * that the field around their contact zone is not that of open lips. */
    bool
    is_wide(const double contact_zone) const
    {
      constexpr double small = 0.01; // Rice 1988
      return contact_zone >= small * first_elasticity.interface->length;
    }

    /** Part of a line for the log, empty except between two materials. */
    std::string
    describe_interface() const;

    const Scene                               &scene;
    const Body<2>                             &body;
    const std::shared_ptr<const PointGeometry> geometry; ///< owns points
    const PointGeometry                       &points;
    const TipRegion                            region;

  private:
    /** Half the sides of uniform squares, over the whole period; 0: varies at
     * the tip. */
    struct UniformRadii
    {
      double stiffness;
      /** Half the side of the square in which also creep is uniform. */
      double creep;
    };

    /** A square of half the side @p size, and the errors of the integrals over
     * it for fields of a unit K; 0 for the fit. */
    struct Square
    {
      double size, error, error_of_T = 0.;
    };

    /** Integrals over the larger and the smaller square. */
    using Integrals = std::pair<InteractionIntegral, InteractionIntegral>;

    /** Integrals over the squares. @param is_closed whether the lips are closed
     * between two materials. */
    Integrals
    integrate(const CrackMode mode, const bool is_closed) const;

    TipElasticity
    find_elasticity(const double t) const;

    /** Limits of a property at the tip, above and below the crack, or the same
     * on both sides. None if there are none. */
    std::optional<InterfaceTip::Sides>
    limits_at(const Property<VoigtMatrix<2>> &property,
              const double                    t,
              const bool                      by_side) const;

    /** Elasticity of two isotropic bodies if the crack ends between them.
     * @throw SceneError if K is not known with what the scene has beside. */
    std::optional<InterfaceTip>
    find_interface(const double t) const;

    UniformRadii
    find_uniform_radii(const StepList &steps) const;

    /** @throw SceneError if K is not known, or Method does not suit the tip. */
    std::string
    find_reason(const StepList &steps) const;

    /** The square of the scene or, among several, that with the least error for
     * fields of known K. */
    Square
    choose_square() const;

    /** Size of the larger square at a tip on an arc between two materials.
     * @throw SceneError if the moduli of one of them vary there. */
    double
    square_on_arc() const;

    /** Size of the square whose integral is the check. */
    double
    smaller_square() const
    {
      return std::max(region.aligned_radius(0.5 * square.size),
                      region.cell_radius);
    }

    /** InteractionIntegral::Squares::creep, at least so many cells. */
    double
    creep_square(const double size, const unsigned int cells) const;

    /** Whether stress has other causes than boundary forces and creep: if not,
     * it is Williams' series where the body is uniform, and viscous strain is
     * compatible there. On rings that holds close to the tip only. */
    bool
    is_disturbed() const
    {
      return (body.space.roles.has_axis &&
              scene.material.viscosity == ViscosityType::isotropic) ||
             Effects::first_on(body.effects.free_strains) != nullptr ||
             Effects::first_on(body.effects.volume_forces) != nullptr;
    }

    /** Whether the fit serves: for one unloaded lip in the plane. */
    bool
    can_fit() const
    {
      return !region.tip.two_lips && !body.space.roles.has_axis &&
             !first_elasticity.anisotropic &&
             !body.space.roles.has_loaded_lip() && !body.friction;
    }

    double
    choose_fit_radius() const;

    const TipElasticity first_elasticity; ///< elasticity at t = 0
    const UniformRadii  uniform;

  public:
    const bool uses_fit; ///< whether K_I is that of the fit
    /** Reason for the fit, or why the field at the tip is not Williams' series
     * once it has crept: then the difference of integral and fit is an error.
     * Otherwise empty. */
    const std::string why;

  private:
    const Square                                 square; ///< larger square
    std::vector<std::pair<CrackMode, Integrals>> integrals;
    /** Mode II of closed lips between two materials. */
    std::optional<Integrals> of_closed_lips;
    /** On an arc between two materials, instead of integrals. */
    std::optional<ArcIntegral> on_arc;
    double                     fit_radius = 0.;
    std::optional<NestedFits>  fits; ///< fits for one lip in the plane
  };
} // namespace Crevasse

#endif
