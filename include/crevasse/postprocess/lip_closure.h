// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_lip_closure_h
#define crevasse_postprocess_lip_closure_h

#include <crevasse/crack_tip/crack_closure.h>
#include <crevasse/model/body.h>
#include <crevasse/time/observer.h>

namespace Crevasse
{
  /**
   * lip.csv: for which part of the last period each contact node is closed,
   * and how far it opens; and the same for each lip as a whole. A node is
   * closed where it presses: a lip that touches without a force, as at rest or
   * where its flow leaves the least opening open, is open. Lips are what faces
   * join.
   *
   * A node changes between two samples: where the straight line through its
   * last two pressures, or openings, vanishes; half way, where that is much
   * later, as at jumps.
   */
  template <int dim>
  class LipClosure : public Observer
  {
  public:
    /** Collective.
     * @param body must outlive this object.
     * @param largest_load on a node, beside which contact forces are rounding.
     * @param file_name empty on ranks that do not write. */
    LipClosure(const Body<dim>   &body,
               const double       largest_load,
               const std::string &file_name);

    void
    observe(const Sample &sample) override;

    void
    serialize(StateArchive &archive) override;

    /** Writes the table, and adds "closed_part" of all lips together. */
    void
    summarise(Summary &summary) override;

    /** Of the last period, of the lip that begins at a tip. */
    const std::vector<LipStep> &
    steps_of_lip_at(const dealii::Point<dim> &tip) const;

  private:
    /** A contact node of all ranks, and what it did in the last period. */
    struct Node
    {
      unsigned int lip;
      double       closed = 0., largest_opening = 0., largest_pressure = 0.;
    };

    /** The number of the lip of each node of LipBasis. */
    std::vector<unsigned int>
    numbers_of_lips() const;

    /** Of each node the opening, or minus the pressure where it presses.
     * Collective. */
    std::vector<double>
    openings(const State &state) const;

    void
    add_step(const double begin, const double end);

    /** When a node that has changed in a step did so. */
    double
    instant_of_change(const unsigned int node,
                      const double       begin,
                      const double       end) const;

    const Body<dim>                &body;
    const double                    negligible_force;
    const std::string               file_name;
    const std::vector<unsigned int> lips;   ///< of the nodes of LipBasis
    std::vector<Node>               nodes;  ///< those with unknowns
    std::vector<unsigned int>       places; ///< of these in LipBasis
    std::vector<unsigned int>       mine;   ///< of ContactBoundary in these

    std::vector<std::vector<LipStep>> steps; ///< by lip, then of all together

    // openings() at this sample and the two before, as far as there are.
    std::vector<double> now, before, earlier;
    /** Instant of the last sample, and how long before that the one before. */
    double last_instant = 0., last_step = 0.;
    double last_time = 0.;
  };
} // namespace Crevasse

#endif
