// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_scene_h
#define crevasse_parameters_scene_h

#include <crevasse/parameters/parameters.h>
#include <crevasse/parameters/table_parameters.h>

namespace Crevasse
{
  /** All parameters of a run. */
  struct Scene
  {
    std::string  title;
    unsigned int dimension = 2;
    std::string  units; ///< names for Units
    /** Output directory; empty: `results/NAME` for NAME.prm. */
    std::string output_directory;

    TableParameters           tables;
    GeometryParameters        geometry;
    BoundaryParameters        boundary{{tables.functions}};
    MaterialParameters        material{{tables.functions}};
    LoadParameters            loads{{tables.functions}};
    DiscretisationParameters  discretisation;
    RefinementParameters      refinement;
    ContactParameters         contact;
    LinearSolverParameters    linear_solver;
    TimeIntegrationParameters time_integration;
    PeriodicStateParameters   periodic_state;
    CrackTipParameters        crack_tip{{tables.functions}};
    OutputParameters          output;

    /** Whether the body is one of revolution: x is the radius, y the axis. */
    bool
    is_axisymmetric() const
    {
      return dimension == 2 && material.plane_state == PlaneState::axisymmetric;
    }

    void
    add_parameters(dealii::ParameterHandler &prm);

    /** Checks each section, and combinations of several sections (number of
     * load components, steps within the period, ...). */
    void
    check(Problems &problems) const;
  };

  /** Checks what depends on the roles of boundaries. */
  void
  check_roles(const Scene &scene, Problems &problems);

  /** Checks the material against dimension and plane state, with the sizes of
   * its matrices and tensors. */
  void
  check_material(const Scene &scene, Problems &problems);

  /** Non-default parameters that have no effect in a scene: a sentence for
   * each, with the reason. The scene must have passed its check. */
  std::vector<std::string>
  unused_parameters(const Scene &scene);
} // namespace Crevasse

#endif
