// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/postprocess/crack_tip_analysis.h>


namespace Crevasse
{
  using namespace dealii;

  CrackTipTable::CrackTipTable(const CrackTipAnalysis           &analysis,
                               const double                      relative_error,
                               const StepList                   &steps,
                               const std::optional<SecularFlow> &flow,
                               const File                       &file,
                               Log                              &log)
    : analysis(analysis)
    , relative_error(relative_error)
    , steps(steps)
    , flow(flow)
    , log(log)
    , has_singular_function(analysis.body.space.singular_shapes() != nullptr &&
                            !analysis.body.effects.viscosity.on &&
                            !analysis.body.material.stiffness_varies)
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
    const double           t        = steps.within_period(sample.instant);
    const MaterialState<2> material = analysis.body.material.at(t);
    const PlaneElasticity  at_tip   = analysis.intensity.elasticity(t);
    Values values{analysis.intensity.evaluate(t, sample, material, at_tip),
                  0.,
                  0.,
                  0.};
    if (has_singular_function)
      {
        const Space<2> &space = analysis.body.space;
        const Vector   &u     = sample.state.displacement;
        const auto      first = space.singular_unknown(0);
        values.of_singular_function =
          material.stiffness_factor *
          space.singular_shapes()->functions.unit_stress_intensity *
          Utilities::MPI::sum(u.in_local_range(first) ? u(first) : 0.,
                              space.communicator());
      }
    values.error =
      std::max(values.error, relative_error * std::abs(values.intensity));
    // The fit may be far less accurate than the integral.
    constexpr double most = 4.;
    values.error =
      std::max(values.error,
               std::min(most * values.error,
                        std::abs(values.intensity - values.of_stress)));
    values.release_rate = values.intensity * values.intensity /
                          (material.stiffness_factor * at_tip.modulus());
    values.energy = analysis.energy.value(material,
                                          sample.state.stress,
                                          sample.viscous_strain);
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
