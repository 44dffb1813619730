// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_prescribed_motion_h
#define crevasse_harmonic_balance_prescribed_motion_h

#include <crevasse/harmonic_balance/fourier_problem.h>
#include <crevasse/time/integrator.h>
#include <crevasse/time/observer.h>


namespace Crevasse
{
  /**
   * Goes through a motion that is known already as if it were integrated: each
   * state is evaluated by its own contact problem, shown, and compared with the
   * motion. What was solved for all instants at once is so verified instant by
   * instant, by what marches use.
   */
  class PrescribedMotion : public Integrator, public Observer
  {
  public:
    /** @param motion at the beginnings of equal steps; it must outlive this
     * object.
     * @param rule by which it was found.
     * @param step from one instant to the next.
     * @param diameter of the body: strains are small beside displacements over
     * it.
     * @param largest_load at a node. */
    PrescribedMotion(const PeriodicMotion &motion,
                     const TimeRule        rule,
                     const double          step,
                     const double          diameter,
                     const double          largest_load);

    void
    start(RateEquation &f,
          const double  t,
          const Vector &r,
          Vector       &rate) override;

    /** Only from the beginning of one step to the next. */
    void
    advance(const TimeStep &step) override;

    void
    observe(const Sample &sample) override;

    void
    serialize(StateArchive &archive) override;

    /** Largest difference of displacement, contact force or, by the trapezoidal
     * rule, viscous strain to what the motion says, relative to the largest
     * value of its kind. Collective; for a whole period. */
    double
    largest_defect() const;

  private:
    const PeriodicMotion &motion;
    const TimeRule        rule;

    /** The number of the instant @p t, from 0; N at the end of the period. */
    unsigned int
    number(const double t) const
    {
      return std::lround(t / step);
    }

    /** Takes the defect of the trapezoidal rule in the step that ends at
     * instant @p end. */
    void
    compare_step(const unsigned int end, const Vector &r, const Vector &rate);

    const double step, diameter;
    Vector       first_rate, last_rate, defect;

    /** A difference and the size of what differs. */
    struct Difference
    {
      double largest = 0., size = 0.;
      void
      add(const double a, const double b)
      {
        largest = std::max(largest, std::abs(a - b));
        size    = std::max(size, std::abs(a));
      }
    };
    Difference displacement, force, viscous_strain;
  };
} // namespace Crevasse

#endif
