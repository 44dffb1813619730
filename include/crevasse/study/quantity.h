// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_study_quantity_h
#define crevasse_study_quantity_h

#include <crevasse/app/command_line.h>
#include <crevasse/base/expression.h>
#include <crevasse/parameters/scene.h>

#include <memory>
#include <string>
#include <vector>

namespace Crevasse
{
  /** Something whose error a sweep measures. */
  struct Quantity
  {
    /** As the user writes it: "stress", or "probe_C/s_22". */
    std::string name;
    /** What it is compared with instead of the reference run; null: nothing. */
    std::shared_ptr<const Expression> exact;

    /** Whether it is the stress at all quadrature points, not a column. */
    bool
    is_stress_field() const;

    /** "probe_C" of "probe_C/s_22". */
    std::string
    table() const;

    /** "s_22" of "probe_C/s_22". */
    std::string
    column() const;

    /** Whether a column of that table belongs to it; "u" and "s" of a probe
     * stand for all displacements and all stresses. */
    bool
    selects(const std::string &other) const;
  };

  /**
   * The quantities of a sweep: those of --error and --exact, or, where there is
   * a reference but no --error, the stress, u and s of every probe, and the
   * contact force.
   *
   * @param scenes of the sweep, the reference's or base scene first.
   * @throw SceneError with all that is wrong with them, also if there is
   * nothing to compare with.
   */
  std::vector<Quantity>
  choose_quantities(const SweepRequest               &request,
                    const std::vector<const Scene *> &scenes);
} // namespace Crevasse

#endif
