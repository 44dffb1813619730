// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_contact_onset_h
#define crevasse_postprocess_contact_onset_h

#include <crevasse/base/log.h>
#include <crevasse/discretisation/contact_boundary.h>
#include <crevasse/time/observer.h>
#include <crevasse/time/secular_flow.h>

#include <utility>
#include <vector>

namespace Crevasse
{
  /**
   * The time t₀ after which the contact conditions of the whole displacement
   * u = βt + q agree with those of the periodic part q (paper, §5.1 and the
   * comment on P2): the nodes of the lip that the flow opens, β_N > 0, bear
   * nothing in the periodic state, but touch as long as β_N t is less than what
   * q swings. The constant in q is free; with the mean value zero, as the paper
   * has it,
   *
   *     t₀ = max (gap − min q_N) / β_N     over these nodes, at least 0.
   */
  template <int dim>
  class ContactOnset : public Observer
  {
  public:
    ContactOnset(const ContactBoundary<dim> &lip,
                 const SecularFlow          &flow,
                 Log                        &log);

    void
    observe(const Sample &sample) override;

    void
    serialize(StateArchive &archive) override;

    /** summary.json "secular": when the lip is free of the flow's start. */
    void
    summarise(Summary &summary) override;

  private:
    /** Nodes that the flow opens, on all ranks. Collective. */
    unsigned int
    n_opening_nodes() const;

    /** t₀ from the q of the last period, which must have ended. Collective. */
    double
    onset() const;

    /** The mean of the contact force over the last period, and that of the
     * secular problem: equal in the periodic state but for the steps' error, if
     * η₀ is constant. Collective. */
    std::pair<double, double>
    mean_forces() const;

    /** The last instant at which one of these nodes was pressed; −1: none was,
     * or what was computed was q, whose contact is another one. Collective. */
    double
    last_contact() const;

    /** A node with β_N > 0. */
    struct OpeningNode
    {
      unsigned int index; ///< in the lip
      double       rate;  ///< β_N
      // Of q_N in this period.
      double least = 0., integral = 0., last = 0.;
    };

    const ContactBoundary<dim> &lip;
    const MPI_Comm              communicator;
    Log                        &log;
    std::vector<OpeningNode>    nodes;

    double last_instant = 0., pressed = -1.;
    double last_force = 0., impulse = 0.; ///< of this rank's nodes
    double secular_force = 0.;
  };
} // namespace Crevasse

#endif
