// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_model_contact_system_cache_h
#define crevasse_model_contact_system_cache_h

#include <crevasse/discretisation/algorithmic_moduli.h>
#include <crevasse/model/contact_system.h>
#include <crevasse/model/instant_cache.h>
#include <crevasse/model/kept_tangents.h>
#include <crevasse/model/linear_choice.h>
#include <crevasse/time/instant_provider.h>
#include <crevasse/time/step_list.h>

namespace Crevasse
{
  class StateArchive;

  /**
   * Provides the material and the contact system of any instant. If the
   * stiffness is constant up to a factor, all instants share one system;
   * otherwise each instant has its own. Implicit stages have a system for each
   * κ (see AlgorithmicModuli), and for each instant if K or H varies freely.
   * Systems are cached.
   */
  template <int dim>
  class ContactSystemCache : public InstantProvider<dim>
  {
  public:
    /** The arguments must outlive the ContactSystemCache.
     *
     * @param choice of the solvers for this body.
     * @param largest_load of a node over a period: see largest_load(). */
    ContactSystemCache(const Scene        &scene,
                       const Body<dim>    &body,
                       const SolverChoice &choice,
                       const StepList     &steps,
                       const double        largest_load,
                       Log                &log);

    // Members refer to each other, so the object cannot be copied.
    ContactSystemCache(const ContactSystemCache &) = delete;

    Instant<dim>
    at(const double t) override
    {
      const MaterialState<dim> &material = material_at(t);
      return {material, system_at(t).contact_solver()};
    }

    const MaterialState<dim> &
    material_at(const double t) override;

    ImplicitInstant<dim>
    implicit_at(const double t, const double c) override;

    ImplicitInstant<dim>
    implicit_material_at(const double t, const double c) override;

    Tangent<dim>
    tangent_at(const double  t,
               const double  c,
               const Vector &stress,
               const Vector &known) override;

    Tangent<dim>
    renew_tangent(const double  t,
                  const double  c,
                  const Vector &stress,
                  const Vector &known) override
    {
      return use(t, tangents.renew(t, c, stress, known));
    }

    const RelaxationFunctions<dim> &
    relaxation_at(const double t, const double c) override;

    /** The matrix, without its factor, and the contact problem of an instant,
     * valid until the next call. */
    ContactSystem<dim> &
    system_at(const double t);

    /** Settings of all systems. */
    const SolverSettings settings;

    /** Relaxation factor of projected SOR for a matrix: the scene's, or the
     * best one for the given loads. */
    double
    relaxation_factor(const SparseMatrix &matrix, const Vector &loads) const;

    /** Statistics of all systems, past ones included. */
    SolverStatistics
    statistics() const override;

    /** Serialises the state of the contact solvers of all instants; a resumed
     * run first creates them. */
    void
    serialize(StateArchive &archive);

    /** Adds the statistics of another system of this run. */
    void
    add(const SolverStatistics &other)
    {
      of_the_past.add(other);
    }

    /** Adds names of the solvers and reasons for them to summary.json. */
    void
    describe(Summary &summary) const
    {
      last.system->describe(summary);
    }

  private:
    std::shared_ptr<ContactSystem<dim>>
    make_system(const typename MaterialState<dim>::Matrices &stiffness) const;

    /** Returns a kept tangent, and makes its system the last one. */
    Tangent<dim>
    use(const double t, const typename KeptTangents<dim>::Kept &kept);

    /** Instant and κ of an implicit stage: κ = 0 is the stiffness itself, and κ
     * < 0 the tangent nearest to the instant. */
    using Key = typename InstantCache<ContactSystem<dim>>::Key;

    static constexpr double tangent = -1.; ///< κ of all tangents

    ContactSystem<dim> &
    system_of(const Key &key);

    /** Moduli of implicit stages with this key. */
    const AlgorithmicModuli<dim> &
    moduli_of(const Key &key);

    /** Relaxation over times with this key, of the material at its instant. */
    const RelaxationFunctions<dim> &
    relaxation_of(const Key &key, const MaterialState<dim> &material);

    /** Cache key of values that depend on a time c. */
    Key
    step_key(const double              t,
             const double              c,
             const MaterialState<dim> &material) const
    {
      const bool varies =
        body.material.stiffness_varies || body.material.fluidity_varies;
      return {varies ? t : 0., material.kappa(c)};
    }

    const Scene     &scene;
    const Body<dim> &body;
    Log             &log;

    const UnilateralBounds              bounds;
    std::optional<double>               sor_factor;  ///< factor, once found
    std::shared_ptr<ContactSystem<dim>> only_system; ///< system of a constant K
    SolverStatistics                    of_the_past;

    /** The system that was asked for last: the next one starts from it. */
    struct
    {
      Key                                 key{0., 0.};
      std::shared_ptr<ContactSystem<dim>> system;
    } last;

    // Caches for instants. A system is not dropped to keep a material.
    InstantMemory                          memory;
    InstantCache<MaterialState<dim>>       materials;
    InstantCache<AlgorithmicModuli<dim>>   moduli;
    InstantCache<RelaxationFunctions<dim>> relaxation;
    InstantCache<ContactSystem<dim>>       systems; ///< systems by instant
    KeptTangents<dim>                      tangents;
  };
} // namespace Crevasse

#endif
