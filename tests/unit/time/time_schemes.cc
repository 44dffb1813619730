// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Orders of the schemes on equations with known solutions, their stability
// limits on decaying ones, events at kinks, and the relaxation times
// on which the limits are based.

#include <crevasse/base/problems.h>
#include <crevasse/material/maxwell_law.h>
#include <crevasse/material/voigt_matrix.h>
#include <crevasse/time/arkode_driver.h>
#include <crevasse/time/integrator_choice.h>
#include <crevasse/time/step_control.h>

#include <crevasse_tests/tests.h>
#include <map>

using namespace Crevasse;

namespace
{
  /** An equation without contact, and with K = 1. */
  class ScalarEquation : public RateEquation
  {
  public:
    double
    stress_scale() const override
    {
      return 1.;
    }

    void
    strain_per_stress(const Vector &r, Vector &scale) const override
    {
      scale.reinit(r, true);
      scale = 1.;
    }

    double
    relaxation_rate() const override
    {
      return 0.;
    }

    std::size_t
    n_evaluations() const override
    {
      return 0;
    }

    void
    switching_functions(std::vector<std::vector<double>> &values) const override
    {
      values.assign(1, {});
    }
  };

  /** An equation that only explicit methods can integrate. */
  class ExplicitEquation : public ScalarEquation
  {
  public:
    void
    implicit_rate(const double, const Vector &, const double, Vector &) override
    {
      AssertThrow(false, dealii::ExcNotImplemented());
    }

    void
    semi_implicit_rate(const double,
                       const Vector &,
                       const Vector &,
                       const double,
                       Vector &) override
    {
      AssertThrow(false, dealii::ExcNotImplemented());
    }

    void
    apply_relaxation(const unsigned int,
                     const double,
                     const double,
                     Vector &) override
    {
      AssertThrow(false, dealii::ExcNotImplemented());
    }
  };

  /** r' = −r² (1 + cos t): r = 1 / (1 + t + sin t). */
  class Quadratic : public ExplicitEquation
  {
  public:
    void
    rate(const double t, const Vector &r, Vector &rate) override
    {
      rate(0) = -r(0) * r(0) * (1. + std::cos(t));
    }

    static double
    solution(const double t)
    {
      return 1. / (1. + t + std::sin(t));
    }
  };

  /** r' = q − r / τ with the "displacement" q = p r / τ + F(t), so that
   * r' = F − (1 − p) r / τ, and F such that r = 1 + sin t. */
  class Relaxation : public ScalarEquation
  {
  public:
    Relaxation(const double tau, const double p)
      : tau(tau)
      , p(p)
    {
    }

    static double
    solution(const double t)
    {
      return 1. + std::sin(t);
    }

    virtual double
    load(const double t) const
    {
      return std::cos(t) + (1. - p) / tau * solution(t);
    }

    void
    rate(const double t, const Vector &r, Vector &rate) override
    {
      rate(0) = load(t) - (1. - p) / tau * r(0);
    }

    void
    implicit_rate(const double  t,
                  const Vector &known,
                  const double  c,
                  Vector       &rate) override
    {
      rate(0) =
        (load(t) - (1. - p) / tau * known(0)) / (1. + c * (1. - p) / tau);
    }

    void
    semi_implicit_rate(const double  t,
                       const Vector &predicted,
                       const Vector &known,
                       const double  c,
                       Vector       &rate) override
    {
      const double q = p / tau * predicted(0) + load(t);
      rate(0)        = (q - known(0) / tau) / (1. + c / tau);
    }

    void
    apply_relaxation(const unsigned int order,
                     const double,
                     const double c,
                     Vector      &values) override
    {
      const double z     = -c / tau;
      const double first = std::expm1(z) / z;
      values *= order == 1 ? first : (first - 1.) / z;
    }

  private:
    const double tau, p;
  };

  /** By its name, with all else as it is by default. */
  std::unique_ptr<Integrator>
  make(const std::string &name, const double heun_weight = 0.75)
  {
    TimeIntegrationParameters parameters;
    parameters.scheme      = value_of<Scheme>(name);
    parameters.heun_weight = heun_weight;
    return make_integrator(parameters, false);
  }

