// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/periodic/period_map.h>
#include <crevasse/scene/problems.h>

#include <sstream>

namespace Crevasse
{
  namespace
  {
    /** An equation whose time is brought into the period. */
    class PeriodicEquation : public RateEquation
    {
    public:
      PeriodicEquation(RateEquation &equation, const StepList &steps)
        : equation(equation)
        , steps(steps)
      {
      }



      void
      rate(const double t, const Vector &r, Vector &rate) override
      {
        equation.rate(steps.within_period(t), r, rate);
      }



      void
      implicit_rate(const double  t,
                    const Vector &known,
                    const double  c,
                    Vector       &rate) override
      {
        equation.implicit_rate(steps.within_period(t), known, c, rate);
      }



      void
      semi_implicit_rate(const double  t,
                         const Vector &predicted,
                         const Vector &known,
                         const double  c,
                         Vector       &rate) override
      {
        equation.semi_implicit_rate(
          steps.within_period(t), predicted, known, c, rate);
      }



      double
      stress_scale() const override
      {
        return equation.stress_scale();
      }



      void
      strain_per_stress(const Vector &r, Vector &scale) const override
      {
        equation.strain_per_stress(r, scale);
      }



      void
      switching_functions(std::vector<double> &values) const override
      {
        equation.switching_functions(values);
      }

    private:
      RateEquation   &equation;
      const StepList &steps;
    };
  } // namespace



  template <int dim>
  PeriodMap<dim>::PeriodMap(Evolution<dim> &evolution,
                            Integrator     *integrator,
                            const StepList &steps)
    : evolution(evolution)
    , integrator(integrator)
    , step_list(steps)
  {
  }



  template <int dim>
  void
  PeriodMap<dim>::advance(const unsigned int                         period,
                          Vector                                    &r,
                          const std::function<void(const Sample &)> &observe)
  {
    PeriodicEquation f(evolution, step_list);
    if (has_memory())
      integrator->restart();
    for (unsigned int k = 0; k < step_list.n_steps(); ++k)
      {
        const double t    = step_list.instant(k);
        const double time = (period - 1) * step_list.period() + t;
        const auto   show = [&]() {
          observe({period,
                   k,
                   time,
                   evolution.state(),
                   r,
                   evolution.right_hand_side(),
                   evolution.secular_flow()});
        };
        try
          {
            if (has_memory())
              integrator->step(f, t, step_list.step(k), r, show);
            else
              {
                evolution.elastic_state(t);
                show();
              }
          }
        catch (const NumericalError &error)
          {
            std::ostringstream where;
            where << "In period " << period << ", step " << k + 1
                  << " from t = " << t << " to " << t + step_list.step(k)
                  << ": ";
            throw NumericalError(where.str() + error.what());
          }
      }
  }



  template <int dim>
  void
  PeriodMap<dim>::finish(const unsigned int                         period,
                         const Vector                              &r,
                         const std::function<void(const Sample &)> &observe)
  {
    if (has_memory())
      {
        unused_rate.reinit(r, true);
        evolution.rate(0., r, unused_rate);
      }
    else
      evolution.elastic_state(0.);
    observe({period,
             step_list.n_steps(),
             period * step_list.period(),
             evolution.state(),
             r,
             evolution.right_hand_side(),
             evolution.secular_flow()});
  }



  template <int dim>
  const StepList &
  PeriodMap<dim>::steps() const
  {
    return step_list;
  }



  template <int dim>
  bool
  PeriodMap<dim>::has_memory() const
  {
    return integrator != nullptr;
  }



  template class PeriodMap<2>;
  template class PeriodMap<3>;
} // namespace Crevasse
