// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/postprocess/crack_tip_table.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  CrackTipTable::CrackTipTable(Evaluation      &&evaluation,
                               const StepList   &steps,
                               const File       &file,
                               const Conclusion &conclusion)
    : by(std::move(evaluation))
    , steps(steps)
    , conclusion(conclusion)
  {
    if (file.name.empty())
      return;
    std::vector<std::string> columns = {"t", "K_I", "K_I_stress"};
    if (has_singular_function())
      columns.push_back("K_I_singular");
    for (const char *name :
         {"K_I_error", "energy_release_rate", "strain_energy"})
      columns.push_back(name);
    table = std::make_unique<CsvTable>(file.name, columns, file.is_continuing);
  }



  bool
  CrackTipTable::has_singular_function() const
  {
    return by.integrals && by.integrals->singular;
  }



  CrackTipTable::Values
  CrackTipTable::evaluate(const Sample &sample)
  {
    const double t = steps.within_period(sample.instant);
    Values       values{};
    const auto  &g   = sample.state.contact_forces;
    values.of_stress = by.fit.value(sample.state.stress, g);
    if (by.integrals)
      {
        nodal_forces.reinit(sample.state.displacement, true);
        by.loads.evaluate(t, nodal_forces);
        values.intensity = by.integrals->large.value(nodal_forces, g);
        values.error =
          std::max(std::abs(values.intensity -
                            by.integrals->small.value(nodal_forces, g)),
                   std::abs(values.intensity - values.of_stress));
        if (has_singular_function())
          values.of_singular_function =
            by.integrals->singular->value(nodal_forces, g);
      }
    else
      {
        values.intensity = values.of_stress;
        values.error     = std::abs(by.fit.correction(sample.state.stress, g));
      }
    values.error =
      std::max(values.error, by.relative_error * std::abs(values.intensity));
    values.release_rate = values.intensity * values.intensity / by.modulus(t);
    values.energy =
      by.energy.value(t, sample.state.stress, sample.viscous_strain);
    return values;
  }



  void
  CrackTipTable::observe(const Sample &sample)
  {
    const Values values = evaluate(sample);
    if (sample.step == 0)
      {
        history.instants.clear();
        history.intensity.clear();
        of_last_period.clear();
      }
    history.instants.push_back(sample.instant);
    history.intensity.push_back(values.intensity);
    of_last_period.push_back(values);
    if (table == nullptr)
      return;
    std::vector<double> row = {sample.time, values.intensity, values.of_stress};
    if (has_singular_function())
      row.push_back(values.of_singular_function);
    row.insert(row.end(), {values.error, values.release_rate, values.energy});
    table->add_row(row);
  }



  void
  CrackTipTable::serialize(StateArchive &archive)
  {
    archive.section("crack tip");
    archive.common(history.instants);
    archive.common(history.intensity);
    archive.common_list(of_last_period);
  }



  void
  CrackTipTable::summarise(Summary &summary)
  {
    conclusion(*this, summary);
  }
} // namespace Crevasse
