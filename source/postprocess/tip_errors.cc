// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/stress_estimator.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/postprocess/tip_errors.h>
#include <crevasse/time/evolution.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    using Field = QuadratureField<2>;

    /** Elastic state of a body at an instant, and the dual states of linear
     * functions of its stress. */
    class DualProblem
    {
    public:
      /** The arguments must outlive the DualProblem. */
      DualProblem(const Scene            &scene,
                  const Body<2>          &body,
                  const Evolution<2>     &evolution,
                  const Instant<2>       &instant,
                  const LinearOperator   &stiffness,
                  const UnilateralBounds &bounds)
        : scene(scene)
        , body(body)
        , state(evolution.state())
        , right_hand_side(evolution.right_hand_side())
        , instant(instant)
        , stiffness(stiffness)
        , bounds(bounds)
      {
      }

      /** Error of K or T at a tip. Collective. */
      double
      error(const StressIntensity &intensity,
            const TipElasticity   &at_tip,
            const CrackMode        mode) const
      {
        const Vector              N = factor_of_stress(intensity, at_tip, mode);
        const std::vector<double> of_forces =
          mode == CrackMode::opening
            ? intensity.integral_of(mode).factors_of_forces()
            : std::vector<double>();
        const double k = instant.material.stiffness_factor;
        // A closed node bears the forces on the lips if it is moved by its
        // factor.
        Vector lips(right_hand_side), loads(right_hand_side);
        lips = 0.;
        for (std::size_t i = 0; i < of_forces.size(); ++i)
          if (state.contact_forces.normal[i] > 0.)
            lips(bounds.dofs[i]) = bounds.sign[i] * of_forces[i];
        lips.compress(VectorOperation::insert);
        stiffness.vmult(loads, lips);
        loads *= k;
        body.strain_operator.add_transpose(
          loads, [&](const std::size_t offset) {
            return stress_of(Field::get(N, offset), offset);
          });

        // A small change of the loads leaves closed lips closed.
        constexpr double part = 1e-3;
        const double     size = loads.linfty_norm();
        if (size == 0.)
          return 0.;
        const double share = part * right_hand_side.linfty_norm() / size;
        loads.sadd(share, 1., right_hand_side);
        State dual(state);
        instant.contact_solver.solve(loads,
                                     dual.displacement,
                                     dual.contact_forces,
                                     k,
                                     body.friction ? &state.friction : nullptr);
        dual.displacement -= state.displacement;
        dual.displacement.add(-share, lips);
        body.strain_operator.for_each_strain(
          dual.displacement,
          [&](const std::size_t offset, const VoigtVector<2> &strain) {
            Field::set(dual.stress,
                       offset,
                       stress_of(strain - share * Field::get(N, offset),
                                 offset));
          });
        // Singular functions are not in equilibrium in another material, nor
        // at its faces.
        const double most   = body.space.singular_shapes() != nullptr
                                ? intensity.uniform_radius()
                                : std::numeric_limits<double>::max();
        const auto   counts = [&](const unsigned int cell) {
          const auto [begin, end] = intensity.region.reach(cell);
          return begin == 0. || end < (1. - 1e-8) * most;
        };
        const double size_of_state = state.stress.l2_norm(),
                     size_of_dual  = dual.stress.l2_norm();
        return size_of_state > 0. && size_of_dual > 0.
                 ? product(dual, size_of_state / size_of_dual, counts) / share
                 : 0.;
      }

    private:
      /** Factor of the stress in K. If strains have the mean trace of a cell,
       * its own does not count: it would cause a large pressure. */
      Vector
      factor_of_stress(const StressIntensity &intensity,
                       const TipElasticity   &at_tip,
                       const CrackMode        mode) const
      {
        Vector N = intensity.factor_of_stress(mode, instant.material, at_tip);
        if (body.space.volumetric_strain != VolumetricStrain::mean)
          return N;
        const PointGeometry &points = intensity.points;
        std::vector<double>  traces(body.space.mesh().n_active_cells()),
          areas(traces.size());
        for (std::size_t p = 0; p < points.cell.size(); ++p)
          {
            traces[points.cell[p]] +=
              points.weight[p] *
              trace_of(Field::get(N, p * Field::n_components));
            areas[points.cell[p]] += points.weight[p];
          }
        for (std::size_t p = 0; p < points.cell.size(); ++p)
          {
            const std::size_t offset = p * Field::n_components;
            VoigtVector<2>    value  = Field::get(N, offset);
            const double      missing =
              traces[points.cell[p]] / areas[points.cell[p]] - trace_of(value);
            for (unsigned int d = 0; d < 3; ++d)
              value[d] += missing / 3.;
            Field::set(N, offset, value);
          }
        return N;
      }

      static double
      trace_of(const VoigtVector<2> &strain)
      {
        return strain[0] + strain[1] + strain[2];
      }

      /** Stress of a strain at an offset. */
      VoigtVector<2>
      stress_of(const VoigtVector<2> &strain, const std::size_t offset) const
      {
        return instant.material.stiffness_factor *
               ((*instant.material.stiffness)[offset / Field::n_components] *
                strain);
      }

      /** Product of the errors of the state and of a dual state, of which
       * contact forces are those of their sum.
       * @param factor that makes the dual state as large as the state.
       * @param counts whether a cell counts. */
      template <typename Function>
      double
      product(const State    &dual,
              const double    factor,
              const Function &counts) const
      {
        // Squares of sum and difference differ by four products.
        const auto of_sum        = squares(dual, factor),
                   of_difference = squares(dual, -factor);
        double sum = 0., absolute = 0.;
        for (const auto &cell : owned_cells(body.space.mesh()))
          {
            const unsigned int c = cell->active_cell_index();
            if (!counts(c))
              continue;
            const double of_cell =
              (of_sum(c) - of_difference(c)) / (4. * factor);
            sum += of_cell;
            absolute += std::abs(of_cell);
          }
        const MPI_Comm communicator = body.space.communicator();
        // Cells may cancel by chance.
        constexpr double least = 0.5;
        return std::max(std::abs(Utilities::MPI::sum(sum, communicator)),
                        least * Utilities::MPI::sum(absolute, communicator));
      }

      /** Squared errors of the cells, of the state plus a dual state times a
       * factor. */
      dealii::Vector<double>
      squares(const State &dual, const double factor) const
      {
        State all(state);
        all.stress.add(factor, dual.stress);
        all.displacement.add(factor, dual.displacement);
        const auto add = [factor](const std::vector<double> &more,
                                  std::vector<double>       &forces) {
          for (std::size_t i = 0; i < forces.size(); ++i)
            forces[i] += factor * (more[i] - forces[i]);
        };
        add(dual.contact_forces.normal, all.contact_forces.normal);
        for (unsigned int d = 0; d < all.contact_forces.tangential.size(); ++d)
          add(dual.contact_forces.tangential[d],
              all.contact_forces.tangential[d]);
        StressEstimator<2> estimator(body.space,
                                     body.points,
                                     body.lip,
                                     scene.loads);
        estimator.look_at(state.instant,
                          all.stress,
                          all.contact_forces,
                          instant.material,
                          &all.displacement);
        return estimator.largest_squares();
      }

      const Scene            &scene;
      const Body<2>          &body;
      const State            &state;
      const Vector           &right_hand_side;
      const Instant<2>        instant;
      const LinearOperator   &stiffness;
      const UnilateralBounds &bounds;
    };
  } // namespace



  std::vector<MeshErrors>
  mesh_errors_of_tips(
    const Scene                                                &scene,
    const Body<2>                                              &body,
    ContactSystemCache<2>                                      &systems,
    const StepList                                             &steps,
    const std::vector<std::unique_ptr<const CrackTipAnalysis>> &tips)
  {
    Evolution<2> evolution(body.strain_operator,
                           body.points,
                           body.loads,
                           systems);
    evolution.slide_with(body.friction);
    std::vector<MeshErrors> errors(tips.size());
    std::vector<double>     sizes(tips.size());
    for (const double t : instants_of_extreme_loads(body, steps))
      {
        evolution.elastic_state(t);
        const SignoriniProblem &problem = systems.system_at(t).problem();
        const Instant<2>        instant = systems.at(t);
        const Vector            none;
        const DualProblem       dual(
          scene, body, evolution, instant, problem.stiffness, problem.bounds);
        for (unsigned int i = 0; i < tips.size(); ++i)
          {
            const StressIntensity &intensity = tips[i]->intensity;
            const TipElasticity    at_tip    = intensity.elasticity(t);
            const auto             K =
              intensity
                .evaluate(t,
                          {1, 0, t, t, evolution.state(), none, none, nullptr},
                          instant.material,
                          at_tip)
                .intensity;
            sizes[i] = std::max(sizes[i], std::hypot(K[0], K[1]));
            for (const CrackMode mode : intensity.linear_modes())
              {
                double &error = mode == CrackMode::constant
                                  ? errors[i].of_T
                                  : errors[i].of_intensity[unsigned(mode)];
                error = std::max(error, dual.error(intensity, at_tip, mode));
              }
          }
      }
    for (unsigned int i = 0; i < tips.size(); ++i)
      {
        const StressIntensity &intensity = tips[i]->intensity;
        for (double &error : errors[i].of_intensity)
          error = std::max(sizes[i] > 0. ? error / sizes[i] : 0.,
                           intensity.error_of_known_fields());
      }
    return errors;
  }
} // namespace Crevasse
