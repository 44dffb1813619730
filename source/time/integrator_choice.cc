// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/time/arkode.h>
#include <crevasse/time/contact_events.h>
#include <crevasse/time/integrator_choice.h>

#include <deal.II/base/numbers.h>

namespace Crevasse
{
  namespace
  {
    /** Runge–Kutta method, explicit or diagonally implicit. The last stage of
     * an implicit method is the state at the end of the step. */
    struct ButcherTableau
    {
      const char         *name;
      std::vector<double> nodes; ///< nodes c
      /** Matrix a: row s has s entries, or s + 1 if its stage is implicit. An
       * empty first row is the beginning of the step. */
      std::vector<std::vector<double>> matrix;
      std::vector<double>              weights; ///< weights b
      /** Weights b minus those of an embedded method of order 1, or empty. */
      std::vector<double> error_weights;
      /** Length of the negative real interval on which the modulus of the
       * stability function is at most 1. */
      double stability_limit;

      bool
      is_implicit() const
      {
        return matrix.back().size() == matrix.size();
      }
    };



    class RungeKutta : public Integrator
    {
    public:
      explicit RungeKutta(const ButcherTableau &tableau)
        : Integrator({tableau.name,
                      tableau.stability_limit,
                      {tableau.nodes, tableau.weights},
                      tableau.is_implicit()})
        , tableau(tableau)
        , rates(tableau.weights.size())
      {
      }

      void
      start(RateEquation &f,
            const double  t,
            const Vector &r,
            Vector       &rate) override
      {
        if (!is_continuing)
          f.rate(t, r, rate);
        else if (begins_with_rate())
          rate = rates.back();
      }

      void
      advance(const TimeStep &step) override
      {
        const auto add = [&](Vector                    &to,
                             const std::vector<double> &coefficients,
                             const unsigned int         n) {
          for (unsigned int s = 0; s < n; ++s)
            if (coefficients[s] != 0.)
              to.add(step.length * coefficients[s],
                     s == 0 && begins_with_rate() ? step.rate : rates[s]);
        };
        for (unsigned int s = begins_with_rate() ? 1 : 0; s < rates.size(); ++s)
          {
            const std::vector<double> &row = tableau.matrix[s];
            const double t = step.t + tableau.nodes[s] * step.length;
            stage          = step.r;
            add(stage, row, s);
            rates[s].reinit(step.r, true);
            if (row.size() > s)
              step.f.implicit_rate(t, stage, step.length * row[s], rates[s]);
            else
              step.f.rate(t, stage, rates[s]);
          }
        add(step.r, tableau.weights, rates.size());
        if (step.error != nullptr)
          add(*step.error, tableau.error_weights, tableau.error_weights.size());
        is_continuing = tableau.is_implicit();
      }

      void
      serialize(StateArchive &archive) override
      {
        if (!tableau.is_implicit())
          return;
        archive.common(is_continuing);
        if (begins_with_rate())
          archive.at_points(rates.back());
      }

    private:
      bool
      begins_with_rate() const
      {
        return tableau.matrix[0].empty();
      }

      const ButcherTableau tableau;
      std::vector<Vector>  rates; ///< rates of evaluated stages
      Vector               stage;
    };



    ButcherTableau
    euler()
    {
      return {"euler", {0.}, {{}}, {1.}, {}, 2.};
    }

    /** Heun's family with weight ρ: r + (1−ρ)Δt f + ρΔt f(r + Δt/(2ρ) f). ρ = ¾
     * is the paper's choice (§6.2.1), ½ the trapezoidal one, 1 the midpoint
     * rule. Euler's method is embedded. */
    ButcherTableau
    heun(const double weight)
    {
      const double c = 1. / (2. * weight);
      return {"heun",
              {0., c},
              {{}, {c}},
              {1. - weight, weight},
              {-weight, weight},
              2.};
    }

    ButcherTableau
    rk4()
    {
      // The stability limit is the root of 1 + z + z²/2 + z³/6 + z⁴/24 = 1.
      return {"rk4",
              {0., 0.5, 0.5, 1.},
              {{}, {0.5}, {0., 0.5}, {0., 0., 1.}},
              {1. / 6., 1. / 3., 1. / 3., 1. / 6.},
              {},
              2.785293563405282};
    }

    /** L-stable method of order 2 of Alexander, SIAM J. Numer. Anal. 14, 1977.
     * The embedded method has the weights (1−a, a), a = 2 − 5√2/4 (Ellsiepen,
     * 1999). */
    ButcherTableau
    sdirk2()
    {
      constexpr double gamma = 1. - dealii::numbers::SQRT1_2;
      constexpr double error = gamma - (2. - 1.25 * dealii::numbers::SQRT2);
      return {"sdirk2",
              {gamma, 1.},
              {{gamma}, {1. - gamma, gamma}},
              {1. - gamma, gamma},
              {-error, error},
              no_stability_limit};
    }

    /** Trapezoidal rule, of order 2 and A-stable: stiff components oscillate
     * instead of decaying. With equal steps its periodic state is that of
     * harmonic balance. */
    ButcherTableau
    trapezoid()
    {
      return {"trapezoid",
              {0., 1.},
              {{}, {0.5, 0.5}},
              {0.5, 0.5},
              {},
              no_stability_limit};
    }



