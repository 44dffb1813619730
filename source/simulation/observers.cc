// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/postprocess/contact_onset.h>
#include <crevasse/postprocess/drift.h>
#include <crevasse/postprocess/elastic_reference.h>
#include <crevasse/postprocess/field_writer.h>
#include <crevasse/postprocess/load_work.h>
#include <crevasse/postprocess/progress.h>
#include <crevasse/postprocess/stress_writer.h>
#include <crevasse/simulation/observers.h>

#include <utility>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  template <typename Derived, typename... Arguments>
  Derived *
  Observers<dim>::add(Arguments &&...arguments)
  {
    auto observer =
      std::make_unique<Derived>(std::forward<Arguments>(arguments)...);
    Derived *view = observer.get();
    all.push_back(view);
    owned.push_back(std::move(observer));
    return view;
  }



  template <int dim>
  Observers<dim>::Observers(const RunSetup<dim> &setup,
                            Workspace<dim>      &work,
                            const RunOutput     &output,
                            const RunState      &state)
  {
    const Scene     &scene = setup.scene;
    const Body<dim> &body  = setup.body;
    Log             &log   = output.log;
    const bool       writes =
      Utilities::MPI::this_mpi_process(body.space.communicator()) == 0;
    const auto file = [&](const std::string &name) {
      names_of_tables.push_back(name);
      return writes ? output.directory + '/' + name : std::string();
    };
    const bool is_continuing = state.has_tables();
    const bool of_last       = work.start.choice.periods_are_iterates();

    extremes = add<Extremes<dim>>(body, of_last, state, log);
    for (const ProbeEvaluator<dim> &probe : setup.probes)
      add<ProbeTable<dim>>(probe,
                           file("probe_" + probe.name() + ".csv"),
                           is_continuing);
    if (body.effects.contact.on)
      contact_table = add<ContactTable<dim>>(body.lip,
                                             file("contact.csv"),
                                             of_last,
                                             is_continuing,
                                             state.largest_opening);
    add_drift(setup, work, state, log);
    if constexpr (dim == 2)
      if (setup.crack_tip != nullptr)
        {
          owned.push_back(
            setup.crack_tip->make_table(work.systems,
                                        work.steps,
                                        work.start.flow,
                                        {file("crack_tip.csv"), is_continuing},
                                        log));
          all.push_back(owned.back().get());
        }
    if (body.effects.field_output.on)
      add<FieldWriter<dim>>(body.space,
                            setup.recovery,
                            body.lip,
                            FieldTimes{work.steps, scene.output.field_times},
                            output.directory,
                            log);
    if (scene.output.load_work)
      add<LoadWork<dim>>(body.loads,
                         work.steps,
                         file("load_work.csv"),
                         is_continuing);
    if (output.stress_record)
      add<StressWriter<dim>>(body, output.directory + "/stress_samples.bin");
    add<PeriodTable>(file("periods.csv"), is_continuing);
    add<Progress<dim>>(log,
                       body.lip,
                       work.steps.period(),
                       scene.periodic_state.maximum_periods,
                       body.space.communicator());
  }



  template <int dim>
  void
  Observers<dim>::add_drift(const RunSetup<dim> &setup,
                            Workspace<dim>      &work,
                            const RunState      &state,
                            Log                 &log)
  {
    const Body<dim> &body  = setup.body;
    const Vector    *drift = nullptr;
    if (body.effects.viscosity.on)
      drift =
        &add<Drift<dim>>(work.steps, body.lip, setup.probes, contact_table)
           ->last_period();
    // The lip's nodes before were others.
    if (body.effects.contact.on && work.start.flow && !state.has_begun())
      add<ContactOnset<dim>>(body.lip, *work.start.flow, log);
    if (setup.scene.output.elastic_comparison != ComparedLip::none)
      add<ElasticComparison>(elastic_reference(setup.scene,
                                               body,
                                               work.systems,
                                               work.steps,
                                               setup.integrator.get()),
                             drift,
                             log);
  }



  template <int dim>
  const std::vector<Observer *> &
  Observers<dim>::list() const
  {
    return all;
  }



  template <int dim>
  const std::vector<std::string> &
  Observers<dim>::tables() const
  {
    return names_of_tables;
  }



  template <int dim>
  void
  Observers<dim>::summarise(Summary &summary)
  {
    for (Observer *observer : all)
      observer->summarise(summary);
  }



  template <int dim>
  void
  Observers<dim>::export_state(RunState &state) const
  {
    state.largest_stress       = extremes->largest_stress();
    state.largest_displacement = extremes->largest_displacement();
    if (contact_table != nullptr)
      state.largest_opening = contact_table->largest_opening();
  }



  template class Observers<2>;
  template class Observers<3>;
} // namespace Crevasse
