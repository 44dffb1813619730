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

    /** f(r,t) */
    virtual void
    rate(const double t, const Vector &r, Vector &rate) = 0;

    /**
     * f(r,t) for the r that satisfies r = r̂ + c f(r,t): the stage of a
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
     * The same with the displacement of a predicted r instead of that of r:
     * only the material is implicit, and A stays what it is.
     */
    virtual void
    semi_implicit_rate(const double  t,
                       const Vector &predicted,
                       const Vector &known,
                       const double  c,
                       Vector       &rate) = 0;

    /** How each point relaxes over a time c where the strain is held: v ←
     * φ(−cL) v, φ₁ or φ₂ by @p order, with L(t) = k w/η₀ HK. */
    virtual void
    apply_relaxation(const unsigned int order,
                     const double       t,
                     const double       c,
                     Vector            &values) = 0;

    /** The largest stress of the elastic body over a period, in the root mean
     * square over its volume: what tolerances are relative to. */
    virtual double
    stress_scale() const = 0;

    /** For each entry of r what it takes to change the root mean square of the
     * stress over the volume by 1 where the strain is held: the norm of an
     * error of r divided by this is the error of the stress. (At a crack tip
     * the largest stress depends on the mesh, and of nonlinear creep it relaxes
     * at once.)
     *
     * @param[out] scale with the layout of r; given its size here. */
    virtual void
    strain_per_stress(const Vector &r, Vector &scale) const = 0;

    /** The largest rate at which the stress of the last evaluation relaxes
     * where the strain is held, if that depends on the stress; otherwise 0, for
     * the material tells it beforehand. Collective. */
    virtual double
    relaxation_rate() const = 0;

    /** How often the equation was evaluated. */
    virtual std::size_t
    n_evaluations() const = 0;

    /** φ = u_N − gap − κg of each contact node of this rank in the last
     * evaluation, κ > 0: positive where the lip is open, negative where it is
     * closed, continuous in between. */
    virtual void
    switching_functions(std::vector<double> &values) const = 0;
  };
} // namespace Crevasse

#endif