  double
  integrate(Integrator        &scheme,
            RateEquation      &equation,
            const double       start,
            const double       end,
            const unsigned int n_steps)
  {
    Vector r(1), rate(1);
    r(0) = start;
    scheme.restart();
    for (unsigned int k = 0; k < n_steps; ++k)
      {
        scheme.start(equation, end * k / n_steps, r, rate);
        scheme.advance({equation, end * k / n_steps, end / n_steps, rate, r});
      }
    return r(0);
  }

  /** With @p n_steps and twice as many on [0,2]. */
  template <typename Equation>
  void
  check_order(const std::string &name,
              Integrator        &scheme,
              Equation           equation,
              const unsigned int order,
              const unsigned int n_steps = 160)
  {
    double errors[2];
    for (unsigned int i = 0; i < 2; ++i)
      errors[i] = std::abs(
        integrate(
          scheme, equation, equation.solution(0.), 2., n_steps * (i + 1)) -
        equation.solution(2.));
    check_below(name + ": |order - " + std::to_string(order) + "|",
                std::abs(std::log2(errors[0] / errors[1]) - order),
                0.1);
  }

  /** Two bodies in parallel, without load. The first has the share p of the
   * stiffness, the second does not flow. */
  class Parallel : public Relaxation
  {
  public:
    explicit Parallel(const double p)
      : Relaxation(1., p)
    {
    }

    double
    load(const double) const override
    {
      return 0.;
    }
  };

  /** How much of r = 1 is left of r' = -(1 - p) r after n steps. */
  double
  what_is_left(Integrator        &scheme,
               const double       p,
               const double       time_step,
               const unsigned int n_steps)
  {
    Parallel equation(p);
    return std::abs(
      integrate(scheme, equation, 1., n_steps * time_step, n_steps));
  }

  void
  check_bound(const std::string &name, Integrator &scheme, const double p = 0.)
  {
    const double limit = scheme.properties.stability_limit;
    check(name + ": decays below its limit, grows above",
          what_is_left(scheme, p, 0.99 * limit, 1000) < 1. &&
            what_is_left(scheme, p, 1.01 * limit, 1000) > 1.);
  }

  void
  check_no_bound(const std::string &name, Integrator &scheme)
  {
    bool decays = scheme.properties.stability_limit > 1e300;
    for (const double p : {0., 1. / 3., 0.9})
      for (const double time_step : {3., 30., 300.})
        decays = decays && what_is_left(scheme, p, time_step, 100) < 1.;
    check(name + ": decays with any step", decays);
  }

  void
  check_predictor_corrector()
  {
    const std::unique_ptr<Integrator> made   = make("predictor corrector");
    Integrator                       &scheme = *made;
    bool                              decays = true;
    for (double p = 0.; p < 1.; p += 1. / 64.)
      decays = decays && what_is_left(scheme,
                                      p,
                                      0.99 * scheme.properties.stability_limit,
                                      1000) < 1.;
    check("predictor corrector: decays below its limit whatever the shares",
          decays);
    check_bound("predictor corrector, shares 1:2", scheme, 1. / 3.);
  }

  void
  check_l_stability()
  {
    const std::unique_ptr<Integrator> made   = make("sdirk2");
    Integrator                       &scheme = *made;
    Parallel                          equation(0.);
    check_below("sdirk2: what a step of 1e6 relaxation times leaves",
                std::abs(integrate(scheme, equation, 1., 1e6, 1)),
                1e-5);
    Relaxation fast(1e-9, 0.6);
    check_below("sdirk2: error of steps of 1e7 relaxation times",
                std::abs(integrate(scheme, fast, fast.solution(0.), 2., 160) -
                         fast.solution(2.)),
                1e-9);
  }

  /** r' = |cos t| r: the "contact" has a kink wherever cos t changes its sign.
   */
  class Kinks : public ExplicitEquation
  {
  public:
    void
    rate(const double t, const Vector &r, Vector &rate) override
    {
      last_time = t;
      rate.equ(std::abs(std::cos(t)), r);
    }

