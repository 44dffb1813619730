// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/postprocess/crack_tip_analysis.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  CrackTipTable::CrackTipTable(const CrackTipAnalysis           &analysis,
                               std::optional<Integrals>        &&integrals,
                               const double                      relative_error,
                               const StepList                   &steps,
                               const std::optional<SecularFlow> &flow,
                               const File                       &file,
                               Log                              &log)
    : analysis(analysis)
    , integrals(std::move(integrals))
    , relative_error(relative_error)
    , steps(steps)
    , flow(flow)
    , log(log)
    , has_singular_function(this->integrals && this->integrals->singular)
  {
    if (file.name.empty())
      return;
    std::vector<std::string> columns = {"t", "K_I", "K_I_stress"};
    if (has_singular_function)
      columns.push_back("K_I_singular");
    for (const char *name :
         {"K_I_error", "energy_release_rate", "strain_energy"})
      columns.push_back(name);
    table = std::make_unique<CsvTable>(file.name, columns, file.is_continuing);
  }



  CrackTipTable::Values
  CrackTipTable::evaluate(const Sample &sample)
  {
    const double       t      = steps.within_period(sample.instant);
    const auto        &g      = sample.state.contact_forces;
    const auto        &stress = sample.state.stress;
    Values             values{};
    const double       open = analysis.fits.open_length(sample.state);
    const WilliamsFit &fit  = analysis.fits.within(open);
    // Creep may have left a singular stress at a closed tip.
    const bool is_closed = open == 0. && !analysis.body.effects.viscosity.on;
    values.of_stress     = is_closed ? 0. : fit.value(stress, g);
    if (integrals)
      {
        nodal_forces.reinit(sample.state.displacement, true);
        analysis.body.loads.evaluate(t, nodal_forces);
        const double large = integrals->large.value(nodal_forces, g);
        values.intensity   = is_closed ? 0. : large;
        values.error =
          std::max(std::abs(large - integrals->small.value(nodal_forces, g)),
                   std::abs(large - values.of_stress));
        if (has_singular_function)
          values.of_singular_function =
            integrals->singular->value(nodal_forces, g);
      }
    else
      {
        values.intensity = values.of_stress;
        values.error     = is_closed ? 0. : std::abs(fit.correction(stress, g));
      }
    values.error =
      std::max(values.error, relative_error * std::abs(values.intensity));
    values.release_rate =
      values.intensity * values.intensity / analysis.modulus(t);
    values.energy = analysis.energy.value(t, stress, sample.viscous_strain);
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
    if (has_singular_function)
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
    analysis.summarise(*this, flow ? &*flow : nullptr, summary, log);
  }
} // namespace Crevasse
