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

#ifndef crevasse_output_probe_h
#define crevasse_output_probe_h

#include <crevasse/discretisation/contact_boundary.h>
#include <crevasse/discretisation/space.h>
#include <crevasse/discretisation/stress_recovery.h>
#include <crevasse/scene/probe_list.h>
#include <crevasse/time/evolution.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace Crevasse
{
  /**
   * Displacement, recovered stress and, on the lip, opening and pressure at one
   * point, as weighted sums found once: following a point through time costs
   * next to nothing. Collective, whichever rank owns the point.
   */
  template <int dim>
  class ProbeEvaluator
  {
  public:
    /** @throw SceneError if the point lies outside the mesh. */
    ProbeEvaluator(const Probe<dim>           &probe,
                   const Space<dim>           &space,
                   const StressRecovery<dim>  &recovery,
                   const ContactBoundary<dim> &lip);

    const std::string &
    name() const;

    /** Whether the point lies on the crack lip. */
    bool
    on_lip() const;

    dealii::Tensor<1, dim>
    displacement(const Vector &displacement) const;

    VoigtVector<dim>
    stress(const Vector &stress) const;

    /** Opening u_N − gap and contact pressure; both 0 off the lip. */
    std::array<double, 2>
    opening_and_pressure(const State &state) const;

  private:
    using DofWeights =
      std::vector<std::pair<dealii::types::global_dof_index, double>>;

    void
    find_displacement_weights(
      const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
      const dealii::Point<dim>                                     &unit_point,
      const Space<dim>                                             &space);

    DofWeights
    nodal_weights(
      const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
      const dealii::Point<dim>                                     &unit_point,
      const StressRecovery<dim> &recovery) const;

    void
    find_lip_weights(
      const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
      const dealii::Point<dim>                                     &unit_point,
      const Space<dim>                                             &space);

    const Probe<dim>            probe;
    const MPI_Comm              communicator;
    const StressRecovery<dim>  &recovery;
    const ContactBoundary<dim> &lip;

    std::array<DofWeights, dim>                  displacement_weights;
    typename StressRecovery<dim>::PointWeights   stress_weights;
    std::vector<std::pair<unsigned int, double>> lip_weights;
    bool                                         is_on_lip  = false;
    bool                                         owns_point = false;
    dealii::Tensor<1, dim> normal; ///< inward, of the lip; on the owner
    double                 gap = 0.;
  };

  /** The evaluators of the scene's "name: x, y; …". @throw SceneError */
  template <int dim>
  std::vector<ProbeEvaluator<dim>>
  make_probes(const std::string          &probes,
              const Space<dim>           &space,
              const StressRecovery<dim>  &recovery,
              const ContactBoundary<dim> &lip);
} // namespace Crevasse

#endif
