// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_crack_tip_table_h
#define crevasse_postprocess_crack_tip_table_h

#include <crevasse/base/csv_table.h>
#include <crevasse/base/log.h>
#include <crevasse/crack_tip/growth_law.h>
#include <crevasse/crack_tip/interaction_integral.h>
#include <crevasse/time/observer.h>
#include <crevasse/time/secular_flow.h>
#include <crevasse/time/step_list.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace Crevasse
{
  class CrackTipAnalysis;

  /**
   * crack_tip.csv: what is read off at the crack tip at each accepted step.
   *
   * K_I is that of the interaction integral where there is one, or else of the
   * fit, which K_I_stress is in any case. K_I_singular is the coefficient of
   * the singular function that opens the crack, in the displacement of an
   * elastic body under the same forces. K_I_error is the largest of three: the
   * difference between the integrals over two squares, that between integral
   * and fit, and what the mesh leaves, |K_I| times the relative error of the
   * elastic energy as StressEstimator has it; without the integral, of the
   * difference of the fits to two discs and the last. It is no bound. K_I and
   * K_I_stress are 0 where nothing creeps and the node next to the tip is
   * closed; what the integral has there is its error.
   */
  class CrackTipTable : public Observer
  {
  public:
    /** The numbers of a step. */
    struct Values
    {
      double intensity, of_stress, of_singular_function, error, release_rate,
        energy;
    };

    /** Weight functions: of the interaction integral over two squares, and of
     * the coefficient of the singular function that opens the crack, if there
     * is one. */
    struct Integrals
    {
      IntensityFunctional                large, small;
      std::optional<IntensityFunctional> singular;
    };

    /** Where its rows go. */
    struct File
    {
      std::string name;          ///< empty on ranks that do not write
      bool        is_continuing; ///< whether it has rows already
    };

    /** References must outlive this object.
     *
     * @param integrals none: the fit serves for K_I
     * @param relative_error of the elastic energy
     * @param flow none: none was found. */
    CrackTipTable(const CrackTipAnalysis           &analysis,
                  std::optional<Integrals>        &&integrals,
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
    const std::optional<Integrals>    integrals;
    const double                      relative_error;
    const StepList                   &steps;
    const std::optional<SecularFlow> &flow;
    Log                              &log;
    const bool                        has_singular_function;
    Vector                            nodal_forces;
    std::unique_ptr<CsvTable>         table;
    TipHistory                        history;
    std::vector<Values>               of_last_period;
  };
} // namespace Crevasse

#endif
