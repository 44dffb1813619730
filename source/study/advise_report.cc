// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/base/text_file.h>
#include <crevasse/base/version.h>
#include <crevasse/study/advise_report.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

namespace Crevasse
{
  namespace
  {
    std::string
    row(const std::vector<std::string> &cells)
    {
      return "| " + Text::join(cells, " | ") + " |\n";
    }



    std::string
    header(const std::vector<std::string> &cells)
    {
      return row(cells) + row(std::vector<std::string>(cells.size(), "---"));
    }



    std::string
    count(const double number)
    {
      return std::to_string(std::llround(number));
    }



    /** Text as lines of a comment in a scene. */
    std::string
    comment(const std::string &text)
    {
      constexpr unsigned int width = 77;
      std::string            lines;
      for (const std::string &line :
           dealii::Utilities::break_text_into_lines(text, width))
        lines += "# " + line + '\n';
      return lines;
    }



    std::string
    seconds(const AdviseRun &run)
    {
      return AdviseReport::short_number(run.seconds());
    }
  } // namespace



  AdviseReport::AdviseReport(const std::string  &scene_file,
                             const double        target,
                             const bool          reached,
                             const AdvisePairs  &pairs,
                             const AdviseSearch &space,
                             const AdviseSearch &time,
                             const AdviseRuns   &runs)
    : scene_file(scene_file)
    , target(target)
    , reached(reached)
    , pairs(pairs)
    , space(space)
    , time(time)
    , runs(runs)
  {
  }



  std::string
  AdviseReport::short_number(const double number)
  {
    char text[40];
    std::snprintf(text, sizeof(text), "%.2g", number);
    return text;
  }



  void
  AdviseReport::write(const std::string &directory) const
  {
    write_atomically(scene(), directory + "/advised.prm");
    write_atomically(markdown(), directory + "/advice.md");
    write_atomically(json().dump(2) + '\n', directory + "/advice.json");
  }



  std::vector<AdviseReport::Change>
  AdviseReport::changes() const
  {
    std::vector<Change> all;
    for (const auto &[section, parameters] : advised->parameters.items())
      if (parameters.is_object() && original->parameters.contains(section))
        for (const auto &[name, now] : parameters.items())
          {
            const Summary &before = original->parameters.at(section).at(name);
            const auto     text   = [](const Summary &value) {
              return value.is_string() ? value.get<std::string>()
                                             : value.dump();
            };
            if (before != now)
              all.push_back(
                {"[" + section + "] " + name, text(before), text(now)});
          }
    return all;
  }



  std::string
  AdviseReport::measured() const
  {
    const AdviseFinalist &best = pairs.best();
    if (best.reference == nullptr)
      return "Its error is estimated as " + short_number(best.error) +
             ", for no finer run could be made.";
    return "Its error, measured against " + best.reference->name + ", is " +
           short_number(best.error) +
           (reached ? "." : ", more than was asked for.");
  }



  std::string
  AdviseReport::scene() const
  {
    const std::string name =
      std::filesystem::path(scene_file).filename().string();
    std::vector<std::string> compared;
    for (const Quantity &quantity : runs.quantities())
      compared.push_back(quantity.name);
    std::string text =
      comment(name +
              " with the settings that crevasse advise has found for an error "
              "of " +
              Text::from_number(target) + " in " + Text::join(compared, ", ") +
              ": " + choice + ".") +
      comment(measured()) +
      comment("What the body is and bears is as it was. Changed are:");
    for (const Change &change : changes())
      text += "#   " + change.parameter + " = " + change.now + " (was " +
              (change.before.empty() ? "empty" : change.before) + ")\n";
    return text + "\n" + advised->used;
  }



  std::vector<std::string>
  AdviseReport::conclusion(const std::string &directory) const
  {
    const AdviseFinalist    &best  = pairs.best();
    std::vector<std::string> lines = {
      std::string(reached ? "Advice: " : "Nearest: ") + choice,
      "  " + measured(),
      "  It takes " + seconds(*best.run) + " s of the processor."};
    if (run_as_it_was != nullptr && !run_as_it_was->result.has_results())
      lines.push_back(
        "  The scene with its own settings: " + run_as_it_was->result.status +
        ": " + run_as_it_was->result.message);
    else if (run_as_it_was != nullptr)
      lines.back() +=
        " The scene's own settings take " + seconds(*run_as_it_was) + " s" +
        (error_as_it_was && std::isfinite(*error_as_it_was)
           ? " and have an error of " + short_number(*error_as_it_was)
           : "") +
        (run_as_it_was->usable() ? "."
                                 : " (" + run_as_it_was->result.status + ").");
    for (std::size_t q = 0; q < runs.quantities().size(); ++q)
      if (!runs.counts(q))
        lines.push_back("  " + runs.quantities()[q].name +
                        " does not count: it does not converge (advice.md).");
    lines.push_back("  scene in " + directory + "/advised.prm, evidence in " +
                    "advice.md and advice.json there");
    return lines;
  }



