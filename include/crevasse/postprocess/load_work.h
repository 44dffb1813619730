// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

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
     * @param goes_on see CsvTable. */
    LoadWork(const ExternalLoads<dim> &loads,
             const StepList           &steps,
             const std::string        &file_name,
             const bool                goes_on = false);

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
