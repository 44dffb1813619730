// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_study_stress_writer_h
#define crevasse_study_stress_writer_h

#include <crevasse/model/body.h>
#include <crevasse/time/observer.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /** Keeps the stress at all quadrature points at the instants of the last
   * period, and writes it for StressReader. */
  template <int dim>
  class StressWriter : public Observer
  {
  public:
    /** @p body must outlive this. */
    StressWriter(const Body<dim> &body, const double period);

    void
    observe(const Sample &sample) override;

    /** Cell by cell in an order that does not depend on the number of ranks.
     * Nothing where nothing was computed. Collective. @throw FileError */
    void
    write(const std::string &file_name) const;

  private:
    /** Among those of all ranks one after the other. */
    struct PointsOfCell
    {
      std::size_t first, n_points;
    };

    /** All cells, on the first rank. */
    std::vector<PointsOfCell>
    cells_in_order() const;

    /** On the first rank, all ranks' values in that order. */
    std::vector<double>
    gather(const std::vector<double>       &values,
           const std::vector<PointsOfCell> &cells) const;

    std::vector<double>
    coordinates() const;

    const Body<dim>                 &body;
    const double                     period;
    std::vector<double>              instants;
    std::vector<std::vector<double>> samples; ///< may be more than instants
  };
} // namespace Crevasse

#endif