    void
    switching_functions(std::vector<std::vector<double>> &values) const override
    {
      // One that switches 10⁻¹¹ later, and one that rounding switches.
      values = {{std::cos(last_time),
                 std::cos(last_time - 1e-11),
                 1e-17 * std::sin(1e5 * last_time)}};
    }

    static double
    solution(const double t)
    {
      // ∫|cos| up to 2 < 3π/2
      return std::exp(2. - std::sin(t));
    }

  protected:
    double last_time = 0.;
  };

  std::unique_ptr<Integrator>
  rk4_with_events()
  {
    TimeIntegrationParameters parameters;
    parameters.scheme                = Scheme::rk4;
    parameters.locate_contact_events = true;
    return make_integrator(parameters, true);
  }

  /** 200 nodes that switch one after the other within a step. */
  class ManyKinks : public Kinks
  {
  public:
    void
    switching_functions(std::vector<std::vector<double>> &values) const override
    {
      Kinks::switching_functions(values);
      for (unsigned int k = 0; k < 200; ++k)
        values.front().push_back(last_time - 0.6 - 0.001 * k);
    }
  };

  std::size_t
  count(const Integrator &scheme, const std::string &name)
  {
    for (const auto &[key, number] : scheme.statistics())
      if (key == name)
        return number;
    return 0;
  }

  void
  check_contact_events()
  {
    const auto error = [](const unsigned int n_steps, Integrator &scheme) {
      Kinks equation;
      return std::abs(integrate(scheme, equation, 1., 2., n_steps) -
                      equation.solution(2.));
    };
    std::map<unsigned int, double> errors; // by the number of steps
    for (const unsigned int n : {1, 20, 40})
      {
        const std::unique_ptr<Integrator> scheme = rk4_with_events();
        errors[n]                                = error(n, *scheme);
        check("steps: " + std::to_string(n) +
                ", one event of two functions that switch together",
              count(*scheme, "contact_events") == 1 &&
                count(*scheme, "steps_with_too_many_events") == 0);
      }
    check_below("rk4 with events through a kink: |order - 4|",
                std::abs(std::log2(errors[20] / errors[40]) - 4.),
                0.2);

    ManyKinks                         equation;
    const std::unique_ptr<Integrator> scheme = rk4_with_events();
    const double r = integrate(*scheme, equation, 1., 2., 4);
    check("events without end: a step is divided 100 times, which is counted",
          count(*scheme, "steps_with_too_many_events") == 1 &&
            count(*scheme, "contact_events") == 101);
    check_below("events without end: error",
                std::abs(r / equation.solution(2.) - 1.),
                1e-3);
  }

  TimeIntegrationParameters
  arkode(const std::string &kind, const unsigned int order)
  {
    TimeIntegrationParameters parameters;
    parameters.scheme = value_of<Scheme>("arkode " + kind);
    parameters.order  = order;
    return parameters;
  }

  void
  check_arkode()
  {
    for (const std::string kind : {"explicit", "implicit"})
      {
        for (const unsigned int order : {2, 3, 4, 5})
          {
            const auto        parameters = arkode(kind, order);
            const std::string name =
              "arkode " + kind + ", order " + std::to_string(order);
            check_order(name,
                        *make_integrator(parameters, false),
                        Relaxation(0.5, 0.6),
                        order,
                        order < 4 ? 320 : 20);
            if (kind == "explicit")
              check_bound(name, *make_integrator(parameters, false));
            else
              check_no_bound(name, *make_integrator(parameters, false));
          }

        double least = 1e300, largest = 0.;
        for (const double tolerance : {1e-4, 1e-6, 1e-8})
          {
            auto parameters               = arkode(kind, 4);
            parameters.step_control       = StepControlType::adaptive;
            parameters.relative_tolerance = tolerance;
            const auto   scheme           = make_integrator(parameters, false);
            Relaxation   equation(0.5, 0.6);
            const double error = std::abs(
              integrate(*scheme, equation, equation.solution(0.), 2., 4) -
              equation.solution(2.));
            least   = std::min(least, error / tolerance);
            largest = std::max(largest, error / tolerance);
          }
        check("arkode " + kind + ": errors follow the tolerance",
              largest < 10. && least > 1e-3);
      }
  }