    /**
     * Semi-implicit method of order 2, like those that the paper compares
     * (§6.2.1): Euler's method predicts r and the displacement of that r; the
     * trapezoidal rule corrects r with this displacement, implicitly in the
     * relaxing stress:
     *
     *     r* = r + Δt f(r,t)
     *     r(t + Δt) = r + ½Δt [f(r,t) + η⁻¹ s(q(r*), r(t + Δt))]
     *
     * It costs as much as Heun's method, with the same A. If all parts relax
     * alike, there is no stability limit; parts that load others cause it. With
     * an elastic part in parallel to a part with the share p of the stiffness,
     * a step multiplies the viscous strain by
     * (1 − z/2 + pz − p(1−p)z²/2) / (1 + z/2), z = Δt/τ, whose modulus is at
     * most 1 for z ≤ 6 and any p (the limit is 6 at p = 1/3).
     */
    class PredictorCorrector : public Integrator
    {
    public:
      PredictorCorrector()
        : Integrator({"predictor corrector", 6., {{0., 1.}, {}}})
      {
      }

      void
      advance(const TimeStep &step) override
      {
        Vector      &r    = step.r;
        const double half = 0.5 * step.length;
        last_rate.reinit(r, true);
        predicted = r;
        predicted.add(step.length, step.rate);
        r.add(half, step.rate);
        step.f.semi_implicit_rate(
          step.t + step.length, predicted, r, half, last_rate);
        r.add(half, last_rate);
      }

    private:
      Vector predicted, last_rate;
    };



    /**
     * Exponential Runge–Kutta method of order 2 (Cox and Matthews, J. Comput.
     * Phys. 176, 2002, ETD2RK) for the relaxation L = k w/η₀ HK of each point
     * at constant strain; the change of strain is the "nonlinear" part:
     *
     *     d = Δt φ₁(−ΔtL) f(r,t),      a = r + d
     *     r(t + Δt) = a + Δt φ₂(−ΔtL) [f(a, t + Δt) − f(r,t)]
     *                   + (I − φ₁(−ΔtL)) d
     *
     * It is exact if the strain is constant or changes uniformly, costs as much
     * as Heun's method, with the same A, and has no stability limit: with E =
     * e^(−ΔtL), W = I − φ₁ and Π the projection of strains onto compatible
     * ones, a step multiplies r by I − (I + WΠ)(I − E)(I − Π), whose
     * eigenvalues lie in [0,1] for two bodies in parallel (p² to 1 for a body
     * of share p beside one that does not flow) and did so for 60 000 random L
     * and Π of up to 8 unknowns with rates 10⁹ apart.
     */
    class ExponentialHeun : public Integrator
    {
    public:
      ExponentialHeun()
        : Integrator({"exponential", no_stability_limit, {{0., 1.}, {}}})
      {
      }

      void
      advance(const TimeStep &step) override
      {
        RateEquation &f = step.f;
        second_rate.reinit(step.r, true);
        increment = step.rate;
        f.apply_relaxation(1, step.t, step.length, increment);
        increment *= step.length;
        step.r += increment;
        f.rate(step.t + step.length, step.r, second_rate);

        // One vector collects Δt φ₂ [f(a) − f(r)] + d − φ₁ d.
        second_rate -= step.rate;
        f.apply_relaxation(2, step.t, step.length, second_rate);
        second_rate *= step.length;
        second_rate += increment;
        f.apply_relaxation(1, step.t, step.length, increment);
        second_rate -= increment;
        step.r += second_rate;
        if (step.error != nullptr)
          *step.error += second_rate;
      }

    private:
      Vector increment, second_rate; ///< d, f(a)
    };



    std::unique_ptr<Integrator>
    make_method(const TimeIntegrationParameters &parameters)
    {
      switch (parameters.scheme)
        {
          case Scheme::euler:
            return std::make_unique<RungeKutta>(euler());
          case Scheme::heun:
            return std::make_unique<RungeKutta>(heun(parameters.heun_weight));
          case Scheme::rk4:
            return std::make_unique<RungeKutta>(rk4());
          case Scheme::predictor_corrector:
            return std::make_unique<PredictorCorrector>();
          case Scheme::exponential:
            return std::make_unique<ExponentialHeun>();
          case Scheme::sdirk2:
          case Scheme::automatic:
            return std::make_unique<RungeKutta>(sdirk2());
          case Scheme::trapezoid:
            return std::make_unique<RungeKutta>(trapezoid());
          case Scheme::arkode_explicit:
          case Scheme::arkode_implicit:
            return make_arkode(parameters);
        }
      return nullptr;
    }
  } // namespace



  std::unique_ptr<Integrator>
  make_integrator(TimeIntegrationParameters parameters,
                  const bool                has_contact,
                  const bool                has_friction)
  {
    // Without events, friction leaves every scheme of order 1. A step that
    // events shorten must not cost a factorisation.
    if (has_friction && parameters.scheme == Scheme::automatic)
      {
        parameters.scheme                = Scheme::exponential;
        parameters.locate_contact_events = true;
      }
    parameters.locate_contact_events &= has_contact;
    std::unique_ptr<Integrator> method = make_method(parameters);
    if (parameters.locate_contact_events && !method->properties.controls_steps)
      return locate_contact_events(std::move(method));
    return method;
  }
} // namespace Crevasse
