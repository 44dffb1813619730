// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/postprocess/tip_table.h>

namespace Crevasse
{
  void
  TipTable::summarise_interface(const InterfaceTip &interface,
                                Summary            &summary,
                                Summary            &tip) const
  {
    const double zone =
      largest_value([](const TipValues &v) { return v.contact_zone; });
    tip["interface"] = {{"epsilon", interface.epsilon()},
                        {"length", interface.length},
                        {"contact_zone", zone}};
    if (zone == 0.)
      return;
    const bool is_wide = analysis.intensity.is_wide(zone);
    context.log.line(
      title +
      Text::format("the lips are closed next to it over up to %.4g, %.2g %% of "
                   "the crack: ",
                   zone,
                   100. * zone / interface.length) +
      (is_wide
         ? "where it is at least 1 %, K_I = 0, and K_II is that of closed "
           "lips"
         : "K is that of the field around this zone"));
    constexpr double few = 3.;
    if (is_wide && zone < few * analysis.intensity.region.cell_radius)
      warn("[Crack tip]: at " + Text::from_point(place.position) +
             " the zone of contact has less than three cells: refine the mesh "
             "at the tip ([Refinement] Strategy = tip)",
           context.log,
           summary);
  }



  void
  TipTable::summarise_growth(Summary &summary, Summary &tip) const
  {
    TipHistory growing = history();
    tip["Delta_K"]     = growing.range;
    if (analysis.has_temperature)
      tip["theta"] = growing.temperature;
    context.log.line(title + "Delta K " + Text::from_number(growing.range, 6) +
                     (context.closure != nullptr && instants.size() > 1
                        ? summarise_closure(growing, tip)
                        : ""));
    analysis.summarise_growth(growing, title, tip, context.log);
    if (growing.c_star && *growing.c_star > 0. && instants.size() > 1)
      judge_transition(growing, summary, tip);
  }



  void
  TipTable::judge_transition(const TipHistory &history,
                             Summary          &summary,
                             Summary          &tip) const
  {
    std::array<double, 2> mean = {};
    for (std::size_t k = 1; k < instants.size(); ++k)
      for (const unsigned int mode : {0, 1})
        mean[mode] += 0.5 * (instants[k] - instants[k - 1]) / history.period() *
                      (of_last_period[k - 1].intensity[mode] +
                       of_last_period[k].intensity[mode]);
    const double time      = analysis.transition_time(mean, *history.c_star);
    tip["transition_time"] = time;
    const double growth    = tip.value("da_dN", 0.) * time / history.period(),
                 part = growth / analysis.intensity.region.largest_radius();
    context.log.line(
      title + "creep is steady after " + Text::from_number(time, 4) +
      " (time)" +
      (growth > 0.
         ? "; the crack grows by " + Text::from_number(growth, 4) + " meanwhile"
         : ""));
    constexpr double steady = 0.1;
    if (part > steady)
      warn("[Crack tip]: at " + Text::from_point(place.position) +
             " the crack grows by " +
             Text::from_number(std::round(100. * part)) +
             " % of the distance to the next boundary before creep is steady: "
             "C* does not describe its growth",
           context.log,
           summary);
  }



  std::string
  TipTable::summarise_closure(TipHistory &history, Summary &tip) const
  {
    const std::vector<LipMoment> lip = context.closure->lip_at(place.position);
    const auto [wholly, partly]      = closed_parts(lip);
    const auto worst =
      std::max_element(of_last_period.begin(),
                       of_last_period.end(),
                       [](const TipValues &a, const TipValues &b) {
                         return a.intensity[0] < b.intensity[0];
                       });
    const double most =
      largest([](const TipValues &v) { return v.intensity[0]; });
    LipOpening opens =
      last_opening(lip, instants[worst - of_last_period.begin()]);
    if (opens.why_not.empty())
      opens.why_not = context.closure->failure;
    tip["K_opening"] = tip["opening_ratio"] = Summary();
    if (wholly + partly > 0.)
      history.effective_range = TipHistory::not_known;
    tip["closed_part"] = {{"wholly", wholly}, {"partly", partly}};
    std::string line   = ", no K_op: " + opens.why_not;
    if (opens.why_not.empty())
      {
        const auto at =
          std::find(instants.begin(), instants.end(), opens.instant);
        const double K_op = of_last_period[at - instants.begin()].intensity[0];
        tip["K_opening"]  = K_op;
        if (most > 0.)
          tip["opening_ratio"] = K_op / most;
        history.effective_range = equivalent_range(most - K_op);
        line                    = Text::format(", Delta K_eff %.6g, K_op %.4g",
                            history.effective_range,
                            K_op);
      }
    else
      tip["no_K_opening"] = opens.why_not;
    tip["Delta_K_eff"] = history.effective_range; // null if not known
    line += Text::format("; lip wholly closed for %.1f %% of the period",
                         100. * wholly);
    return partly < 5e-4 // prints as 0.0 %
             ? line
             : line + Text::format(", partly for %.1f %%", 100. * partly);
  }
} // namespace Crevasse
