// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/postprocess/load_work.h>

namespace Crevasse
{
  template <int dim>
  LoadWork<dim>::LoadWork(const ExternalLoads<dim> &loads,
                          const StepList           &steps,
                          const std::string        &file_name,
                          const bool                is_continuing)
    : loads(loads)
    , steps(steps)
    , table(file_name.empty() ? nullptr
                              : std::make_unique<CsvTable>(
                                  file_name,
                                  std::vector<std::string>{"t", "load_work"},
                                  is_continuing))
  {
  }



  template <int dim>
  void
  LoadWork<dim>::observe(const Sample &sample)
  {
    nodal_forces.reinit(sample.state.displacement, true);
    loads.evaluate(steps.within_period(sample.instant), nodal_forces);
    const double work = nodal_forces * sample.state.displacement;
    if (table != nullptr)
      table->add_row({sample.time, work});
  }



  template class LoadWork<2>;
  template class LoadWork<3>;
} // namespace Crevasse
