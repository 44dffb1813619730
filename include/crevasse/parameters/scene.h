// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_scene_h
#define crevasse_parameters_scene_h

#include <crevasse/parameters/parameters.h>

namespace Crevasse
{
  /** Everything that the user specifies for one run. */
  struct Scene
  {
    std::string  title;
    unsigned int dimension = 2;
    /** Empty: `results/NAME` for NAME.prm. */
    std::string output_directory;

    GeometryParameters        geometry;
    BoundaryParameters        boundary;
    MaterialParameters        material;
    LoadParameters            loads;
    DiscretisationParameters  discretisation;
    RefinementParameters      refinement;
    ContactParameters         contact;
    LinearSolverParameters    linear_solver;
    TimeIntegrationParameters time_integration;
    PeriodicStateParameters   periodic_state;
    CrackTipParameters        crack_tip;
    OutputParameters          output;

    /** A body of revolution: x is the radius, y the axis. */
    bool
    is_axisymmetric() const
    {
      return dimension == 2 && material.plane_state == PlaneState::axisymmetric;
    }

    void
    add_parameters(dealii::ParameterHandler &prm);

    /** Each section's own check, and what only several sections together can
     * tell (number of load components, steps within the period, ...). */
    void
    check(Problems &problems) const;
  };

  /** The parameters that have another value than their default, but cannot
   * have an effect beside the others of their scene: a sentence for each, with
   * the reason. The scene must have passed its check. */
  std::vector<std::string>
  unused_parameters(const Scene &scene);
} // namespace Crevasse

#endif
