// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_fourier_problem_h
#define crevasse_harmonic_balance_fourier_problem_h

#include <crevasse/base/summary.h>
#include <crevasse/harmonic_balance/harmonics.h>
#include <crevasse/model/contact_system_cache.h>
#include <crevasse/time/state.h>

namespace Crevasse
{
  /** A periodic motion (problem P4; model, §2) at the N instants of
   * Harmonics. */
  struct PeriodicMotion
  {
    std::vector<Vector> displacement;   ///< displacements q
    std::vector<Vector> viscous_strain; ///< viscous strains r, all branches
    /** Contact forces g for each instant and each local lip node. */
    std::vector<std::vector<double>> contact_forces;

    /** Number of instants at which each node with a mean force is closed; on
     * all ranks. */
    std::vector<unsigned int> instants_of_contact;

    unsigned int loaded_harmonics       = 0;
    unsigned int complex_factorisations = 0;
  };

  /** The periodic state found by harmonic balance, with details of its
   * solution. */
  struct FourierResult
  {
    PeriodicMotion             motion;
    std::optional<SecularFlow> flow; ///< flow; none without mean load
    HarmonicRule               rule = HarmonicRule::trapezoid;
    std::vector<std::string>   warnings;

    /** Solution of the contact problem in words; empty if there was none. */
    std::string contact;

    /** Describes the solution in lines for the log. */
    std::string
    describe() const;

    /** Adds the section "harmonic_balance". */
    void
    add_to(Summary &summary) const;
  };

  /** Reasons why harmonic balance cannot solve a scene, and what can; empty if
   * it can. Collective. */
  template <int dim>
  std::vector<std::string>
  fourier_obstacles(const Scene     &scene,
                    const Body<dim> &body,
                    const StepList  &steps);

  /** Checks that harmonic balance can solve a scene. Collective.
   * @throw SceneError with all obstacles, and what to use instead. */
  template <int dim>
  void
  require_fourier(const Scene     &scene,
                  const Body<dim> &body,
                  const StepList  &steps);

  /**
   * Finds the periodic state of a scene by harmonic balance: see Fourier. The
   * secular flow is that of the mean of the samples. Collective.
   *
   * @param smallest_relaxation_time of the material, for a warning.
   * @throw NumericalError if one of the problems is not solved.
   */
  template <int dim>
  FourierResult
  solve_fourier_problem(const Scene             &scene,
                        const Body<dim>         &body,
                        const StepList          &steps,
                        ContactSystemCache<dim> &systems,
                        const double             smallest_relaxation_time);
} // namespace Crevasse

#endif