  /** φ₁ and φ₂ of a matrix with known eigenvectors, and of one whose
   * eigenvalues are far apart. */
  void
  check_phi_functions()
  {
    for (const double size : {1e-9, 0.3, 7., 1e4, 1e12})
      {
        const std::string name = "rates of " + std::to_string(size) + ": ";
        // Eigenvalues size (1, 1) and 3 size (1, −1).
        VoigtMatrix<2> rate;
        rate[0][0] = rate[1][1] = 2. * size;
        rate[0][1] = rate[1][0]   = -size;
        const PhiFunctions<2> phi = decay_functions<2>(rate);
        const auto first  = [](const double z) { return std::expm1(z) / z; };
        const auto second = [&](const double z) {
          return z > -1e-3 ? 0.5 + z / 6. + z * z / 24. : (first(z) - 1.) / z;
        };
        const auto worst = [&](const VoigtMatrix<2> &value, const auto &f) {
          const double sum        = value[0][0] + value[0][1];
          const double difference = value[0][0] - value[0][1];
          return std::max(std::abs(sum / f(-size) - 1.),
                          std::abs(difference / f(-3. * size) - 1.));
        };
        check_below(name + "phi_1, relative error",
                    worst(phi.first, first),
                    1e-13);
        check_below(name + "phi_2, relative error",
                    worst(phi.second, second),
                    1e-11);
      }
  }

  /** A rate that no step resolves, or one that is not there at all. */
  class Hopeless : public ExplicitEquation
  {
  public:
    explicit Hopeless(const bool throws)
      : throws(throws)
    {
    }

    void
    rate(const double t, const Vector &, Vector &rate) override
    {
      if (throws && t > 0.5)
        throw NumericalError("no rate beyond 0.5");
      rate(0) = throws ? 1. : 1e6 * std::sin(1e15 * t);
    }

  private:
    const bool throws;
  };

  std::string
  failure_of_arkode(const bool throws)
  {
    auto parameters         = arkode("explicit", 4);
    parameters.step_control = StepControlType::adaptive;
    const auto scheme       = make_integrator(parameters, false);
    Hopeless   equation(throws);
    try
      {
        integrate(*scheme, equation, 1., 2., 4);
      }
    catch (const NumericalError &error)
      {
        return error.what();
      }
    return "";
  }

  void
  check_failures_of_arkode()
  {
    const auto contains = [](const std::string &text, const char *words) {
      return text.find(words) != std::string::npos;
    };
    check("arkode: what f throws comes through C code as it is",
          failure_of_arkode(true) == "no rate beyond 0.5");
    check("arkode: what no step resolves is reported, with a parameter",
          contains(failure_of_arkode(false),
                   "[Time integration] Relative tolerance"));
    bool all_advise = true;
    for (int code = -45; code < 0; ++code)
      {
        const std::string text = describe_arkode_failure(code, 1.5, "");
        all_advise =
          all_advise && contains(text, "t = 1.5") &&
          (contains(text, "[Time integration]") || contains(text, "Scheme =") ||
           contains(text, "contact problem"));
      }
    check("arkode: every error code has its time and its advice", all_advise);
  }

  double
  relaxation_rate(const MaterialParameters &material)
  {
    const MaxwellLaw<2> law(material);
    return relaxation_rates<2>(law.branches[0].fluidity.at(Place<2>()),
                               law.stiffness.at(Place<2>()))
      .largest;
  }

  void
  check_relaxation_times()
  {
    MaterialParameters material;
    material.young_modulus   = "13000";
    material.poisson_ratio   = "0.2";
    material.relaxation_time = "60";
    for (const PlaneState state :
         {PlaneState::plane_stress, PlaneState::plane_strain})
      {
        material.plane_state = state;
        check_below(name_of(state) + ", proportional flow: tau_min / tau - 1",
                    std::abs(relaxation_rate(material) * 60. - 1.),
                    1e-12);
      }

    // Deviatoric flow with its own modulus: shear relaxes with 2 mu / (2
    // mu_eta)
    material.viscosity             = ViscosityType::isotropic;
    material.viscous_modulus       = "3000";
    material.viscous_poisson_ratio = "0.5";
    const double mu = 13000. / 2.4, mu_flow = 3000. / 3.;
    check_below("plane strain, deviatoric flow: tau_min mu / mu_flow - 1",
                std::abs(relaxation_rate(material) * mu_flow / mu - 1.),
                1e-12);
  }

