// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/postprocess/elastic_reference.h>
#include <crevasse/postprocess/load_work.h>
#include <crevasse/postprocess/outputs.h>

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  struct Outputs<dim>::Extremes : public Observer
  {
    void
    observe(const Sample &sample) override
    {
      if (of_last_period && sample.step == 0)
        displacement = viscous_strain = 0.;
      displacement =
        std::max(displacement, sample.state.displacement.linfty_norm());
      if (sample.viscous_strain.size() > 0)
        viscous_strain =
          std::max(viscous_strain, sample.viscous_strain.linfty_norm());
    }

    void
    end_of_period(const PeriodReport &report) override
    {
      stress = of_last_period ? report.largest_stress
                              : std::max(stress, report.largest_stress);
    }

    void
    serialize(StateArchive &archive) override
    {
      archive.common(stress);
      archive.common(displacement);
      archive.common(viscous_strain);
    }

    Extremes(const bool of_last_period, const RunState &before)
      : of_last_period(of_last_period)
      , stress(before.largest_stress)
      , displacement(before.largest_displacement)
    {
    }

    const bool of_last_period;
    double     stress;
    double     displacement;        ///< of an unknown
    double     viscous_strain = 0.; ///< largest component
  };



  template <int dim>
  template <typename Derived, typename... Arguments>
  Derived *
  Outputs<dim>::add(Arguments &&...arguments)
  {
    auto observer =
      std::make_unique<Derived>(std::forward<Arguments>(arguments)...);
    Derived *view = observer.get();
    all.push_back(view);
    owned.push_back(std::move(observer));
    return view;
  }



  template <int dim>
  Outputs<dim>::Outputs(const Scene                            &scene,
                        const Body<dim>                        &body,
                        const StressRecovery<dim>              &recovery,
                        const std::vector<ProbeEvaluator<dim>> &probes,
                        Solvers<dim>                           &solvers,
                        const StepList                         &steps,
                        const Integrator                       *integrator,
                        const CrackTipAnalysis                 *crack_tip,
                        const SecularFlow                      *flow,
                        const bool         periods_are_iterates,
                        const RunState    &start,
                        Log               &log,
                        const std::string &directory)
    : body(body)
    , steps(steps)
    , crack_tip(crack_tip)
    , flow(flow)
    , log(log)
    , directory(directory)
    , opening_before(start.largest_opening)
    , probes(probes)
  {
    const bool writes =
      Utilities::MPI::this_mpi_process(body.space.communicator()) == 0;
    const auto file = [&](const std::string &name) {
      names_of_tables.push_back(name);
      return writes ? directory + '/' + name : std::string();
    };

    const bool goes_on = start.has_tables();
    for (const ProbeEvaluator<dim> &probe : probes)
      add<ProbeTable<dim>>(probe,
                           file("probe_" + probe.name() + ".csv"),
                           goes_on);
    if (body.effects.contact.on)
      contact_table = add<ContactTable<dim>>(body.lip,
                                             file("contact.csv"),
                                             periods_are_iterates,
                                             goes_on);
    // The lip's nodes before were others.
    if (body.effects.contact.on && flow != nullptr && !start.has_begun())
      onset = add<ContactOnset<dim>>(body.lip, *flow);
    if (body.effects.viscosity.on)
      drift = add<Drift>(steps);
    if (scene.output.elastic_comparison != "none")
      {
        ElasticComparison::Reference reference =
          elastic_reference(scene, body, solvers, steps, integrator);
        comparison = add<ElasticComparison>(std::move(reference));
      }
    if constexpr (dim == 2)
      if (crack_tip != nullptr)
        {
          owned.push_back(crack_tip->make_table(
            solvers, steps, file("crack_tip.csv"), goes_on));
          crack_tip_table = static_cast<CrackTipTable *>(owned.back().get());
          all.push_back(crack_tip_table);
        }
    if (body.effects.field_output.on)
      fields = add<FieldWriter<dim>>(body.space,
                                     recovery,
                                     body.lip,
                                     steps,
                                     scene.output.field_times,
                                     directory);
    if (scene.output.load_work)
      add<LoadWork<dim>>(body.loads, steps, file("load_work.csv"), goes_on);
    extremes = add<Extremes>(periods_are_iterates, start);
    add<PeriodTable>(file("periods.csv"), goes_on);
    add<Progress<dim>>(log,
                       body.lip,
                       steps.period(),
                       scene.periodic_state.maximum_periods,
                       body.space.communicator());
  }



  template <int dim>
  double
  Outputs<dim>::stress_rounding() const
  {
    if (extremes->stress == 0.)
      return 0.;
    double     stiffness = 0.;
    const auto material  = body.material.at(0.);
    for (const VoigtMatrix<dim> &K : material.stiffness->distinct())
      stiffness = std::max(stiffness, K.norm());
    stiffness = Utilities::MPI::max(stiffness, body.space.communicator());
    return std::numeric_limits<double>::epsilon() * stiffness *
           extremes->viscous_strain / extremes->stress;
  }



  template <int dim>
  void
  Outputs<dim>::beware_of_large_displacements() const
  {
    constexpr double       small = 0.1;
    const BoundingBox<dim> box(body.space.mesh().get_vertices());
    const auto            &corners  = box.get_boundary_points();
    const double           diagonal = corners.first.distance(corners.second);
    if (extremes->displacement <= small * diagonal)
      return;
    std::ostringstream text;
    text << "  Beware: displacements reach " << extremes->displacement
         << ", and the body is " << diagonal
         << " from corner to corner: the theory is one of small strains. Have "
            "loads, lengths and moduli one system of units, and may the body "
            "flow for so long?";
    log.line(text.str());
  }



  template <int dim>
  void
  Outputs<dim>::finish(Summary &summary)
  {
    summary["extremes"]["stress"] = extremes->stress;
    // With singular functions some unknowns are no displacements.
    if (body.space.singular_shapes() == nullptr)
      {
        summary["extremes"]["displacement"] = extremes->displacement;
        beware_of_large_displacements();
      }
    if (contact_table != nullptr)
      summary["extremes"]["opening"] =
        std::max(opening_before, contact_table->largest_opening());
    if (drift != nullptr)
      finish_drift(summary);
    if (onset != nullptr)
      finish_onset(summary);
    if (comparison != nullptr)
      finish_comparison(summary);
    if (crack_tip_table != nullptr)
      crack_tip->summarise(*crack_tip_table, flow, summary, log);
    if (fields != nullptr)
      {
        const unsigned int n = fields->write();
        log.line("  fields of " + std::to_string(n) +
                 (n == 1 ? " instant in " : " instants in ") + directory +
                 "/solution.pvd");
      }
  }



  template <int dim>
  void
  Outputs<dim>::hand_over(RunState &state) const
  {
    state.largest_stress       = extremes->stress;
    state.largest_displacement = extremes->displacement;
    if (contact_table != nullptr)
      state.largest_opening =
        std::max(opening_before, contact_table->largest_opening());
  }



  template <int dim>
  void
  Outputs<dim>::finish_drift(Summary &summary) const
  {
    const Vector &gain   = drift->last_period();
    const double  period = steps.period();

    auto &rates           = summary["drift"];
    rates["largest_rate"] = gain.linfty_norm() / period;
    for (const auto &probe : probes)
      {
        const Tensor<1, dim> rate = probe.displacement(gain) / period;
        for (unsigned int d = 0; d < dim; ++d)
          rates["per_probe"][probe.name()].push_back(rate[d]);
      }
    if (contact_table == nullptr)
      return;
    double closing = 0.;
    for (const LipNode<dim> &node : body.lip.nodes())
      closing = std::max(closing, -node.sign * gain(node.dof));
    closing = Utilities::MPI::max(closing, body.space.communicator());
    // Where the lip never opens, solves move its nodes by what they leave.
    constexpr double some     = 100.;
    const double     accuracy = summary["certificate"]["accuracy"];
    const bool       is_noise =
      closing <= some * accuracy * contact_table->largest_displacement();
    rates["largest_closing_rate"] = is_noise ? 0. : closing / period;
  }



  template <int dim>
  void
  Outputs<dim>::finish_onset(Summary &summary) const
  {
    const unsigned int n_nodes = onset->n_opening_nodes();
    const double       pressed = onset->last_contact();

    auto      &secular                           = summary["secular"];
    const auto forces                            = onset->mean_forces();
    secular["mean_contact_force_of_last_period"] = forces.first;
    secular["opening_nodes"]                     = n_nodes;
    secular["onset"]                             = onset->onset();
    // null: none of them was pressed at all
    secular["last_contact_of_opening_nodes"] =
      pressed >= 0. ? Summary(pressed) : Summary();
    if (n_nodes == 0)
      return;
    char text[160];
    std::snprintf(text,
                  sizeof(text),
                  "  the flow opens %u nodes of the lip: none touches after "
                  "t_0 = %g at the latest (q of mean value zero)",
                  n_nodes,
                  onset->onset());
    log.line(text);
  }



  template <int dim>
  void
  Outputs<dim>::finish_comparison(Summary &summary) const
  {
    const double stress = comparison->stress_difference();
    summary["elastic_comparison"]["stress_difference"] = stress;
    char text[120];
    std::snprintf(text,
                  sizeof(text),
                  "  periodic stress against F(t) s_el: difference %.2e of the "
                  "largest stress",
                  stress);
    log.line(text);
    if (drift == nullptr)
      return;

    const double difference =
      comparison->drift_difference(drift->last_period());
    summary["elastic_comparison"]["drift_difference"] = difference;
    std::snprintf(text,
                  sizeof(text),
                  "  drift per period against T F_mean/tau u_el: difference "
                  "%.2e",
                  difference);
    log.line(text);
  }



  template class Outputs<2>;
  template class Outputs<3>;
} // namespace Crevasse
