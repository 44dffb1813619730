// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_lip_closure_h
#define crevasse_postprocess_lip_closure_h

#include <crevasse/crack_tip/crack_closure.h>
#include <crevasse/model/body.h>
#include <crevasse/time/evolution.h>
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
   * The instants at which a lip becomes, or ceases to be, wholly open or closed
   * are found after the last period, to 10⁻⁶ of a step: the variational
   * inequality is solved between two samples, with the loads of that instant
   * and a viscous strain that changes in proportion to time. A node changes
   * where the straight line through its last two pressures, or openings,
   * vanishes; half way, where that is much later, as at jumps.
   */
  template <int dim>
  class LipClosure : public Observer
  {
  public:
    /** Collective. References must outlive this object.
     * @param file_name empty on ranks that do not write.
     * @param evolution solves between samples once the run has ended. */
    LipClosure(const Body<dim>   &body,
               const std::string &file_name,
               Evolution<dim>    &evolution);

    void
    observe(const Sample &sample) override;

    void
    before_jump(const Sample &sample) override
    {
      observe(sample);
    }

    /** @throw NumericalError after the first period, see require_held(). */
    void
    end_of_period(const PeriodReport &report) override;

    void
    serialize(StateArchive &archive) override;

    /** Finds the instants of change, writes the table, and adds "closed_part"
     * of all lips together. Collective. */
    void
    summarise(Summary &summary) override;

    /** Why an instant of change was not found; empty: all were. */
    std::string failure;

    /** The last period of the lip that begins at a tip, after summarise(). */
    std::vector<LipMoment>
    lip_at(const dealii::Point<dim> &tip) const;

    /** The body at an instant within a step in which a lip changes. The sample
     * is valid until the next call. Collective. */
    Sample
    sample_at(const double instant);

  private:
    /** A step of the last period in which a lip changes. Without viscosity
     * strains are empty. */
    struct Change
    {
      double begin, end;
      Vector strain_at_begin, strain_at_end;
    };

    /** What the contact nodes of all ranks are like at an instant: the opening
     * of each, or minus its pressure where it presses. */
    struct Moment
    {
      double              instant;
      std::vector<double> openings;
    };

    /** The number of the lip of each node of LipBasis. */
    std::vector<unsigned int>
    numbers_of_lips() const;

    /** Moment::openings: those of the periodic state where a flow is split
     * off. Collective. */
    std::vector<double>
    openings(const Sample &sample) const;

    /** The least and the largest opening of a lip; of all if its number is
     * n_lips. */
    std::pair<double, double>
    range(const unsigned int lip, const Moment &moment) const;

    LipStatus
    status(const unsigned int lip, const Moment &moment) const;

    std::vector<LipMoment>
    period_of(const unsigned int lip) const;

    /** Adds moments at which a lip begins or ceases to be wholly open or
     * closed in a step. Collective. */
    void
    locate(const Change &step, const unsigned int lip);

    /** For how long a node is closed between the i-th moment and the next. */
    double
    closed_time(const unsigned int node, const unsigned int i) const;

    const Body<dim>                &body;
    const std::string               file_name;
    Evolution<dim>                 &evolution;
    const std::vector<unsigned int> lips;   ///< of the nodes of LipBasis
    std::vector<unsigned int>       places; ///< in LipBasis of nodes with
                                            ///< unknowns, which are those below
    unsigned int n_lips = 0;

    std::vector<Moment> period; ///< the last one
    std::vector<Change> changes;
    Vector              strain; ///< of the last sample, or where it was solved
  };
} // namespace Crevasse

#endif
