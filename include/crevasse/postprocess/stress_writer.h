// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_stress_writer_h
#define crevasse_postprocess_stress_writer_h

#include <crevasse/model/body.h>
#include <crevasse/time/observer.h>


namespace Crevasse
{
  /**
   * stress_samples.bin: the stress at all quadrature points at the instants of
   * the last period, for the errors of a sweep (sweep_errors.py). The file has
   * five integers of 64 bits, a mark and the numbers of dimensions, points,
   * stress components and instants, and then numbers of 64 bits:
   *   instants             within the period
   *   cells                of each point two integers: the id of its cell
   *   coordinates          of each point
   *   stress               of each instant, of each point
   * Points are those of all ranks one after the other; by the ids of their
   * cells the points of runs on other numbers of ranks are put into one order.
   */
  template <int dim>
  class StressWriter : public Observer
  {
  public:
    /** @p body must outlive this. */
    StressWriter(const Body<dim> &body, const std::string &file_name);

    void
    observe(const Sample &sample) override;

    /** Writes the file; nothing where nothing was computed. Collective.
     * @throw FileError */
    void
    summarise(Summary &) override;

  private:
    const Body<dim>                 &body;
    const std::string                file_name;
    std::vector<double>              instants;
    std::vector<std::vector<double>> samples; ///< may be more than instants
  };
} // namespace Crevasse

#endif
