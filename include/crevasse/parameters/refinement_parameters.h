// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_refinement_parameters_h
#define crevasse_parameters_refinement_parameters_h

#include <crevasse/base/problems.h>
#include <crevasse/parameters/selections.h>

#include <deal.II/base/parameter_handler.h>

#include <vector>

namespace Crevasse
{
  /** How the mesh is refined besides [Geometry] Refinements. */
  struct RefinementParameters
  {
    static constexpr const char *section = "Refinement";

    RefinementStrategy strategy = RefinementStrategy::none;
    /** Refinement ends when the mesh has them; 0: no limit. */
    unsigned int target_unknowns = 0;
    /** tip: levels; adaptive: meshes after the first. 0: by the target. */
    unsigned int cycles           = 0;
    Marking      marking          = Marking::bulk;
    double       refine_fraction  = 0.5;
    double       coarsen_fraction = 0.;
    /** Estimated error of the stress in the energy norm, relative to that of
     * the stress, at which cycles end; 0: none. */
    double tolerance = 0.;
    /** Instants within the period that the estimate looks at; none: those of
     * the largest load and of the most opposite one. */
    std::vector<double> instants;
    /** Periods after which the mesh is adapted again; 0: never. */
    unsigned int readapt_every = 0;

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
  };
} // namespace Crevasse

#endif
