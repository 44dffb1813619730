// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/contact/condensed_problem.h>
#include <crevasse/periodic/averaged_body.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  Vector
  AveragedBody<dim>::solve(const Part       &part,
                           const Vector     &strain,
                           const LipProblem &on_lip) const
  {
    using Field                     = QuadratureField<dim>;
    constexpr unsigned int n        = Field::n_components;
    constexpr double       accuracy = 1e-10;
    Vector                 load, displacement;
    body.strain_operator.initialize(load);
    body.strain_operator.initialize(displacement);
    body.strain_operator.add_transpose(load, [&](const std::size_t offset) {
      VoigtVector<dim> stress;
      for (unsigned int i = 0; i < part.moduli.size(); ++i)
        stress += part.moduli[i][offset / n] *
                  Field::get(strain, offset * part.moduli.size() + i * n);
      return stress;
    });
    LinearSolver &solver = part.system->linear_solver();
    if (shift)
      dynamic_cast<DirectSolver &>(solver).solve_with_lip(displacement,
                                                          load,
                                                          on_lip);
    else
      solver.solve(displacement, load, accuracy * load.l2_norm());
    return displacement;
  }



  template <int dim>
  typename AveragedBody<dim>::LipProblem
  AveragedBody<dim>::holding(const Part      &part,
                             const Set       &open,
                             const LipVector &values) const
  {
    return [&part, &open, &values](LipVector &on_lip) {
      const auto     &sigma = part.lip_stiffness();
      LipVector       held  = values, forces(open.size());
      PrincipalFactor factor(sigma);
      for (unsigned int k = 0; k < open.size(); ++k)
        if (open[k])
          held(k) = 0.;
      sigma.vmult(forces, held);
      on_lip -= forces;
      factor.choose(open);
      factor.solve(on_lip);
      on_lip += held;
    };
  }



  template <int dim>
  typename AveragedBody<dim>::LipProblem
  AveragedBody<dim>::flowing(LipVector &mean) const
  {
    return [&mean, this](LipVector &on_lip) {
      const auto       &sigma = flow.lip_stiffness();
      CondensedProblem  problem(sigma, sign, LipVector(sign.size()));
      LipVector         loads = on_lip;
      std::vector<bool> closed(sign.size());
      for (unsigned int k = 0; k < sign.size(); ++k)
        {
          loads(k) -= sign(k) * mean(k);
          closed[k] = mean(k) > 0.;
        }
      problem.start_from(closed);
      problem.solve(loads, on_lip);
      closed = problem.closed_pairs();
      sigma.vmult(mean, on_lip);
      mean -= loads;
      for (unsigned int k = 0; k < sign.size(); ++k)
        mean(k) = closed[k] ? std::max(0., sign(k) * mean(k)) : 0.;
    };
  }



  template <int dim>
  typename AveragedBody<dim>::LipProblem
  AveragedBody<dim>::moving(const LAPACKFullMatrix<double> &compliance,
                            const Moving                   &how,
                            const std::vector<LipVector>   &openings,
                            LipVector                      &mean) const
  {
    return [&, how, this](LipVector &on_lip) {
      const unsigned int n = sign.size();
      const auto        &S = shift->compliance();
      FullMatrix<double> B(n, n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          B(i, j) = how.part * (how.of_force * compliance(i, j) - S(i, j));
      LipVector position(n), change = mean;
      on_lip.scale(sign);
      compliance.vmult(position, on_lip);
      position *= how.part * how.of_flow;
      on_lip = shift->follow(openings, B, position, mean);
      on_lip /= how.part;
      change.sadd(-1., mean);
      S.vmult(on_lip, change, true);
      on_lip /= how.of_flow;
      on_lip.scale(sign);
    };
  }



  template <int dim>
  template <typename Function>
  void
  AveragedBody<dim>::change(const Vector   &displacement,
                            Vector         &values,
                            const Function &f) const
  {
    using Field = QuadratureField<dim>;
    body.strain_operator.for_each_strain(
      displacement,
      [&](const std::size_t offset, const VoigtVector<dim> &strain) {
        for (unsigned int i = 0; i < compliance.size(); ++i)
          {
            const std::size_t point = offset / Field::n_components;
            const std::size_t place =
              offset * compliance.size() + i * Field::n_components;
            Field::set(values,
                       place,
                       Field::get(values, place) + f(i, point, place, strain));
          }
      });
  }



  template <int dim>
  LipHistory::OnLip
  AveragedBody<dim>::take(LipHistory &history) const
  {
    LipHistory::OnLip on_lip;
    if (!shift)
      return on_lip;
    on_lip = history.take(stages, body.space.communicator());
    const LAPACKFullMatrix<double> &S = shift->compliance();
    LipVector                       by_force(sign.size());
    for (unsigned int j = 0; j < on_lip.forces.size(); ++j)
      {
        // Forces of open nodes and openings of pressed ones are rounding.
        LipVector &force = on_lip.forces[j], &opening = on_lip.openings[j];
        for (unsigned int k = 0; k < sign.size(); ++k)
          if (opening(k) >= S(k, k) * force(k))
            force(k) = 0.;
        S.vmult(by_force, force);
        opening -= by_force;
      }
    return on_lip;
  }



  template <int dim>
  void
  AveragedBody<dim>::find_step(const Vector &increment,
                               LipHistory   &lip,
                               Vector       &step,
                               Vector       &residual)
  {
    using Field = QuadratureField<dim>;
    const Stopwatch    watch("averaged body");
    const unsigned int n = sign.size();
    Set                open(n, true), open_in_mean(n);
    const auto         on_lip = take(lip);
    for (const LipVector &force : on_lip.forces)
      for (unsigned int k = 0; k < n; ++k)
        open[k] = open[k] && force(k) == 0.;
    LipVector mean(n), moved(n);
    if (shift)
      mean = shift->mean(on_lip.forces);
    LipVector force_change = mean;

    // β, or B of a spring
    Vector compatible =
      solve(flow,
            increment,
            spring > 0. && shift ? moving(shift->compliance(),
                                          {1. / spring, 1. / spring},
                                          on_lip.openings,
                                          mean)
                                 : flowing(mean));
    if (spring > 0.)
      compatible /= spring;
    residual = increment;
    change(compatible,
           residual,
           [&](const unsigned int      i,
               const std::size_t       point,
               const std::size_t       place,
               const VoigtVector<dim> &strain) {
             const VoigtVector<dim> F = Field::get(increment, place);
             if (spring > 0.)
               return compliance[i][point] * (flow.moduli[i][point] * F) +
                      strain;
             return compliance[i][point] *
                      (flow.moduli[i][point] * (F - strain)) -
                    strain;
           });
    for (unsigned int k = 0; k < n; ++k)
      open_in_mean[k] = mean(k) == 0.;
    if (pole.system != nullptr)
      change(solve(pole, increment, holding(pole, open_in_mean, moved)),
             residual,
             [&](const unsigned int      i,
                 const std::size_t       point,
                 const std::size_t       place,
                 const VoigtVector<dim> &strain) {
               return -0.5 * (compliance[i][point] *
                              (pole.moduli[i][point] *
                               (Field::get(increment, place) - strain)));
             });
    step = residual;

    force_change.sadd(-1., mean);
    if (shift && spring == 0. && force_change.linfty_norm() > 0.)
      {
        moved = shift->solve(on_lip.openings, mean);
        shift->compliance().vmult(moved, force_change, true);
        moved.scale(sign);
        moved *= -1.;
      }
    for (unsigned int k = 0; k < n; ++k)
      open[k] = open[k] && open_in_mean[k];
    const auto add_strain = [](const double factor) {
      return
        [factor](const unsigned int,
                 const std::size_t,
                 const std::size_t,
                 const VoigtVector<dim> &strain) { return factor * strain; };
    };
    const auto without_rigid = [&](const unsigned int i,
                                   const std::size_t  point,
                                   const std::size_t  place,
                                   const VoigtVector<dim> &) {
      return -1. * (compliance[i][point] *
                    (rigid.moduli[i][point] * Field::get(residual, place)));
    };
    if (rigid.system != nullptr)
      {
        change(solve(rigid, residual, holding(rigid, open, moved)),
               residual,
               add_strain(-1.));
        change(compatible, residual, add_strain(1.));
        change(compatible, residual, without_rigid);
        step  = residual;
        moved = 0.;
      }
    change(solve(elastic, residual, holding(elastic, open, moved)),
           residual,
           add_strain(-1.));
    if (spring > 0. || rigid.system != nullptr)
      return;
    step = residual;
    change(compatible, step, add_strain(1.));
  }



  template <int dim>
  Vector
  AveragedBody<dim>::jump(const Vector            &increment,
                          const LipHistory::OnLip &on_lip,
                          const unsigned int       n)
  {
    using Field          = QuadratureField<dim>;
    const JumpPart &now  = part_of_jump(n);
    const double    part = 1. - 1. / n;
    LipVector       mean;
    if (shift)
      mean = shift->mean(on_lip.forces);
    Vector step = increment;
    change(solve(now.part,
                 increment,
                 moving(now.compliance,
                        {double(n), 1., part},
                        on_lip.openings,
                        mean)),
           step,
           [&](const unsigned int      i,
               const std::size_t       point,
               const std::size_t       place,
               const VoigtVector<dim> &strain) {
             return part * n *
                    (compliance[i][point] *
                       (now.part.moduli[i][point] *
                        (Field::get(increment, place) - strain)) +
                     strain);
           });
    return step;
  }



  template <int dim>
  void
  AveragedBody<dim>::remove_compatible(Vector &strain) const
  {
    const Set       open(sign.size(), false);
    const LipVector moved(sign.size());
    change(solve(elastic, strain, holding(elastic, open, moved)),
           strain,
           [](const unsigned int,
              const std::size_t,
              const std::size_t,
              const VoigtVector<dim> &own) { return -1. * own; });
  }



  template <int dim>
  double
  AveragedBody<dim>::largest_stress(const Vector &strain) const
  {
    using Field         = QuadratureField<dim>;
    double      largest = 0.;
    std::size_t place   = 0;
    const auto  include = [&largest](const VoigtVector<dim> &stress) {
      for (unsigned int c = 0; c < Field::n_components; ++c)
        largest = std::max(largest, std::abs(stress[c]));
    };
    for (std::size_t p = 0; p < body.points.n_local_points; ++p)
      {
        VoigtVector<dim> sum;
        for (const Matrices &of_branch : elastic.moduli)
          {
            const VoigtVector<dim> stress =
              of_branch[p] * Field::get(strain, place);
            include(stress);
            sum += stress;
            place += Field::n_components;
          }
        include(sum);
      }
    return averaged.largest_factor *
           Utilities::MPI::max(largest, body.space.communicator());
  }



#define INSTANTIATE(dim)                                                        \
  template void              AveragedBody<dim>::find_step(const Vector &,       \
                                             LipHistory &,         \
                                             Vector &,             \
                                             Vector &);            \
  template Vector            AveragedBody<dim>::jump(const Vector &,            \
                                          const LipHistory::OnLip &, \
                                          const unsigned int);       \
  template LipHistory::OnLip AveragedBody<dim>::take(LipHistory &) const;       \
  template void   AveragedBody<dim>::remove_compatible(Vector &) const;         \
  template double AveragedBody<dim>::largest_stress(const Vector &) const

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
