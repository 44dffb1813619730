// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/time/anderson_acceleration.h>
#include <crevasse/time/creep_stage.h>

#include <cmath>
#include <limits>
#include <optional>

namespace Crevasse
{
  template <int dim>
  CreepStage<dim>::CreepStage(const StrainOperator<dim> &strain_operator,
                              const ExternalLoads<dim>  &loads,
                              InstantProvider<dim>      &instants,
                              const double               tolerance)
    : strain_operator(strain_operator)
    , loads(loads)
    , instants(instants)
    , tolerance(tolerance)
  {
    strain_operator.initialize(forces);
    strain_operator.initialize(next);
  }



  template <int dim>
  typename CreepStage<dim>::Visit *
  CreepStage<dim>::visit_at(const double t)
  {
    constexpr double rounding = 1e-9;
    const auto       found    = path.lower_bound(t * (1. - rounding));
    return found != path.end() && found->first <= t * (1. + rounding)
             ? &found->second
             : nullptr;
  }



  template <int dim>
  void
  CreepStage<dim>::predict(const double t, Vector &displacement)
  {
    const Visit *visit = visit_at(t);
    if (visit == nullptr)
      {
        last.reinit(0);
        return;
      }
    if (last.size() > 0)
      {
        displacement += visit->displacement;
        displacement -= last;
      }
    last = visit->displacement;
  }



  template <int dim>
  void
  CreepStage<dim>::keep(const double t, const Vector &displacement)
  {
    if (t < last_t / 2.) // stages of one step may be in any order
      {
        for (auto visit = path.begin(); visit != path.end();)
          visit = visit->second.period < period ? path.erase(visit)
                                                : std::next(visit);
        ++period;
      }
    Visit *visit                          = visit_at(t);
    (visit != nullptr ? *visit : path[t]) = {displacement, period};
    last_t                                = t;
  }



  template <int dim>
  void
  CreepStage<dim>::evaluate(Stage &stage, Vector &right_hand_side)
  {
    using Field            = QuadratureField<dim>;
    const auto     &law    = *stage.known.material.creep;
    const auto     &moduli = *stage.tangent.moduli;
    const auto     &known  = stage.known;
    const double    k      = stage.state.stiffness_factor;
    const Stopwatch watch("strain sweeps");
    // An error on one rank must not interrupt the sweep, which communicates.
    std::optional<NumericalError> not_found;
    excess.reinit(stage.state.stress, true);
    strain_operator.for_each_strain(
      stage.state.displacement,
      [&](const std::size_t offset, const VoigtVector<dim> &strain) {
        const std::size_t point = offset / Field::n_components;
        try
          {
            const VoigtVector<dim> stress =
              law[point].relaxed_stress(strain - known.free(offset),
                                        known.viscous(offset),
                                        k,
                                        stage.log_kappa);
            Field::set(stage.state.stress, offset, stress);
            Field::set(excess, offset, k * (moduli[point] * strain) - stress);
          }
        catch (const NumericalError &error)
          {
            not_found = error;
          }
      });
    collectively(forces.get_mpi_communicator(), [&not_found]() {
      if (not_found)
        throw *not_found;
    });
    right_hand_side = forces;
    strain_operator.add_transpose(right_hand_side,
                                  [this](const std::size_t offset) {
                                    return Field::get(excess, offset);
                                  });
  }



  template <int dim>
  void
  CreepStage<dim>::cut_step(Stage &stage)
  {
    constexpr unsigned int most   = 20;
    constexpr double       enough = 0.5, margin = 0.1;

    Vector &q   = stage.state.displacement;
    Vector  way = q;
    way -= before;
    // Slope of the potential along the step, at a fraction of it.
    const auto slope = [&](const double part) {
      q = before;
      q.add(part, way);
      evaluate(stage, next);
      Vector unbalanced = forces;
      strain_operator.add_transpose(unbalanced, [&](const std::size_t offset) {
        return -1. * QuadratureField<dim>::get(stage.state.stress, offset);
      });
      return -(unbalanced * way);
    };
    double       low = 0., high = 1., of_high = slope(1.), of_low = slope(0.);
    const double goal = enough * std::abs(of_low);
    if (of_low >= 0.)
      return; // not a direction of descent
    for (unsigned int i = 0; i < most && of_high > goal; ++i)
      {
        const double zero = of_low / (of_low - of_high);
        const double part =
          low + std::clamp(zero, margin, 1. - margin) * (high - low);
        const double here = slope(part);
        if (std::abs(here) <= goal)
          return;
        (here < 0. ? low : high)       = part;
        (here < 0. ? of_low : of_high) = here;
      }
    slope(high);
  }



