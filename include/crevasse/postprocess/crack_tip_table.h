// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_crack_tip_table_h
#define crevasse_postprocess_crack_tip_table_h

#include <crevasse/base/csv_table.h>
#include <crevasse/base/log.h>
#include <crevasse/crack_tip/growth_law.h>
#include <crevasse/postprocess/stress_intensity.h>
#include <crevasse/time/observer.h>


namespace Crevasse
{
  class CrackTipAnalysis;

  /**
   * crack_tip.csv: what is read off at the crack tip at each accepted step.
   *
   * See StressIntensity::Estimate for K_I and K_I_stress. K_I_singular is the
   * coefficient of the singular function that opens the crack, of an elastic
   * body. K_I_error is the error there, or |K_I| times the relative error of
   * the elastic energy as StressEstimator has it in the cells around the tip,
   * if that is larger; where integral and fit differ by more, up to four times
   * this. It is no bound.
   */
  class CrackTipTable : public Observer
  {
  public:
    /** The numbers of a step. */
    struct Values : StressIntensity::Estimate
    {
      double of_singular_function, release_rate, energy;
    };

    /** Where its rows go. */
    struct File
    {
      std::string name;          ///< empty on ranks that do not write
      bool        is_continuing; ///< whether it has rows already
    };

    /** References must outlive this object.
     *
     * @param relative_error of the elastic energy
     * @param flow none: none was found. */
    CrackTipTable(const CrackTipAnalysis           &analysis,
                  const double                      relative_error,
                  const StepList                   &steps,
                  const std::optional<SecularFlow> &flow,
                  const File                       &file,
                  Log                              &log);

    void
    observe(const Sample &sample) override;

    void
    serialize(StateArchive &archive) override;

    void
    summarise(Summary &summary) override;

    /** K_I of the last period. */
    const TipHistory &
    last_period() const
    {
      return history;
    }

    /** All numbers of the last period. */
    const std::vector<Values> &
    values() const
    {
      return of_last_period;
    }

  private:
    Values
    evaluate(const Sample &sample);

    const CrackTipAnalysis           &analysis;
    const double                      relative_error;
    const StepList                   &steps;
    const std::optional<SecularFlow> &flow;
    Log                              &log;
    const bool                        has_singular_function;
    std::unique_ptr<CsvTable>         table;
    TipHistory                        history;
    std::vector<Values>               of_last_period;
  };
} // namespace Crevasse

#endif
