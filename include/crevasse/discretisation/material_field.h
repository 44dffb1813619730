// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_material_field_h
#define crevasse_discretisation_material_field_h

#include <crevasse/discretisation/point_values.h>
#include <crevasse/discretisation/quadrature_field.h>
#include <crevasse/material/creep_power.h>
#include <crevasse/material/maxwell_law.h>
#include <crevasse/material/voigt_matrix.h>
#include <crevasse/temperature/temperature.h>

#include <algorithm>

namespace Crevasse
{
  /** The material at the quadrature points at one instant: see MaxwellLaw. */
  template <int dim>
  struct MaterialState
  {
    using Matrices = PointValues<VoigtMatrix<dim>>;
    using Vectors  = PointValues<VoigtVector<dim>>;

    std::shared_ptr<const Matrices>              stiffness;   ///< K
    std::vector<double>                          fractions;   ///< wᵢ
    double                                       spring = 1.; ///< 1 − Σ wᵢ
    std::vector<std::shared_ptr<const Matrices>> fluidity;    ///< Hᵢ
    std::shared_ptr<const PointValues<CreepPower<dim>>>
      creep_power; ///< null: the fluidity does not depend on the stress
    std::shared_ptr<const Vectors>
      thermal_strain; ///< f, such as χθ; null: none

    /** Whether stiffness and viscosity have no 33 row. */
    bool plane_stress = false;

    double stiffness_factor = 1.; ///< k
    double viscosity_factor = 1.; ///< η₀

    /** κ of the AlgorithmicModuli for a time c. */
    double
    kappa(const double c) const
    {
      return c * stiffness_factor / viscosity_factor;
    }

    /** The rate of a power law. */
    VoigtVector<dim>
    creep_rate(const std::size_t point, const VoigtVector<dim> &stress) const
    {
      return (*creep_power)[point].factor(stress) / viscosity_factor *
             ((*fluidity[0])[point] * stress);
    }

    /** Whether this is one Maxwell body, the same everywhere and without
     * thermal strain, the case that deserves the shortest loops. */
    bool
    is_plain() const
    {
      return stiffness->is_uniform() && fractions.size() == 1 &&
             fractions[0] == 1. && fluidity[0]->is_uniform() &&
             creep_power == nullptr && thermal_strain == nullptr;
    }
  };

  /** Of all points, branches and instants. */
  struct RelaxationTimes
  {
    double smallest, largest; ///< infinite if nothing relaxes

    /** Of what relaxes slowest over a period, or more: the inverse of the mean
     * over the period of the least rate of each instant; infinite if nothing
     * relaxes. */
    double longest_in_mean;

    double mean_fluidity_factor; ///< mean over the period of 1/η₀, or less
    bool   all;                  ///< whether all parts of the stress relax

    /** The largest exponent of creep, of which the stress alone tells the
     * rates; 1 where it is linear. */
    double creep_exponent = 1.;
  };

  /**
   * The law of the material at the quadrature points of a body. What does not
   * depend on time is evaluated once and shared by the states of all instants;
   * what does not depend on space is one value.
   */
  template <int dim>
  class MaterialField
  {
  public:
    /** Collective. All arguments must outlive this object. */
    MaterialField(const Space<dim>           &space,
                  const QuadratureField<dim> &points,
                  const MaxwellLaw<dim>      &law,
                  const Temperature<dim>     &temperature);

    /** The state at an instant of the period. Collective if it depends on
     * time. @throw SceneError if a formula or table has no value, or one that a
     * material cannot have, with the point and the instant. */
    MaterialState<dim>
    at(const double t) const;

    /** Brings the factors k and η₀ of a state to another instant.
     * @throw SceneError if one is not positive. */
    void
    set_factors(const double t, MaterialState<dim> &state) const
    {
      state.stiffness_factor = law.stiffness_factor(t);
      state.viscosity_factor = law.viscosity_factor(t);
    }

    // What depends on time, besides the factors.
    bool stiffness_varies;
    bool fluidity_varies       = false;
    bool thermal_strain_varies = false;

    bool has_thermal_strain;

    /** A number for each cell of this rank, from 0 on: that of its material, as
     * the mesh file and, where formulas are constant in most cells, the moduli
     * at t = 0 tell. Fields may jump between cells with different numbers.
     * Materials that meet nowhere, nor a third one, may share a number: there
     * are few numbers, however many materials. Collective.
     * @return by active cell index. */
    std::vector<unsigned int>
    materials_of_cells(const Space<dim>           &space,
                       const QuadratureField<dim> &points) const;

    /** Bytes of what a state has besides that which does not vary. */
    std::size_t
    memory_of_variation(const MaterialState<dim> &state) const;

    /**
     * The extreme relaxation times of all points and the given instants,
     * infinite for an elastic body. Collective.
     *
     * @param instants of one period, in their order.
     * @param period in units of time.
     * @throw SceneError like at().
     */
    RelaxationTimes
    relaxation_times(const std::vector<double> &instants,
                     const double               period) const;

    /** The largest magnitude among the components of thermal strain at all
     * points and the given instants; 0 if there is none. Collective. */
    double
    largest_thermal_strain(const std::vector<double> &instants) const;

  private:
    using Matrices   = typename MaterialState<dim>::Matrices;
    using Vectors    = typename MaterialState<dim>::Vectors;
    using FreeStrain = typename MaxwellLaw<dim>::FreeStrain;

    template <typename Value>
    bool
    varies_in_space(const Property<Value> &property) const
    {
      for (const char *variable : {"x", "y", "z", "material"})
        if (property.depends_on(variable))
          return true;
      return property.depends_on("theta") && temperature.depends_on_space();
    }

    template <typename Value>
    bool
    varies_in_time(const Property<Value> &property) const
    {
      return property.depends_on("t") ||
             (property.depends_on("theta") && temperature.depends_on_time());
    }

    bool
    thermal_strain_varies_in_space() const
    {
      return std::any_of(free_strains.begin(),
                         free_strains.end(),
                         [this](const FreeStrain *strain) {
                           return varies_in_space(strain->value) ||
                                  (strain->is_thermal &&
                                   temperature.depends_on_space());
                         });
    }

    /** Where and in which material a point lies, and its temperature. */
    Place<dim>
    place(const std::size_t point,
          const double      t,
          const bool        with_temperature) const
    {
      Place<dim> place;
      place.t = t;
      if (!locations.empty())
        {
          place.point    = locations[point];
          place.material = materials[point];
        }
      if (with_temperature)
        place.temperature = temperature.value(place.point, t);
      return place;
    }

    template <typename Value>
    std::shared_ptr<const PointValues<Value>>
    evaluate(const Property<Value> &property, const double t) const;

    std::shared_ptr<const Vectors>
    evaluate_thermal_strain(const double t) const;

    /** Of the stiffness and fluidity of this state. */
    std::shared_ptr<const PointValues<CreepPower<dim>>>
    evaluate_creep_power(const MaterialState<dim> &state, const double t) const;

    RelaxationRates
    extreme_rates(const MaterialState<dim> &state) const;

    const MPI_Comm                        communicator;
    const MaxwellLaw<dim>                &law;
    const Temperature<dim>               &temperature;
    const std::vector<const FreeStrain *> free_strains; ///< not 0

    // Whether these depend on time.
    std::vector<bool> fluidity_is_free; ///< of each branch

    std::size_t                     n_points;
    std::vector<dealii::Point<dim>> locations; ///< empty if of no importance
    std::vector<unsigned int>       materials; ///< likewise
    MaterialState<dim>              constant;  ///< what does not vary
  };
} // namespace Crevasse

#endif
