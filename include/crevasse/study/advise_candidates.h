// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_study_advise_candidates_h
#define crevasse_study_advise_candidates_h

#include <crevasse/parameters/assignments.h>
#include <crevasse/parameters/scene.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /** One choice of the settings in time, or of those in space. */
  struct AdviseCandidate
  {
    std::string           name; ///< in the names of folders
    std::string           text; ///< for people
    std::vector<Override> settings;
    std::string           scheme; ///< of the time integration; none in space
  };

  /** Candidates of one kind, each more accurate than the one before it and
   * dearer. */
  struct AdviseFamily
  {
    std::string                  text;
    std::vector<AdviseCandidate> candidates;
    /** What the work is multiplied with from one to the next. */
    double growth = 2.;
    /** How many may be refused before one that is not: a step may be too long,
     * and a cell too large for what is computed around a crack tip. */
    unsigned int refusals_that_pass = 0;
    /** Whether all cells are halved from one to the next, and nothing else is
     * done about singularities. */
    bool halves_cells = false;
  };

  /** "Section/Name=value" as advise sets it. */
  Override
  advised(const std::string &assignment);

  /** What the loads do in one step of the scene may end at a step: numbers of
   * steps are this one, doubled again and again. */
  unsigned int
  fewest_steps(const Scene &scene);

  /** Schemes with equal steps, each doubling their number, and one with steps
   * by tolerance. */
  std::vector<AdviseFamily>
  families_in_time(const Scene &scene);

  /** Those of a scheme, which must be among them. */
  const AdviseFamily &
  family_of(const std::string               &scheme,
            const std::vector<AdviseFamily> &in_time);

  /** Elements of both degrees on meshes that are halved, graded to the tip,
   * adapted, or with singular functions: those that make sense at all. */
  std::vector<AdviseFamily>
  families_in_space(const Scene &scene);
} // namespace Crevasse

#endif
