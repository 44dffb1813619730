// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_material_field_h
#define crevasse_discretisation_material_field_h

#include <crevasse/discretisation/imposed_displacement.h>
#include <crevasse/discretisation/point_values.h>
#include <crevasse/discretisation/quadrature_field.h>
#include <crevasse/material/creep_point.h>
#include <crevasse/material/maxwell_law.h>
#include <crevasse/material/voigt_matrix.h>
#include <crevasse/temperature/temperature.h>

#include <algorithm>

namespace Crevasse
{
  /** Material at the quadrature points at one instant: see MaxwellLaw. */
  template <int dim>
  struct MaterialState
  {
    using Matrices = PointValues<VoigtMatrix<dim>>;
    using Vectors  = PointValues<VoigtVector<dim>>;

    std::shared_ptr<const Matrices>              stiffness;   ///< K
    std::vector<double>                          fractions;   ///< wᵢ
    double                                       spring = 1.; ///< 1 − Σ wᵢ
    std::vector<std::shared_ptr<const Matrices>> fluidity;    ///< Hᵢ
    std::shared_ptr<const PointValues<CreepPoint<dim>>>
         creep;           ///< null: linear creep
    bool hardens = false; ///< whether r is a state of CreepPoint
    std::shared_ptr<const Vectors> thermal_strain; ///< f, such as χθ, or null
    /** Thermal strain minus that of the ImposedDisplacement, or null. */
    std::shared_ptr<const Vectors> free_strain;

    /** Whether stiffness and viscosity have no row 33. */
    bool plane_stress = false;

    double stiffness_factor = 1.; ///< k
    double viscosity_factor = 1.; ///< η₀

    /** Coefficient κ of the AlgorithmicModuli for a time c. */
    double
    kappa(const double c) const
    {
      return c * stiffness_factor / viscosity_factor;
    }

    /** Whether the material is one uniform Maxwell body without thermal strain,
     * the case for the shortest loops. */
    bool
    is_plain() const
    {
      return stiffness->is_uniform() && fractions.size() == 1 &&
             fractions[0] == 1. && fluidity[0]->is_uniform() &&
             creep == nullptr && free_strain == nullptr;
    }
  };

  /** Extreme relaxation times of all points, branches and instants. */
  struct RelaxationTimes
  {
    double smallest, largest; ///< infinite if no stress relaxes

    /** Upper bound of the slowest relaxation time over a period: the inverse of
     * the mean over the period of the least rate of each instant; infinite if
     * nothing relaxes. */
    double longest_in_mean;

    double mean_fluidity_factor; ///< lower bound of the mean of 1/η₀
    bool   all;                  ///< whether all stress relaxes

    /** Largest creep exponent; 1 for linear creep. For larger exponents, the
     * stress determines the rates. */
    double creep_exponent = 1.;
  };

  /**
   * Material law at the quadrature points of a body. Parts that do not depend
   * on time are evaluated once and shared by the states of all instants; parts
   * that do not depend on space are one value.
   */
  template <int dim>
  class MaterialField
  {
  public:
    /** Evaluates constant parts. Collective. All arguments must outlive it.
     * @param imposed Imposed displacement; null: there is none. */
    MaterialField(const Space<dim>               &space,
                  const QuadratureField<dim>     &points,
                  const MaxwellLaw<dim>          &law,
                  const Temperature<dim>         &temperature,
                  const ImposedDisplacement<dim> *imposed = nullptr);

    /** State of the material at an instant of the period. Collective if it
     * depends on time. @throw SceneError with the point and the instant if a
     * formula or table has no value, or one that a material cannot have. */
    MaterialState<dim>
    at(const double t) const;

    using Conversion =
      VoigtVector<dim> (CreepPoint<dim>::*)(const VoigtVector<dim> &) const;

    /** Converts an r of creep that hardens at all points, by
     * CreepPoint::strains() or, back, CreepPoint::state(). Collective. */
    void
    convert(const Conversion conversion, Vector &r) const;

    /** Sets the factors k and η₀ of a state for another instant.
     * @throw SceneError if one is not positive. */
    void
    set_factors(const double t, MaterialState<dim> &state) const
    {
      state.stiffness_factor = law.stiffness_factor(t);
      state.viscosity_factor = law.viscosity_factor(t);
    }

    // Properties that depend on time, besides the factors.
    bool stiffness_varies;
    bool fluidity_varies       = false;
    bool thermal_strain_varies = false;

    bool has_thermal_strain;

    /** Whether the state has a free strain, and whether it depends on time. */
    bool
    has_free_strain() const
    {
      return has_thermal_strain || imposed != nullptr;
    }
    bool
    free_strain_varies() const
    {
      return thermal_strain_varies || (imposed != nullptr && imposed->varies);
    }

    /** Material number of each cell of this rank, from 0 on, by the mesh file
     * and, where formulas are constant in most cells, by the moduli at t = 0.
     * Fields may jump between cells with different numbers. Materials that
     * neither meet nor have a common neighbour may share a number: there are
     * few numbers for any number of materials. Collective.
     * @return by active cell index. */
    std::vector<unsigned int>
    materials_of_cells(const Space<dim>           &space,
                       const QuadratureField<dim> &points) const;

    /** Bytes of the time-dependent parts of a state. */
    std::size_t
    memory_of_variation(const MaterialState<dim> &state) const;

    /**
     * Extreme relaxation times of all points and the given instants, infinite
     * for an elastic body. Collective.
     *
     * @param instants Instants of one period, ascending.
     * @param period Length of the period.
     * @throw SceneError like at().
     */
    RelaxationTimes
    relaxation_times(const std::vector<double> &instants,
                     const double               period) const;

    /** Largest magnitude of the components of thermal strain at all points and
     * the given instants; 0 without thermal strain. Collective. */
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

    /** Location, material and temperature of a point. */
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

    /** Thermal strain α(θ)(θ − θ_d) − α(θ_r)(θ_r − θ_d) of a mean coefficient
     * α from θ_d, with the reference θ_r: as Abaqus (*EXPANSION, ZERO) and
     * Code_Aster (R4.08.01) have it. */
    VoigtVector<dim>
    thermal_strain(const Property<VoigtVector<dim>> &expansion,
                   Place<dim>                        here) const;

    std::shared_ptr<const Vectors>
    evaluate_thermal_strain(const double t) const;

    std::shared_ptr<const Vectors>
    evaluate_free_strain(const std::shared_ptr<const Vectors> &thermal,
                         const double                          t) const;

    /** Creep law at the points, with the modes of a stiffness. */
    std::shared_ptr<const PointValues<CreepPoint<dim>>>
    evaluate_creep(const Matrices &stiffness, const double t) const;

    RelaxationRates
    extreme_rates(const MaterialState<dim> &state) const;

    const MPI_Comm                        communicator;
    const MaxwellLaw<dim>                &law;
    const Temperature<dim>               &temperature;
    const ImposedDisplacement<dim> *const imposed;      ///< null: none
    const std::vector<const FreeStrain *> free_strains; ///< non-zero ones

    // Flags of properties that depend on time.
    std::vector<bool> fluidity_is_free; ///< fluidity of each branch

    std::size_t                     n_points;
    std::vector<dealii::Point<dim>> locations; ///< empty if not needed
    std::vector<unsigned int>       materials; ///< empty if not needed
    MaterialState<dim>              constant;  ///< constant properties
  };
} // namespace Crevasse

#endif
