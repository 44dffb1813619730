// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/postprocess/crack_tip_table.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  CrackTipTable::CrackTipTable(std::optional<Integrals> &&integrals,
                               const WilliamsFit         &fit,
                               const StrainEnergy        &energy,
                               const Modulus             &modulus,
                               const ExternalLoads<2>    &loads,
                               const StepList            &steps,
                               const std::string         &file_name,
                               const bool                 goes_on,
                               const double               relative_error)
    : integrals(std::move(integrals))
    , fit(fit)
    , energy(energy)
    , modulus(modulus)
    , loads(loads)
    , steps(steps)
    , relative_error(relative_error)
  {
    if (file_name.empty())
      return;
    std::vector<std::string> columns = {"t", "K_I", "K_I_stress"};
    if (has_singular_function())
      columns.push_back("K_I_singular");
    for (const char *name :
         {"K_I_error", "energy_release_rate", "strain_energy"})
      columns.push_back(name);
    table = std::make_unique<CsvTable>(file_name, columns, goes_on);
  }



  bool
  CrackTipTable::has_singular_function() const
  {
    return integrals && integrals->singular;
  }



  CrackTipTable::Values
  CrackTipTable::evaluate(const Sample &sample)
  {
    const double t = steps.within_period(sample.instant);
    Values       values{};
    const auto  &g   = sample.state.contact_forces;
    values.of_stress = fit.value(sample.state.stress, g);
    if (integrals)
      {
        nodal_forces.reinit(sample.state.displacement, true);
        loads.evaluate(t, nodal_forces);
        values.intensity = integrals->large.value(nodal_forces, g);
        values.error =
          std::max(std::abs(values.intensity -
                            integrals->small.value(nodal_forces, g)),
                   std::abs(values.intensity - values.of_stress));
        if (has_singular_function())
          values.of_singular_function =
            integrals->singular->value(nodal_forces, g);
      }
    else
      {
        values.intensity = values.of_stress;
        values.error     = std::abs(fit.correction(sample.state.stress, g));
      }
    values.error =
      std::max(values.error, relative_error * std::abs(values.intensity));
    values.release_rate = values.intensity * values.intensity / modulus(t);
    values.energy = energy.value(t, sample.state.stress, sample.viscous_strain);
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
} // namespace Crevasse
