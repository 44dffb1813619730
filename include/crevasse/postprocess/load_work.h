// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_load_work_h
#define crevasse_postprocess_load_work_h

#include <crevasse/base/csv_table.h>
#include <crevasse/discretisation/external_loads.h>
#include <crevasse/time/observer.h>
#include <crevasse/time/step_list.h>

#include <memory>
#include <string>

namespace Crevasse
{
  /**
   * load_work.csv: ∫ loads · u at each accepted step (force times length, per
   * thickness in two dimensions). For an elastic body whose lip has no gap half
   * of it is the strain energy, and minus that half the least potential energy,
   * against which errors in the energy norm are measured.
   */
  template <int dim>
  class LoadWork : public Observer
  {
  public:
    /** @param file_name empty on ranks that do not write.
     * @param is_continuing see CsvTable. */
    LoadWork(const ExternalLoads<dim> &loads,
             const StepList           &steps,
             const std::string        &file_name,
             const bool                is_continuing = false);

    void
    observe(const Sample &sample) override;

  private:
    const ExternalLoads<dim> &loads;
    const StepList           &steps;
    Vector                    nodal_forces;
    std::unique_ptr<CsvTable> table;
  };
} // namespace Crevasse

#endif
