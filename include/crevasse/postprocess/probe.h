// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_probe_h
#define crevasse_postprocess_probe_h

#include <crevasse/discretisation/imposed_displacement.h>
#include <crevasse/discretisation/stress_recovery.h>
#include <crevasse/lip/contact_boundary.h>
#include <crevasse/parameters/probe_list.h>
#include <crevasse/time/observer.h>

namespace Crevasse
{
  /**
   * Evaluates displacement, recovered stress and, on the lip, opening and
   * pressure at one point, as weighted sums with weights computed once, so that
   * evaluation is cheap. Each rank sums over values that it owns; the sums over
   * ranks are the result.
   *
   * A point is on the lip if one of the cells around it has a lip face there.
   */
  template <int dim>
  class ProbeEvaluator
  {
  public:
    /** Finds the point. Collective.
     * @param imposed Imposed displacement; null: there is none.
     * @throw SceneError if outside the mesh. */
    ProbeEvaluator(const NamedPoint               &probe,
                   const Space<dim>               &space,
                   const StressRecovery<dim>      &recovery,
                   const ContactBoundary<dim>     &lip,
                   const ImposedDisplacement<dim> *imposed = nullptr);

    const std::string        name;
    const dealii::Point<dim> point;

    /** Whether the point lies on the crack lip. */
    bool on_lip = false;

    /** For a point on a material interface: centre of the cell whose stress is
     * used, on the left, else below, else in front. */
    std::optional<dealii::Point<dim>> side_of_interface;

    /** For a point on a crack with two lips: normal from it into the body with
     * the displacement and stress, that of a cell on the left, else below, else
     * in front. */
    std::optional<dealii::Tensor<1, dim>> side_of_crack;

    /** Velocity at the point, also of an imposed flow. Collective.
     * @param velocity as a flow holds it. */
    dealii::Tensor<1, dim>
    velocity(const Vector &velocity) const
    {
      dealii::Tensor<1, dim> sum = apply(displacement_weights, velocity);
      for (unsigned int d = 0; imposed != nullptr && d < dim; ++d)
        sum[d] += imposed->rate(displacement_weights[d].of_imposed);
      return dealii::Utilities::MPI::sum(sum, communicator);
    }

    /** Pressure at a point of the lip; 0 at other points. Collective. */
    double
    pressure(const ContactForces &contact_forces) const
    {
      return dealii::Utilities::MPI::sum(local_pressure(contact_forces),
                                         communicator);
    }

    /** Displacement with the secular flow, stress, and on the lip u_N (relative
     * to the other lip if there is one) and the pressure. */
    using Values = std::array<double, dim + n_stress_components<dim> + 2>;

    /** This rank's part of the values. */
    Values
    local_values(const Sample &sample) const;

    /** The columns of probe_<name>.csv. */
    std::vector<std::string>
    columns() const;

    /** Row of probe_<name>.csv, with the opening u_N − gap on the lip.
     *
     * @param values summed over the ranks. */
    std::vector<double>
    row(const double time, const Values &values) const;

  private:
    /** Location of a point in one of the cells around it. */
    struct Place
    {
      typename dealii::DoFHandler<dim>::active_cell_iterator cell;
      dealii::Point<dim>                                     unit_point;
      bool                                                   found = false;
      unsigned int lip_face = dealii::numbers::invalid_unsigned_int;
    };

    /** Weights for a component: of this rank's unknowns, by local index, and of
     * the functions of imposed displacements. */
    struct ComponentWeights
    {
      typename NodalFunctions<dim>::Parts of_unknowns, of_imposed;
    };
    using DisplacementWeights = std::array<ComponentWeights, dim>;

    static dealii::Tensor<1, dim>
    apply(const DisplacementWeights &weights, const Vector &displacement);
    /** Imposed displacement of this rank. */
    dealii::Tensor<1, dim>
    imposed_at(const DisplacementWeights &weights,
               const double               t,
               const double               time) const;
    double
    local_pressure(const ContactForces &contact_forces) const;

    /** Locates the point on one rank. @param on_other_lip opposite to the lip
     * found before; it may not exist. */
    Place
    find_place(const Space<dim> &space, const bool on_other_lip);

    /** Whether a cell's face is on the other lip of the crack. */
    bool
    faces_other_lip(
      const Space<dim>                                             &space,
      const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
      const unsigned int                                            face) const;

    DisplacementWeights
    displacement_at(const Place &place, const Space<dim> &space) const;
    void
    find_lip_weights(const Place &place, const Space<dim> &space);

    const MPI_Comm                        communicator;
    const StressRecovery<dim>            &recovery;
    const ContactBoundary<dim>           &lip;
    const ImposedDisplacement<dim> *const imposed; ///< null: none

    DisplacementWeights displacement_weights, other_lip_weights;
    typename StressRecovery<dim>::PointWeights stress_weights;
    /** Nodes and weights of the pressure. */
    std::vector<std::pair<unsigned int, double>> pressure_weights;

    dealii::Tensor<1, dim> normal; ///< inward normal of the lip; else 0
    double                 gap = 0.;
  };

  /** Creates the evaluators of "name: x, y; …". @throw SceneError */
  template <int dim>
  std::vector<ProbeEvaluator<dim>>
  make_probes(const std::vector<NamedPoint>  &probes,
              const Space<dim>               &space,
              const StressRecovery<dim>      &recovery,
              const ContactBoundary<dim>     &lip,
              const ImposedDisplacement<dim> *imposed = nullptr)
  {
    std::vector<ProbeEvaluator<dim>> evaluators;
    for (const NamedPoint &probe : probes)
      evaluators.emplace_back(probe, space, recovery, lip, imposed);
    return evaluators;
  }
} // namespace Crevasse

#endif
