// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_prescribed_motion_h
#define crevasse_harmonic_balance_prescribed_motion_h

#include <crevasse/base/state_archive.h>
#include <crevasse/harmonic_balance/fourier_problem.h>
#include <crevasse/time/integrator.h>
#include <crevasse/time/observer.h>

namespace Crevasse
{
  /**
   * Steps through a known motion as if it were integrated: each state is
   * computed by its own contact problem, shown, and compared with the motion.
   * So a solution for all instants at once is verified instant by instant, by
   * the methods that march() uses.
   */
  class PrescribedMotion : public Integrator, public Observer
  {
  public:
    /** @param motion at the beginnings of equal steps; it must outlive the
     * PrescribedMotion.
     * @param rule by which the motion was found.
     * @param step from one instant to the next.
     * @param diameter of the body: strains are compared with displacement over
     * diameter.
     * @param largest_load at a node. */
    PrescribedMotion(const PeriodicMotion &motion,
                     const HarmonicRule    rule,
                     const double          step,
                     const double          diameter,
                     const double          largest_load)
      : Integrator(
          {"harmonic balance", no_stability_limit, {{0., 1.}, {0.5, 0.5}}})
      , motion(motion)
      , rule(rule)
      , step(step)
      , diameter(diameter)
    {
      force.size = largest_load;
    }

    void
    start(RateEquation &f,
          const double  t,
          const Vector &r,
          Vector       &rate) override
    {
      f.rate(t, r, rate);
      if (number(t) == 0)
        first_rate = rate;
      viscous_strain.size =
        std::max(viscous_strain.size, step * rate.linfty_norm());
      if (is_continuing)
        compare_step(number(t), r, rate);
      last_rate = rate;
    }

    /** Advances from the beginning of one step to that of the next only. */
    void
    advance(const TimeStep &step) override
    {
      is_continuing           = true;
      const unsigned int next = number(step.t) + 1;
      step.r = motion.viscous_strain[next % motion.viscous_strain.size()];
      if (next == motion.viscous_strain.size())
        compare_step(next, step.r, first_rate);
    }

    void
    observe(const Sample &sample) override
    {
      const unsigned int j = sample.step % motion.displacement.size();
      const Vector      &q = sample.state.displacement;
      for (unsigned int i = 0; i < q.locally_owned_size(); ++i)
        displacement.add(q.local_element(i),
                         motion.displacement[j].local_element(i));
      // Under constant loads the only displacement is the secular flow.
      if (sample.secular_flow != nullptr)
        displacement.size =
          std::max(displacement.size,
                   motion.displacement.size() * step *
                     sample.secular_flow->velocity.linfty_norm());
      // An unpressed lip has forces that are rounding of the loads.
      for (const double b : sample.right_hand_side)
        force.size = std::max(force.size, std::abs(b));
      const std::vector<double> &forces = sample.state.contact_forces.normal;
      for (unsigned int k = 0; k < forces.size(); ++k)
        force.add(forces[k], motion.contact_forces[j][k]);
    }

    void
    serialize(StateArchive &archive) override
    {
      archive.section("given motion");
      archive.common(is_continuing);
      archive.at_points(first_rate);
      archive.at_points(last_rate);
      for (Difference *difference : {&displacement, &force, &viscous_strain})
        {
          archive.maximum(difference->largest);
          archive.maximum(difference->size);
        }
    }

    /** Largest difference from the motion, over a whole period, of
     * displacement, contact force or, by the trapezoidal rule, viscous strain,
     * relative to the largest value of its kind. Collective. */
    double
    largest_defect() const
    {
      const MPI_Comm communicator =
        motion.displacement.front().get_mpi_communicator();
      // Without stress the viscous strain is rounding.
      Difference strain = viscous_strain;
      strain.size       = std::max(strain.size, displacement.size / diameter);
      double worst      = 0.;
      for (Difference all : {displacement, force, strain})
        {
          all.largest = dealii::Utilities::MPI::max(all.largest, communicator);
          all.size    = dealii::Utilities::MPI::max(all.size, communicator);
          if (all.size > 0.)
            worst = std::max(worst, all.largest / all.size);
        }
      return worst;
    }

  private:
    const PeriodicMotion &motion;
    const HarmonicRule    rule;

    /** Index of the instant @p t, from 0; N at the end of the period. */
    unsigned int
    number(const double t) const
    {
      return std::lround(t / step);
    }

    /** Records the defect of the trapezoidal rule in the step that ends at
     * instant @p end. */
    void
    compare_step(const unsigned int end, const Vector &r, const Vector &rate)
    {
      if (rule != HarmonicRule::trapezoid)
        return;
      defect = r;
      defect -= motion.viscous_strain[end - 1];
      defect.add(-0.5 * step, last_rate, -0.5 * step, rate);
      viscous_strain.largest =
        std::max(viscous_strain.largest, defect.linfty_norm());
    }

    const double step, diameter;
    Vector       first_rate, last_rate, defect;

    /** Largest difference of two fields, and their largest value. */
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