  std::string
  AdviseReport::markdown() const
  {
    std::string text =
      "# Settings of " + std::filesystem::path(scene_file).filename().string() +
      " for an error of " + Text::from_number(target) + "\n\n" +
      (reached ? "" : "**The error is not reached.** What comes nearest:\n\n") +
      choice + "\n\n" + measured() + "\n\n";
    text += header({"parameter", "was", "is"});
    for (const Change &change : changes())
      text += row({change.parameter, change.before, change.now});
    text += '\n' + table_of_quantities();
    if (pairs.best().shared > 0.)
      text += "\nTo the largest of these " + short_number(pairs.best().shared) +
              " is added, which the advised settings and the reference are "
              "estimated to have in common.\n";
    text +=
      "\nDifferences are relative to the largest value of the quantity, "
      "over ";
    text += runs.periodic()
              ? "the last period; displacements are compared less their mean "
                "values, for a constant of them depends on how the periodic "
                "state is found.\n"
              : "all instants that two runs share.\n";
    text +=
      "Seconds are those of the processor.\n\n## Runs of both parts "
      "together\n\n" +
      table_of_finalists() + "\n## Errors in time, on a coarse mesh\n\n" +
      table_of_points(time) + "\n## Errors in space, with the same steps\n\n" +
      table_of_points(space) + "\n" + notes();
    return text;
  }



  std::string
  AdviseReport::table_of_quantities() const
  {
    if (errors.empty())
      return "";
    std::string text = header({"quantity", "difference from the reference"});
    for (std::size_t q = 0; q < errors.size(); ++q)
      text += row({runs.quantities()[q].name,
                   runs.counts(q) ? short_number(errors[q]) : "left out"});
    return text;
  }



  std::string
  AdviseReport::table_of_finalists() const
  {
    std::string text = header({"run", "error", "unknowns", "VIs", "seconds"});
    for (const AdviseFinalist &finalist : pairs.finalists())
      text += row({finalist.run->name +
                     (finalist.run == pairs.best().run ? " (chosen)" : ""),
                   short_number(finalist.error),
                   count(finalist.run->cost("unknowns")),
                   count(finalist.run->cost("vi_solves")),
                   seconds(*finalist.run)});
    if (run_as_it_was != nullptr && !run_as_it_was->result.has_results())
      text +=
        row({"the scene as it was", run_as_it_was->result.status, "", "", ""});
    else if (run_as_it_was != nullptr)
      text +=
        row({"the scene as it was",
             !error_as_it_was                  ? ""
             : std::isfinite(*error_as_it_was) ? short_number(*error_as_it_was)
                                               : "no instants in common",
             count(run_as_it_was->cost("unknowns")),
             count(run_as_it_was->cost("vi_solves")),
             seconds(*run_as_it_was)});
    return text;
  }



  std::string
  AdviseReport::table_of_points(const AdviseSearch &search) const
  {
    std::string text =
      header({"candidate", "estimated error", "unknowns", "VIs", "seconds"});
    for (std::size_t p = 0; p < search.points().size(); ++p)
      {
        const AdvisePoint &point = search.points()[p];
        text += row({point.candidate.text +
                       (p == search.reference() ? " (reference)" : ""),
                     short_number(point.error),
                     count(point.run->cost("unknowns")),
                     count(point.run->cost("vi_solves")),
                     seconds(*point.run)});
      }
    return text;
  }



  std::string
  AdviseReport::notes() const
  {
    std::string text;
    for (const AdviseSearch *search : {&time, &space})
      for (const std::string &note : search->notes())
        text += "- " + note + "\n";
    return text.empty() ? "" : "## Notes\n\n" + text;
  }



  Summary
  AdviseReport::json_of_points(const AdviseSearch &search) const
  {
    Summary list = Summary::array();
    for (const AdvisePoint &point : search.points())
      list.push_back({{"candidate", point.candidate.text},
                      {"run", point.run->name},
                      {"estimated_error", point.error},
                      {"costs", point.run->result.costs}});
    return list;
  }



  Summary
  AdviseReport::json() const
  {
    const AdviseFinalist &best = pairs.best();
    Summary               json;
    json["scene"]   = scene_file;
    json["target"]  = target;
    json["reached"] = reached;
    json["choice"]  = choice;
    json["error"]   = best.error;
    json["seconds"] = best.run->seconds();
    json["run"]     = best.run->name;
    for (std::size_t q = 0; q < errors.size(); ++q)
      json["errors"][runs.quantities()[q].name] = errors[q];
    json["reference"] =
      best.reference != nullptr ? Summary(best.reference->name) : Summary();
    for (const Change &change : changes())
      json["changes"][change.parameter] = {{"was", change.before},
                                           {"is", change.now}};
    json["periodic_state"] = runs.periodic();
    json["counts"]         = Summary::array();
    json["left_out"]       = Summary::array();
    for (std::size_t q = 0; q < runs.quantities().size(); ++q)
      json[runs.counts(q) ? "counts" : "left_out"].push_back(
        runs.quantities()[q].name);
    json["finalists"] = Summary::array();
    for (const AdviseFinalist &finalist : pairs.finalists())
      json["finalists"].push_back(
        {{"run", finalist.run->name},
         {"error", finalist.error},
         {"reference",
          finalist.reference != nullptr ? Summary(finalist.reference->name)
                                        : Summary()},
         {"costs", finalist.run->result.costs}});
    json["time"]  = json_of_points(time);
    json["space"] = json_of_points(space);
    json["notes"] = Summary::array();
    for (const AdviseSearch *search : {&time, &space})
      for (const std::string &note : search->notes())
        json["notes"].push_back(note);
    if (run_as_it_was != nullptr)
      json["original"] = {
        {"status", run_as_it_was->result.status},
        {"error", error_as_it_was ? Summary(*error_as_it_was) : Summary()},
        {"costs", run_as_it_was->result.costs}};
    return json;
  }
} // namespace Crevasse
