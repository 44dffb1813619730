// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_net_slip_h
#define crevasse_periodic_net_slip_h

#include <crevasse/lip/contact_boundary.h>
#include <crevasse/periodic/contraction.h>
#include <crevasse/time/observer.h>

namespace Crevasse
{
  /**
   * Net slip: how much a period changes the tangential jump of each pair of
   * nodes. It vanishes in the limit if the lips shake down or slide to and fro,
   * and repeats if they ratchet, while the stress is periodic in both cases.
   * The net slip is known when the next period begins.
   */
  template <int dim>
  class NetSlip : public Observer
  {
  public:
    /** @param lip must outlive this object. */
    explicit NetSlip(const ContactBoundary<dim> &lip);

    /** Collective at the beginning of a period. */
    void
    observe(const Sample &sample) override;

    void
    serialize(StateArchive &archive) override;

    /** Estimated error of the last known net slip, relative to scale(): by the
     * Contraction of the net slips, as if their limit were 0, or of their
     * changes, whichever is smaller. nan if it is unknown. */
    double
    error() const
    {
      return estimate;
    }

    /** Largest change of a tangential jump within one period so far, or largest
     * normal jump. Slip that dies out does not make it smaller, and slip that
     * adds up from period to period does not make it larger. Collective. */
    double
    scale() const
    {
      return dealii::Utilities::MPI::max(largest, lip.communicator());
    }

  private:
    using Jumps = std::vector<std::vector<double>>; // by tangent and node

    /** Compares the net slip of the period that ends with that before. */
    void
    end_period(const Jumps &jumps, const double largest_displacement);

    const ContactBoundary<dim> &lip;

    Jumps        begin; ///< jumps at the beginning of the period
    Jumps        net;   ///< net slip of the last period that is known
    unsigned int n_begun  = 0;
    double       largest  = 0.; ///< part of this rank in scale()
    double       estimate = std::numeric_limits<double>::quiet_NaN();
    Contraction  vanishing, repeating;
  };
} // namespace Crevasse

#endif
