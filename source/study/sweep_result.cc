// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/study/sweep_result.h>

namespace Crevasse
{
  namespace
  {
    Summary
    json_of(const MeasuredError &error)
    {
      Summary json;
      json["value"]    = error.value ? Summary(*error.value) : Summary();
      json["instants"] = error.instants;
      if (!error.reason.empty())
        json["reason"] = error.reason;
      return json;
    }



    MeasuredError
    error_of(const Summary &json)
    {
      MeasuredError error;
      if (!json.at("value").is_null())
        error.value = json.at("value").get<double>();
      error.instants = json.at("instants").get<std::size_t>();
      error.reason   = json.value("reason", "");
      return error;
    }
  } // namespace



  bool
  SweepResult::has_results() const
  {
    return status == "done" || status == "not converged";
  }



  Summary
  SweepResult::to_json() const
  {
    Summary json;
    json["status"]  = status;
    json["message"] = message;
    json["errors"]  = Summary::object();
    for (const auto &[name, error] : errors)
      json["errors"][name] = json_of(error);
    json["costs"]         = costs;
    json["compared with"] = basis;
    return json;
  }



  SweepResult
  SweepResult::from_json(const Summary &json)
  {
    SweepResult result;
    result.status  = json.at("status").get<std::string>();
    result.message = json.at("message").get<std::string>();
    result.basis   = json.at("compared with").get<std::string>();
    result.costs   = json.at("costs");
    for (const auto &[name, error] : json.at("errors").items())
      result.errors[name] = error_of(error);
    return result;
  }



  const std::vector<std::string> &
  cost_names()
  {
    static const std::vector<std::string> names = {"unknowns",
                                                   "periods",
                                                   "vi_solves",
                                                   "linear_solves",
                                                   "factorisations",
                                                   "rate_evaluations",
                                                   "seconds",
                                                   "seconds_time_stepping",
                                                   "processor_seconds"};
    return names;
  }



  Summary
  costs_in(const Summary &summary)
  {
    // The entries of the summary that do not have the names of the table.
    const std::map<std::string, std::string> elsewhere = {
      {"unknowns", "/unknowns"},
      {"periods", "/periods"},
      {"processor_seconds", "/processor_seconds"},
      {"seconds", "/seconds/total"},
      {"seconds_time_stepping", "/seconds/time stepping"}};
    Summary costs = Summary::object();
    for (const std::string &name : cost_names())
      {
        const auto                  place = elsewhere.find(name);
        const Summary::json_pointer pointer(
          place != elsewhere.end() ? place->second : "/counters/" + name);
        if (summary.contains(pointer))
          costs[name] = summary.at(pointer);
      }
    return costs;
  }
} // namespace Crevasse