  template <int dim>
  ContactSolver &
  CreepStage<dim>::iterate(Stage       &stage,
                           const double enough,
                           Vector      &right_hand_side)
  {
    constexpr unsigned int                   most = 100;
    constexpr double                         slow = 0.2;
    constexpr AndersonAcceleration::Settings combined{4};

    State &state = stage.state;
    evaluate(stage, right_hand_side);
    std::optional<AndersonAcceleration> acceleration(combined);
    double residual = std::numeric_limits<double>::infinity();
    for (unsigned int iteration = 0; iteration < most; ++iteration)
      {
        const double   last_residual = residual;
        ContactSolver &solver        = *stage.tangent.contact_solver;
        before                       = state.displacement;
        solver.solve(right_hand_side,
                     state.displacement,
                     state.contact_forces,
                     state.stiffness_factor,
                     state.friction.reference.empty() ? nullptr
                                                      : &state.friction);
        evaluate(stage, next);
        acceleration->add(right_hand_side, next);
        right_hand_side -= next;
        residual =
          solver.relative_to_forces(right_hand_side, state.stiffness_factor);
        if (residual <= enough)
          {
            right_hand_side += next;
            if (enough <= tolerance) // not in stages of smaller c
              solver.note_newton_residual(residual);
            return solver;
          }
        if (residual <= slow * last_residual)
          {
            acceleration->extrapolate(right_hand_side);
            continue;
          }
        if (!(residual <= last_residual))
          cut_step(stage);
        stage.tangent =
          instants.renew_tangent(stage.t, stage.c, state.stress, stage.known.r);
        evaluate(stage, right_hand_side);
        acceleration.emplace(combined);
      }
    throw NumericalError(
      Text::Message()
      << "Newton's method leaves a residual of " << residual
      << " of the largest nodal force after " << most
      << " iterations at t = " << stage.t
      << ". Take shorter steps, [Time integration] Step control = adaptive, or "
         "a larger Newton tolerance.");
  }



  template <int dim>
  ContactSolver &
  CreepStage<dim>::solve(const double  t,
                         const Vector &known,
                         const Vector *base,
                         const double  c,
                         State        &state,
                         Vector       &right_hand_side)
  {
    constexpr double loose = 1e-2, shorter = 0.1, longer = 4., least = 1e-16;

    loads.evaluate(t, forces);
    predict(t, state.displacement);
    state.instant = t;
    State  solved = state;
    double from = 0., to = c; // c of the last solution, and of the next one
    bool   has_failed = false;
    while (true)
      {
        const MaterialState<dim> &material = instants.material_at(t);
        state.stiffness_factor             = material.stiffness_factor;
        try
          {
            Stage          stage{t,
                        to,
                        std::log(material.kappa(to)),
                        InelasticStrain<dim>(material, known, base),
                        // The tangent of a failed trial is useless.
                        has_failed
                                   ? instants.renew_tangent(t, to, state.stress, known)
                                   : instants.tangent_at(t, to, state.stress, known),
                        state};
            ContactSolver &solver =
              iterate(stage, to < c ? loose : tolerance, right_hand_side);
            if (to == c)
              {
                keep(t, state.displacement);
                return solver;
              }
            has_failed = false;
            solved     = state;
            from       = to;
            to         = std::min(c, longer * to);
          }
        catch (const NumericalError &)
          {
            state = solved;
            to    = from > 0. ? std::sqrt(from * to) : shorter * to;
            if (to < least * c || to < (1. + 0.01) * from)
              throw;
            has_failed = true;
          }
      }
  }



  template <int dim>
  double
  CreepStage<dim>::rates(const InelasticStrain<dim> &known,
                         const double                c,
                         const Vector               &stress,
                         Vector                     &rate)
  {
    using Field                        = QuadratureField<dim>;
    const MaterialState<dim> &material = known.material;
    double                    all      = 0.;
    for (std::size_t offset = 0; offset < stress.locally_owned_size();
         offset += known.n)
      {
        const auto here =
          (*material.creep)[offset / known.n].rate(Field::get(stress, offset),
                                                   Field::get(known.r, offset),
                                                   material.stiffness_factor,
                                                   material.kappa(c));
        all = std::max(all, here.of_relaxation);
        Field::set(rate, offset, here.of_state / material.viscosity_factor);
      }
    return all / material.viscosity_factor;
  }



  template <int dim>
  void
  CreepStage<dim>::serialize(StateArchive &archive)
  {
    std::vector<std::pair<double, unsigned int>> visits;
    for (const auto &[t, visit] : path)
      visits.emplace_back(t, visit.period);
    archive.common(visits);
    archive.common(last_t);
    archive.common(period);
    bool has_last = last.size() > 0;
    archive.common(has_last);
    for (const auto &[t, in_period] : visits)
      {
        Visit &visit = path[t];
        visit.period = in_period;
        if (archive.is_loading())
          strain_operator.initialize(visit.displacement);
        archive.nodal(visit.displacement);
      }
    if (!has_last)
      return;
    if (archive.is_loading())
      strain_operator.initialize(last);
    archive.nodal(last);
  }



  template class CreepStage<2>;
  template class CreepStage<3>;
} // namespace Crevasse
