// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/model/largest_load.h>
#include <crevasse/postprocess/crack_front_table.h>
#include <crevasse/postprocess/creep_integral_table.h>
#include <crevasse/postprocess/field_writer.h>
#include <crevasse/postprocess/friction_table.h>
#include <crevasse/postprocess/mission_table.h>
#include <crevasse/postprocess/period_table.h>
#include <crevasse/postprocess/probe_tables.h>
#include <crevasse/postprocess/reactions.h>
#include <crevasse/postprocess/slip_while_closed.h>
#include <crevasse/postprocess/stress_writer.h>
#include <crevasse/postprocess/tip_table.h>
#include <crevasse/simulation/drift.h>
#include <crevasse/simulation/elastic_comparison.h>
#include <crevasse/simulation/extremes.h>
#include <crevasse/simulation/run.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** A table with one row for each accepted step. */
    class SampleTable : public Observer
    {
    public:
      /** Computes a row. Collective, also on ranks that do not write. */
      using Row = std::function<std::vector<double>(const Sample &)>;

      SampleTable(CsvTable &&table, const Row &row)
        : table(std::move(table))
        , row(row)
      {
      }

      void
      observe(const Sample &sample) override
      {
        table.add_row(row(sample));
      }

    private:
      CsvTable  table;
      const Row row;
    };



    /** The observers of a run while they are created, with the instants at
     * which fields are written. */
    template <int dim>
    class Outputs
    {
    public:
      explicit Outputs(Run<dim> &run)
        : run(run)
        , body(run.body)
        , writes(Utilities::MPI::this_mpi_process(
                   run.body.space.communicator()) == 0)
        // The end of the run is always included.
        , instants{false, {run.steps.period()}, {}}
      {
        if (run.crack_tips.empty())
          instants.followed.emplace_back([](const Sample &sample) {
            return sample.state.stress.linfty_norm();
          });
      }

      template <typename Type>
      Type *
      add(std::unique_ptr<Type> observer)
      {
        Type *const view = observer.get();
        run.observers.push_back(std::move(observer));
        return view;
      }

      void
      add_probes()
      {
        std::vector<CsvTable> of_probes;
        for (const ProbeEvaluator<dim> &probe : run.probes)
          of_probes.push_back(
            table("probe_" + probe.name + ".csv", probe.columns()));
        if (!of_probes.empty())
          add(std::make_unique<ProbeTables<dim>>(run.probes,
                                                 std::move(of_probes),
                                                 body.space.communicator()));
      }

      /** @param lip the lip's state at the last sample. */
      LipClosure<dim> *
      add_lip(const LipTotals &lip)
      {
        add(std::make_unique<SampleTable>(
          table("contact.csv",
                {"t", "closed_nodes", "force", "largest_pressure"}),
          [&lip](const Sample &sample) -> std::vector<double> {
            return {sample.time,
                    double(lip.closed_nodes),
                    lip.force,
                    lip.largest_pressure};
          }));
        instants.followed.emplace_back(
          [&lip](auto &) { return lip.largest_opening; });
        instants.followed.emplace_back(
          [&lip](auto &) { return lip.closed_nodes > 0 ? lip.force : NAN; });
        return add(std::make_unique<LipClosure<dim>>(body,
                                                     path("lip.csv"),
                                                     run.evolution));
      }

      NetSlip<dim> *
      add_friction()
      {
        const auto net_slip = add(std::make_unique<NetSlip<dim>>(body.lip));
        add(std::make_unique<FrictionTable<dim>>(
          body,
          path("friction.csv"),
          *net_slip,
          run.scene.periodic_state.tolerance,
          run.log));
        return net_slip;
      }

      /** @param closure of the lip; null without contact. */
      void
      add_tips(LipClosure<2> *closure)
      {
        const std::vector<MeshErrors> errors = mesh_errors_of_tips(
          run.scene, body, run.systems, run.steps, run.crack_tips);
        unsigned int n_two_lips = 0;
        for (unsigned int i = 0; i < run.crack_tips.size(); ++i)
          {
            const auto       &tip    = run.crack_tips[i];
            const std::string number = tip->intensity.region.tip.two_lips
                                         ? "_" + std::to_string(++n_two_lips)
                                         : "";
            const auto        of_tip = add(std::make_unique<TipTable>(
              *tip,
              errors[i],
              TipContext{run.steps,
                         run.flow,
                         tip->intensity.region.tip.is_open ? nullptr : closure,
                         Units(run.scene.units),
                         run.log},
              table("crack_tip" + number + ".csv", TipTable::columns(*tip))));
            tips.push_back(of_tip);
            for (const double sign : {1., -1.})
              instants.followed.emplace_back([of_tip, sign](auto &) {
                return sign * of_tip->latest().equivalent;
              });
          }
      }

      void
      add_creep_integrals()
      {
        for (unsigned int i = 0; i < run.creep_integrals.size(); ++i)
          {
            const CreepIntegral<dim> &integral = *run.creep_integrals[i];
            std::string               name     = "crack_front.csv";
            if constexpr (dim == 2)
              name = "creep_integral" +
                     (integral.region.tip.two_lips ? "_" + std::to_string(i + 1)
                                                   : "") +
                     ".csv";
            add(std::make_unique<CreepIntegralTable<dim>>(
              run.scene,
              integral,
              run.steps,
              run.choice.periods_are_iterates(),
              table(name, CreepIntegralTable<dim>::columns(run.body)),
              run.log));
          }
      }

      void
      add_front()
      {
        front = add(std::make_unique<CrackFrontTable>(*run.crack_front,
                                                      run.steps,
                                                      run.flow,
                                                      path("crack_front.csv"),
                                                      run.log));
      }

      void
      add_missions()
      {
        std::vector<PeriodNumber> numbers;
        const auto include = [&numbers](const std::vector<PeriodNumber> &more) {
          numbers.insert(numbers.end(), more.begin(), more.end());
        };
        for (unsigned int i = 0; i < tips.size(); ++i)
          include(tips[i]->period_numbers(
            tips.size() > 1 ? "_" + std::to_string(i + 1) : ""));
        if (front != nullptr)
          include(front->period_numbers());
        if (body.effects.contact.on)
          numbers.emplace_back("opening_largest", [&state = run.state] {
            return state.largest_opening;
          });
        add(std::make_unique<MissionTable>(
          table("missions.csv", MissionTable::columns(numbers)), numbers));
      }

      /** @param lip the lip's state at the last sample. */
      ConvergedQuantity *
      add_quantity(const LipTotals &lip)
      {
        constexpr double   rounding = 1e-12;
        const std::string &name = run.scene.periodic_state.converged_quantity;
        ConvergedQuantity::Values values = [&lip](const Sample &) {
          return std::vector<double>{lip.largest_opening};
        };
        if (name == "K_I")
          values = [tips = tips, front = front](const Sample &) {
            if (front != nullptr)
              return front->latest();
            std::vector<double> all;
            for (const TipTable *tip : tips)
              all.push_back(tip->latest().intensity[0]);
            return all;
          };
        for (const auto &probe : run.probes)
          if (name == "probe " + probe.name)
            values = [&probe, this_body = &body](const Sample &sample) {
              const auto                local = probe.local_values(sample);
              const std::vector<double> stress(local.begin() + dim,
                                               local.end() - 2);
              std::vector<double>       all(stress.size());
              Utilities::MPI::sum(stress, this_body->space.communicator(), all);
              return all;
            };
        return add(
          std::make_unique<ConvergedQuantity>(values,
                                              rounding * run.steps.period()));
      }

      void
      add_fields()
      {
        const FieldTimes &times = *run.scene.output.field_times;
        instants.all            = times.all;
        if (!times.of_extremes)
          instants.followed.clear();
        for (const double t : times.instants(run.steps.period()))
          instants.chosen.insert(run.steps.instant(run.steps.nearest(t)));
        add(std::make_unique<FieldWriter<dim>>(body,
                                               run.recovery,
                                               run.steps,
                                               instants,
                                               run.checkpoints.directory,
                                               run.log));
      }

      /** Work of the loads ∫ loads · u (force times length, per thickness in a
       * plane). For an elastic body without gap, half of it is the strain
       * energy, and minus this half the least potential energy, the reference
       * for errors in the energy norm. */
      void
      add_load_work()
      {
        add(std::make_unique<SampleTable>(
          table("load_work.csv", {"t", "load_work"}),
          [&run = run](const Sample &sample) -> std::vector<double> {
            const double t = run.steps.within_period(sample.instant);
            return {sample.time,
                    loads_at(run.body, t) * sample.state.displacement};
          }));
      }

      void
      add_reactions()
      {
        const auto reactions =
          std::make_shared<const Reactions<dim>>(body, run.scene.loads);
        std::vector<std::string> columns = {"t"};
        for (const std::string &name : reactions->columns())
          columns.push_back(name);
        add(std::make_unique<SampleTable>(
          table("reactions.csv", columns), [reactions](const Sample &sample) {
            auto row =
              reactions->forces(sample.state.stress, sample.state.instant);
            row.insert(row.begin(), sample.time);
            return row;
          }));
      }

      void
      add_periods(const LipTotals &lip)
      {
        add(std::make_unique<PeriodTable>(table("periods.csv",
                                                {"period",
                                                 "t_end",
                                                 "stress_change",
                                                 "stress_error_estimate",
                                                 "vi_solves",
                                                 "seconds"}),
                                          run.scene,
                                          lip,
                                          run.log));
      }

      std::vector<std::string> names; ///< of tables that a resumed run extends

    private:
      /** Path of a file; none on ranks that do not write. */
      std::string
      path(const std::string &name) const
      {
        return writes ? run.checkpoints.directory + '/' + name : "";
      }

      CsvTable
      table(const std::string &name, const std::vector<std::string> &columns)
      {
        names.push_back(name);
        return CsvTable(path(name), columns, run.state.has_tables());
      }

      Run<dim>        &run;
      const Body<dim> &body;
      const bool       writes;
      FieldInstants    instants;

      std::vector<const TipTable *> tips;            ///< with K
      const CrackFrontTable        *front = nullptr; ///< null: there is none
    };
  } // namespace



  template <int dim>
  void
  Run<dim>::make_observers()
  {
    Outputs<dim>     outputs(*this);
    const LipTotals &lip =
      outputs.add(std::make_unique<Extremes<dim>>(*this))->lip;
    outputs.add_probes();
    closure = body.effects.contact.on ? outputs.add_lip(lip) : nullptr;
    if (body.friction)
      net_slip = outputs.add_friction();
    else if (!body.space.roles.crack.empty())
      outputs.add(std::make_unique<SlipWhileClosed<dim>>(body, log));
    const Drift<dim> *const drift =
      outputs.add(std::make_unique<Drift<dim>>(*this));
    if (load_factors)
      outputs.add(
        std::make_unique<ElasticComparison<dim>>(*this,
                                                 drift->of_last_period()));
    if constexpr (dim == 2)
      if (!crack_tips.empty())
        outputs.add_tips(closure);
    outputs.add_creep_integrals();
    if (crack_front != nullptr)
      outputs.add_front();
    if (body.effects.field_output.on)
      outputs.add_fields();
    if (body.imposed.is_on)
      outputs.add_reactions();
    if (scene.output.load_work)
      outputs.add_load_work();
    if (scene.output.stress_record)
      outputs.add(std::make_unique<StressWriter<dim>>(body,
                                                      checkpoints.directory +
                                                        "/stress_samples.bin"));
    if (!scene.periodic_state.missions.empty())
      outputs.add_missions();
    else if (scene.periodic_state.converged_quantity != "stress")
      quantity = outputs.add_quantity(lip);
    outputs.add_periods(lip);
    checkpoints.set_tables(outputs.names);
  }



  template void
  Run<2>::make_observers();
  template void
  Run<3>::make_observers();
} // namespace Crevasse
