// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/model/body.h>
#include <crevasse/study/advise_runs.h>
#include <crevasse/study/sweep_folder.h>
#include <crevasse/study/sweep_run.h>

#include <algorithm>
#include <cstdio>
#include <limits>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    constexpr double unknown_difference =
      std::numeric_limits<double>::infinity();

    // A stress or displacement that is so much smaller than at the other probes
    // is zero but for rounding.
    constexpr double vanishes = 1e-9;



    Compared
    what_is_compared(const Scene &scene)
    {
      const bool from_rest =
        scene.periodic_state.method == PeriodicMethodType::march &&
        scene.periodic_state.start_from == StartFrom::rest;
      return scene.periodic_state.tolerance > 0. || !from_rest
               ? Compared::periodic_state
               : Compared::whole_run;
    }



    /** Whether runs of different meshes can be compared in it. @throw
     * SceneError if the scene does not write its table. */
    void
    check_quantity(const Quantity &quantity, const Scene &scene)
    {
      const std::string where = "--quantities " + quantity.name + ": ";
      if (quantity.is_stress_field() || quantity.table() == "periods" ||
          quantity.column() == "closed_nodes" ||
          quantity.column() == "K_I_error")
        throw SceneError(where +
                         "this differs from mesh to mesh. Take columns of "
                         "probes, contact, crack_tip or load_work.");
      if (quantity.table() == "contact" &&
          boundary_roles(scene).contact.empty())
        throw SceneError(where + "the scene has no contact.");
      if (quantity.table() == "crack_tip" && !scene.crack_tip.stress_intensity)
        throw SceneError(where +
                         "the scene does not ask for it: set [Crack tip] "
                         "Stress intensity = true.");
      if (quantity.table() == "load_work" && !scene.output.load_work)
        throw SceneError(where +
                         "the scene does not ask for it: set [Output] "
                         "Load work = true.");
    }



    /** Those that the user has named, or u and s of every probe. */
    std::vector<Quantity>
    quantities_of(const std::string &list, const Scene &scene)
    {
      if (scene.periodic_state.maximum_periods == 0)
        throw SceneError(
          "advise: [Periodic state] Maximum periods = 0: nothing is marched, "
          "and there are no histories of which an error could be measured. "
          "Set it to at least 1.");
      SweepRequest request;
      request.reference = {"the finest runs"};
      request.error     = list;
      std::vector<Quantity> quantities =
        choose_quantities(request, {&scene}, "--quantities");
      if (!list.empty())
        {
          for (const Quantity &quantity : quantities)
            check_quantity(quantity, scene);
          return quantities;
        }
      quantities.erase(std::remove_if(quantities.begin(),
                                      quantities.end(),
                                      [](const Quantity &quantity) {
                                        return quantity.table().compare(
                                                 0, 6, "probe_") != 0;
                                      }),
                       quantities.end());
      if (quantities.empty())
        throw SceneError(
          "advise: the scene has no probes, and so no histories of which an "
          "error could be measured. Name the points whose displacement and "
          "stress matter, as --set \"Output/Probes=mouth: 1, 0\", or other "
          "quantities, as --quantities contact/force.");
      return quantities;
    }



    SweepResult
    refused(const std::string &message)
    {
      SweepResult result;
      result.status  = "refused";
      result.message = message;
      result.costs   = Summary::object();
      return result;
    }
  } // namespace



  bool
  AdviseRun::usable() const
  {
    return result.status == "done";
  }



  double
  AdviseRun::cost(const std::string &name) const
  {
    return result.costs.is_object() ? result.costs.value(name, 0.) : 0.;
  }



  double
  AdviseRun::seconds() const
  {
    return cost("processor_seconds");
  }



  double
  AdviseRun::work() const
  {
    constexpr double solves_of_a_factorisation = 10.;
    return cost("linear_solves") + cost("rate_evaluations") +
           solves_of_a_factorisation * cost("factorisations");
  }



  AdviseRuns::AdviseRuns(const Command     &command,
                         const Scene       &scene,
                         const std::string &directory,
                         const MPI_Comm     for_failures,
                         StopRequests      &requests,
                         Log               &log)
    : command(command)
    , directory(directory)
    , communicator(MPI_COMM_WORLD)
    , for_failures(for_failures)
    , requests(requests)
    , log(log)
    , first_rank(Utilities::MPI::this_mpi_process(communicator) == 0)
    , period(scene.loads.period)
    , compared(what_is_compared(scene))
    , all_quantities(quantities_of(command.quantities, scene))
    , left_out(all_quantities.size(), false)
  {
  }



  const std::vector<Quantity> &
  AdviseRuns::quantities() const
  {
    return all_quantities;
  }



  void
  AdviseRuns::leave_out(const std::size_t quantity)
  {
    left_out[quantity] = true;
  }



  bool
  AdviseRuns::counts(const std::size_t quantity) const
  {
    return !left_out[quantity];
  }



  std::size_t
  AdviseRuns::n_that_count() const
  {
    return std::count(left_out.begin(), left_out.end(), false);
  }



  bool
  AdviseRuns::periodic() const
  {
    return compared == Compared::periodic_state;
  }



  std::string
  AdviseRuns::folder(const std::string &name) const
  {
    return directory + "/runs/" + name;
  }



  const AdviseRun &
  AdviseRuns::run(const std::string           &name,
                  const std::vector<Override> &settings)
  {
    const auto there = runs.find(name);
    if (there != runs.end())
      return there->second;

    requests.stop_if_asked();
    AdviseRun run{name, settings, {}};
    bool      was_there = false;
    try
      {
        run.result =
          find_or_compute(read_variant(command, settings), name, was_there);
      }
    catch (const SceneError &error)
      {
        run.result = refused(error.what());
      }
    tell(run, was_there);
    return runs.emplace(name, run).first->second;
  }



  SweepResult
  AdviseRuns::find_or_compute(const SweepVariant &variant,
                              const std::string  &name,
                              bool               &was_there)
  {
    const SweepFolder sweep_folder(folder(name), variant.used);
    std::string       kept;
    if (first_rank)
      if (const auto result = sweep_folder.finished())
        kept = result->to_json().dump();
    kept      = Utilities::MPI::broadcast(communicator, kept, 0);
    was_there = !kept.empty();
    if (!was_there)
      {
        log.progress("  " + name + " ...");
        SweepResult result = run_for_sweep(variant.scene,
                                           sweep_folder,
                                           false,
                                           for_failures,
                                           requests)
                               .result;
        collectively(communicator, [&]() {
          if (first_rank)
            sweep_folder.finish(result);
        });
        kept =
          Utilities::MPI::broadcast(communicator, result.to_json().dump(), 0);
      }
    return SweepResult::from_json(Summary::parse(kept));
  }



  void
  AdviseRuns::tell(const AdviseRun &run, const bool was_there)
  {
    char text[200];
    if (run.usable())
      std::snprintf(text,
                    sizeof(text),
                    "  %-44s %8.0f unknowns %7.0f VIs %8.3f s%s",
                    run.name.c_str(),
                    run.cost("unknowns"),
                    run.cost("vi_solves"),
                    run.seconds(),
                    was_there ? " (already there)" : "");
    else
      std::snprintf(text,
                    sizeof(text),
                    "  %-44s %s%s",
                    run.name.c_str(),
                    run.result.status.c_str(),
                    was_there ? " (already there)" : "");
    log.line(text);
  }



  const std::vector<double> &
  AdviseRuns::differences(const AdviseRun &one, const AdviseRun &reference)
  {
    const auto key   = std::make_pair(one.name, reference.name);
    const auto there = known.find(key);
    if (there != known.end())
      return there->second;

    std::vector<double> values;
    collectively(communicator, [&]() {
      if (first_rank)
        values = measure(one, reference);
    });
    values = Utilities::MPI::broadcast(communicator, values, 0);
    return known.emplace(key, values).first->second;
  }



  std::vector<double>
  AdviseRuns::measure(const AdviseRun &one, const AdviseRun &reference) const
  {
    std::vector<MeasuredError>    errors;
    std::map<std::string, double> largest; // by column
    for (const Quantity &quantity : all_quantities)
      {
        errors.push_back(history_error(quantity,
                                       folder(one.name),
                                       folder(reference.name),
                                       period,
                                       compared));
        double &size = largest[quantity.column()];
        size         = std::max(size, errors.back().size);
      }
    std::vector<double> values;
    for (std::size_t q = 0; q < errors.size(); ++q)
      if (errors[q].size <= vanishes * largest[all_quantities[q].column()])
        values.push_back(0.);
      else
        values.push_back(errors[q].value.value_or(unknown_difference));
    return values;
  }



  void
  AdviseRuns::require_histories(const AdviseRun &run) const
  {
    collectively(communicator, [&]() {
      const std::string own = folder(run.name);
      if (!first_rank)
        return;
      bool any_moves = false;
      for (const Quantity &quantity : all_quantities)
        {
          const MeasuredError self =
            history_error(quantity, own, own, period, compared);
          if (std::isnan(self.size))
            throw SceneError("--quantities " + quantity.name +
                             ": the scene does not write it (" + self.reason +
                             "). A probe has u_3 and stresses of it in space "
                             "only, and opening and pressure on a lip.");
          any_moves = any_moves || self.size > 0.;
        }
      if (!any_moves)
        throw NumericalError(
          "advise: " + run.name +
          ": all that is compared is 0 at all instants, so that there is no "
          "relative error. Is the body loaded, and do the probes move?");
    });
  }



  double
  AdviseRuns::difference(const AdviseRun &one, const AdviseRun &reference)
  {
    const std::vector<double> &all   = differences(one, reference);
    double                     worst = 0.;
    for (std::size_t q = 0; q < all.size(); ++q)
      if (counts(q))
        worst = std::max(worst, all[q]);
    return worst;
  }
} // namespace Crevasse
