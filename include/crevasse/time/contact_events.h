// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_contact_events_h
#define crevasse_time_contact_events_h

#include <crevasse/time/integrator.h>

#include <memory>
#include <vector>

namespace Crevasse
{
  /**
   * Divides the steps of another method where nodes of the lip open or close,
   * so that none of them crosses a kink of f: the method keeps its order
   * through contact (model, §2).
   *
   * A step after which nodes have switched is taken again up to the first of
   * the instants at which they did. That is found on the least switching
   * function, each value of which is the end of a trial step, by secants on
   * either side of the kink, and else by the regula falsi in the manner of
   * Anderson and Björck (BIT 13, 1973). It is found to
   * 10⁻⁷ of the step; what switches closer together counts as one event. Errors
   * of the instant count by their square, for f is continuous.
   *
   * There is no Zeno behaviour: a step is divided at most 100 times, then it
   * goes on without, which is counted.
   */
  class ContactEvents : public Integrator
  {
  public:
    explicit ContactEvents(std::unique_ptr<Integrator> &&method);

    void
    restart() override;

    void
    start(RateEquation &f,
          const double  t,
          const Vector &r,
          Vector       &rate) override;

    void
    advance(RateEquation &f,
            const double  t,
            const double  time_step,
            const Vector &rate,
            Vector       &r,
            Vector       *error) override;

    bool
    has_error_estimate() const override;

    double
    stability_limit() const override;

    bool
    has_matrix_of_step() const override;

    TimeQuadrature
    quadrature() const override;

    std::string
    description() const override;

    IntegratorStatistics
    statistics() const override;

    bool
    may_pause() const override;

    void
    serialize(StateArchive &archive) override;

  private:
    /** The beginning or the end of a trial step. */
    struct Place
    {
      double              t = 0.;
      Vector              r, rate, error;
      std::vector<double> functions; ///< of switching
    };

    /** Makes @p to the end of a trial step from @p from to the instant @p t. */
    void
    go_to(RateEquation &f, const double t, const bool estimates_error);

    /** Which nodes of `from` are watched on the way to `to`, and on which side
     * they are: 1 open, −1 closed, 0 not watched, for they switch at `from` if
     * they do.
     *
     * @param shortest what counts as one instant. */
    void
    find_sides(const double shortest);

    /** The least of the switching functions of watched nodes, with the sign
     * that makes it positive as long as none has switched. Collective. */
    double
    least_function(const Place &place) const;

    /** Goes to the first event on the way to `to`; whether it was found to
     * @p shortest. */
    bool
    locate(RateEquation &f, const double shortest, const bool estimates_error);

    const std::unique_ptr<Integrator> method;

    bool is_continuing =
      false;        ///< the next step starts where the last one ended
    Place begin;    ///< of the step
    Place from, to; ///< of its parts

    std::vector<int> sides;
    MPI_Comm         communicator = MPI_COMM_SELF;
    double           rounding     = 0.; ///< of the switching functions

    std::size_t events = 0, trials = 0, missed = 0, given_up = 0;
  };
} // namespace Crevasse

#endif
