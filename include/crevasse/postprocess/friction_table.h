// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_friction_table_h
#define crevasse_postprocess_friction_table_h

#include <crevasse/base/csv_table.h>
#include <crevasse/base/log.h>
#include <crevasse/model/body.h>
#include <crevasse/periodic/net_slip.h>
#include <crevasse/time/observer.h>

namespace Crevasse
{
  /**
   * friction.csv: the state of each pair of nodes with friction at each sample
   * of the last period, 0 open, 1 stuck, 2 sliding along its tangent, −2
   * against it (in space, 2 in any direction), with its tangential jump, shear
   * traction and pressure; in space the sizes of both. For the summary, what a
   * period does: the work of friction, the slip of each pair and its net part,
   * and what this is called. In the plane, pairs follow each other along each
   * lip.
   */
  template <int dim>
  class FrictionTable : public Observer
  {
  public:
    /** Collective. References must outlive the FrictionTable.
     * @param file_name empty on ranks that do not write.
     * @param tolerance of the net slip, relative to its scale. */
    FrictionTable(const Body<dim>    &body,
                  const std::string  &file_name,
                  const NetSlip<dim> &net_slip,
                  const double        tolerance,
                  Log                &log);

    void
    observe(const Sample &sample) override;

    void
    before_jump(const Sample &sample) override
    {
      observe(sample);
    }

    void
    serialize(StateArchive &archive) override;

    /** Writes the table, and adds "friction" to the summary. Collective. */
    void
    summarise(Summary &summary) override;

  private:
    /** A pair at a sample; components along the tangents. */
    struct Pair
    {
      std::array<double, dim - 1> jump{}, traction{};
      double                      pressure = 0.;
      double                      closed   = 0.; ///< 1 if closed
    };

    struct Moment
    {
      double            instant;
      std::vector<Pair> pairs; ///< of the nodes in `places`
    };

    std::vector<Pair>
    look_at(const Sample &sample) const;

    /** State of a pair as in the table, at a moment of the period. */
    double
    state(const std::size_t moment, const std::size_t pair) const;

    /** Part of the step to a moment in which a pair slides while it is closed:
     * all or nothing; or, where it opens, until its pressure vanishes at its
     * last rate. A pair that closes sticks first. */
    double
    closed_part(const std::size_t moment, const std::size_t pair) const;

    /** Tangential jump of a pair at a moment less that at another one. */
    dealii::Tensor<1, dim - 1>
    slip(const std::size_t pair, const Moment &from, const Moment &to) const;

    void
    write() const;

    /** Largest values over the pairs that touch in the period, the numbers of
     * the pairs, and the work of friction. */
    struct Totals
    {
      double      work = 0., longest = 0., net = 0.;
      std::size_t of_longest = 0, of_net = 0;
      bool        closes = false;
    };

    Totals
    totals() const;

    const Body<dim>          &body;
    const std::string         file_name;
    const NetSlip<dim>       &net_slip;
    const double              tolerance;
    Log                      &log;
    std::vector<unsigned int> places;       ///< numbers of nodes in LipBasis
    std::vector<Moment>       period;       ///< samples of the last period
    double                    largest = 0.; ///< largest displacement
    double                    least   = 0.; ///< slip that is rounding
  };
} // namespace Crevasse

#endif
