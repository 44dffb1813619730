// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_rate_equation_h
#define crevasse_time_rate_equation_h

#include <crevasse/base/vector.h>

#include <vector>

namespace Crevasse
{
  /** The ODE ṙ = f(r,t) as integrators see it. */
  class RateEquation
  {
  public:
    virtual ~RateEquation() = default;

    /** Computes f(r,t). */
    virtual void
    rate(const double t, const Vector &r, Vector &rate) = 0;

    /**
     * Computes f(r,t) for the solution r of r = r̂ + c f(r,t): the stage of a
     * diagonally implicit method, with c = γΔt > 0.
     *
     * @param known r̂
     */
    virtual void
    implicit_rate(const double  t,
                  const Vector &known,
                  const double  c,
                  Vector       &rate) = 0;

    /**
     * Computes implicit_rate() with the displacement of a predicted r: only
     * the material is implicit, and A does not change.
     */
    virtual void
    semi_implicit_rate(const double  t,
                       const Vector &predicted,
                       const Vector &known,
                       const double  c,
                       Vector       &rate) = 0;

    /** Applies the relaxation of each point over a time c at constant strain:
     * v ← φ(−cL) v, φ₁ or φ₂ by @p order, with L(t) = k w/η₀ HK. */
    virtual void
    apply_relaxation(const unsigned int order,
                     const double       t,
                     const double       c,
                     Vector            &values) = 0;

    /** Largest root mean square over the volume of the elastic stress in a
     * period: the reference of relative tolerances. */
    virtual double
    stress_scale() const = 0;

    /** Computes the change of each entry of r that changes the root mean square
     * of the stress over the volume by 1 at constant strain: the norm of an
     * error of r, divided by the scale, is the error of the stress. (The
     * largest stress would depend on the mesh at a crack tip.)
     *
     * @param[out] scale values in the layout of r; resized here. */
    virtual void
    strain_per_stress(const Vector &r, Vector &scale) const = 0;

    /** Largest relaxation rate at constant strain in the last evaluation, if it
     * depends on the stress; otherwise 0. Collective. */
    virtual double
    relaxation_rate() const = 0;

    /** Number of evaluations of the equation. */
    virtual std::size_t
    n_evaluations() const = 0;

    /** Ends an increment of friction with the last evaluation: slip counts from
     * its jumps from now on. Evaluating it again gives the same. */
    virtual void
    commit()
    {
    }

    /** Tangential jumps of the last commit(), a list for each tangent; empty
     * without friction. */
    virtual std::vector<std::vector<double>>
    committed_jumps() const
    {
      return {};
    }

    /** Returns to the jumps of an earlier commit(). */
    virtual void
    return_to(const std::vector<std::vector<double>> &)
    {
    }

    /** Computes φ = u_N − gap − κg, κ > 0, of each contact node of this rank in
     * the last evaluation: positive where the lip is open, negative where it is
     * closed, continuous in time. With friction also, as a second list,
     * ψ = κμg − |κg_T − δ| with the slip δ since the last commit(): positive
     * where closed lips stick, negative where they slide, 0 where they are
     * open. */
    virtual void
    switching_functions(std::vector<std::vector<double>> &values) const = 0;
  };
} // namespace Crevasse

#endif
