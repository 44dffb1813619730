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
   * The material and the contact system of any instant. With a stiffness that
   * is constant but for a factor there is one system for all of them. Otherwise
   * each instant has its own. Where r is implicit there is one for each κ (see
   * AlgorithmicModuli), and for each instant if K or H varies freely. Caches
   * keep them.
   */
  template <int dim>
  class ContactSystemCache : public InstantProvider<dim>
  {
  public:
    /** All arguments must outlive this object.
     *
     * @param choice of the solvers for this body.
     * @param largest_load of a node over a period: see largest_load(). */
    ContactSystemCache(const Scene        &scene,
                       const Body<dim>    &body,
                       const SolverChoice &choice,
                       const StepList     &steps,
                       const double        largest_load,
                       Log                &log);

    // Its parts refer to one another.
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
    tangent_at(const double t, const double c, const Vector &stress) override;

    Tangent<dim>
    renew_tangent(const double t, const double c, const Vector &stress) override
    {
      return use(t, tangents.renew(t, c, stress));
    }

    const RelaxationFunctions<dim> &
    relaxation_at(const double t, const double c) override;

    /** The matrix, without its factor, and the contact problem of an instant.
     * It lasts until the next one is asked for. */
    ContactSystem<dim> &
    system_at(const double t);

    /** See SolverSettings. */
    SolverSettings settings;

    /** The factor of projected SOR for a matrix: what the scene says, or the
     * best one for the given loads. */
    double
    relaxation_factor(const SparseMatrix &matrix, const Vector &loads) const;

    /** Of all systems that there were. */
    SolverStatistics
    statistics() const;

    /** Shows the state of the contact solvers of all instants; those of a run
     * that is resumed are made first. */
    void
    serialize(StateArchive &archive);

    /** Counts what another system of this run has done. */
    void
    add(const SolverStatistics &other)
    {
      of_the_past.add(other);
    }

    /** Which solvers there are and why, how often they were called and what it
     * took. */
    void
    summarise(Summary &summary) const
    {
      last_system->describe(summary);
      statistics().add_to(summary);
    }

  private:
    std::shared_ptr<ContactSystem<dim>>
    make_system(const typename MaterialState<dim>::Matrices &stiffness) const;

    /** Of such a tangent, whose system is the last one now. */
    Tangent<dim>
    use(const double t, const typename KeptTangents<dim>::Kept &kept);

    /** What a system was asked for. */
    struct Request
    {
      enum Kind
      {
        of_stiffness,
        of_implicit_stage,
        of_tangent
      } kind;
      double t, c;
    };

    ContactSystem<dim> &
    system_of(const Request &request);

    /** Of what depends on a time c. */
    std::pair<double, double>
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
    std::optional<double>               sor_factor;  ///< once it was searched
    std::shared_ptr<ContactSystem<dim>> only_system; ///< constant stiffness
    std::shared_ptr<ContactSystem<dim>> last_system;
    SolverStatistics                    of_the_past;
    std::vector<Request> requests; ///< of the systems in the cache, as made
    Request              last_request{Request::of_stiffness, 0., 0.};

    // What belongs to instants. A system is not dropped for a material.
    InstantMemory                          memory;
    InstantCache<MaterialState<dim>>       materials;
    InstantCache<AlgorithmicModuli<dim>>   moduli;
    InstantCache<RelaxationFunctions<dim>> relaxation;
    InstantCache<ContactSystem<dim>>       systems; ///< of K, or of moduli
    KeptTangents<dim>                      tangents;

    std::shared_ptr<const RelaxationFunctions<dim>> last_relaxation;
  };
} // namespace Crevasse

#endif
