// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_lip_closure_h
#define crevasse_postprocess_lip_closure_h

#include <crevasse/lip/lip_status.h>
#include <crevasse/model/body.h>
#include <crevasse/time/evolution.h>
#include <crevasse/time/observer.h>

namespace Crevasse
{
  /**
   * lip.csv: fraction of the last period in which each contact node, and each
   * lip as a whole, is closed, and their openings. A node with a contact force
   * is closed: a lip that touches without force, as at rest or if the flow
   * leaves the least opening undetermined, is open. A lip is a connected set of
   * faces.
   *
   * The instants at which a lip becomes, or ceases to be, wholly open or closed
   * are found after the last period, to 10⁻⁶ of a step: the variational
   * inequality is solved between two samples, with the loads of that instant
   * and a viscous strain that is cubic in time, by its values and rates at both
   * samples. A node changes where the
   * straight line through its last two pressures, or openings, vanishes; half
   * way if that is much later, as at jumps.
   */
  template <int dim>
  class LipClosure : public Observer
  {
  public:
    /** Collective. References must outlive the LipClosure.
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

    /** Checks after the first period that contact holds every part.
     * @throw NumericalError, see require_held(). */
    void
    end_of_period(const PeriodReport &report) override;

    void
    serialize(StateArchive &archive) override;

    /** Finds the instants of change after the last period, and shows the states
     * at them to all observers. Collective. */
    void
    find_changes(const std::vector<std::unique_ptr<Observer>> &observers);

    /** Writes the table, and adds "closed_part" of all lips together to the
     * summary. Collective. */
    void
    summarise(Summary &summary) override;

    /** Reason why an instant of change was not found; empty: all found. */
    std::string failure;

    /** Status in the last period of the lip that begins at a tip, available
     * after find_changes(). */
    std::vector<LipMoment>
    lip_at(const dealii::Point<dim> &tip) const;

  private:
    /** A step of the last period in which a lip changes. Without viscosity
     * strains are empty. */
    struct Change
    {
      unsigned int period; ///< number of the period
      double       begin, end;
      double       begin_of_period; ///< time since the start of the run
      Vector       strain_at_begin, strain_at_end;
      /** Rates less the mean rate of the step, 0 where they are far from it, as
       * of branches that relax within the step. Empty until they are needed. */
      Vector rate_at_begin = {}, rate_at_end = {};
      /** Tangential jumps from which slip counts; empty without friction. */
      std::vector<std::vector<double>> committed = {};
    };

    /** State of the contact nodes of all ranks at an instant: the opening of
     * each, or minus its pressure if it has one. */
    struct Moment
    {
      double              instant;
      std::vector<double> openings;
    };

    /** Computes Moment::openings, of the periodic state if a flow is split off.
     * Collective. */
    std::vector<double>
    openings(const Sample &sample);

    /** Least and largest opening of a lip, or of all if @p lip is n_lips. */
    std::pair<double, double>
    range(const unsigned int lip, const Moment &moment) const;

    LipStatus
    status(const unsigned int lip, const Moment &moment) const;

    std::vector<LipMoment>
    period_of(const unsigned int lip) const;

    /** Sample at an instant within a step in which a lip changes, valid until
     * the next call. Collective. */
    Sample
    sample_at(const double instant);

    /** Finds the rates at the ends of a step. Collective. */
    void
    find_rates(Change &step);

    /** Adds moments at which a lip starts or ceases to be wholly open or closed
     * in a step. Collective. */
    void
    locate(const Change &step, const unsigned int lip);

    /** Time for which a node is closed between the i-th moment and the next. */
    double
    closed_time(const unsigned int node, const unsigned int i) const;

    const Body<dim>          &body;
    const std::string         file_name;
    Evolution<dim>           &evolution;
    std::vector<unsigned int> places; ///< index in LipBasis of each node
                                      ///< with unknowns
    unsigned int n_lips = 0;

    /** Rates of opening of the flow that is split off, once it is known. */
    std::optional<std::vector<double>> rates;

    std::vector<Moment> period; ///< moments of last period
    std::vector<Change> changes;
    Vector              strain; ///< at the last sample, or last solved for
    /** Jumps from which slip counts after the last sample. */
    std::vector<std::vector<double>> committed;
  };
} // namespace Crevasse

#endif