  /** Whose stages are found in short steps alone. */
  class NearStages : public Relaxation
  {
  public:
    using Relaxation::Relaxation;

    void
    implicit_rate(const double  t,
                  const Vector &known,
                  const double  c,
                  Vector       &rate) override
    {
      if (c > 1e-3)
        throw NumericalError("The stage was not found.");
      Relaxation::implicit_rate(t, known, c, rate);
    }
  };

  void
  check_steps_that_fail(const std::string &scheme)
  {
    TimeIntegrationParameters parameters;
    parameters.scheme             = value_of<Scheme>(scheme);
    parameters.step_control       = StepControlType::adaptive;
    parameters.steps_per_period   = 1;
    parameters.relative_tolerance = 0.1;
    StepList   steps(parameters, 2.);
    const auto integrator =
      control_steps(make_integrator(parameters, false), parameters, steps, 1.);
    NearStages equation(0.5, 0.6);
    Vector     r(1), rate(1);
    r(0) = equation.solution(0.);
    integrator->begin_period();
    for (unsigned int k = 0; k < steps.n_steps(); ++k)
      {
        const double t = steps.instant(k);
        integrator->start(equation, t, r, rate);
        integrator->advance({equation, t, steps.step(k), rate, r});
      }
    check_below(scheme + ", error where stages of long steps are not found",
                std::abs(r(0) - equation.solution(2.)),
                1e-4);
  }

  void
  check_step_list()
  {
    TimeIntegrationParameters parameters;
    parameters.scheme       = Scheme::heun;
    parameters.step_control = StepControlType::list;
    parameters.steps        = {0.1, 0.4};
    StepList steps(parameters, 1.);
    check("a list is completed by 0 and the period",
          steps.n_steps() == 3 && steps.instant(0) == 0. &&
            steps.instant(3) == 1.);
    check("an instant of the next period falls into this one",
          std::abs(steps.within_period(1.25) - 0.25) < 1e-15 &&
            steps.within_period(1.) == 0. &&
            steps.within_period(1. - 1e-16) == 0.);
    const auto refused = [&](const double tau) {
      try
        {
          control_steps(make_integrator(parameters, false),
                        parameters,
                        steps,
                        tau);
          return false;
        }
      catch (const NumericalError &)
        {
          return true;
        }
    };
    check("the largest step 0.6 is refused for tau = 0.3, taken for 0.3001",
          refused(0.3) && !refused(0.3001));
  }
} // namespace

void
time_schemes()
{
  const auto check_explicit = [](const std::string                 &name,
                                 const std::unique_ptr<Integrator> &scheme,
                                 const unsigned int                 order) {
    check_order(name, *scheme, Quadratic(), order);
    check_bound(name, *scheme);
  };
  check_explicit("euler", make("euler"), 1);
  for (const double weight : {0.5, 0.75, 1.})
    check_explicit("heun with weight " + std::to_string(weight),
                   make("heun", weight),
                   2);
  check_explicit("rk4", make("rk4"), 4);
  const Relaxation relaxation(0.5, 0.6);
  check_order("predictor corrector",
              *make("predictor corrector"),
              relaxation,
              2);
  check_predictor_corrector();
  for (const std::string name : {"sdirk2", "trapezoid", "exponential"})
    {
      check_order(name, *make(name), relaxation, 2);
      check_no_bound(name, *make(name));
    }
  check_l_stability();
  check_arkode();
  check_failures_of_arkode();
  check_contact_events();
  check_phi_functions();
  check_relaxation_times();
  for (const std::string name : {"sdirk2", "arkode implicit"})
    check_steps_that_fail(name);
  check_step_list();
}
