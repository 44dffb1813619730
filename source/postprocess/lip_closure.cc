// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/csv_table.h>
#include <crevasse/base/series_extremes.h>
#include <crevasse/postprocess/lip_closure.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    constexpr double in_jump = 2e-11; // part of the period, no step
  }                                   // namespace



  template <int dim>
  LipClosure<dim>::LipClosure(const Body<dim>   &body,
                              const std::string &file_name,
                              Evolution<dim>    &evolution)
    : body(body)
    , file_name(file_name)
    , evolution(evolution)
  {
    const auto &all = body.space.lip.nodes;
    for (unsigned int i = 0; i < all.size(); ++i)
      if (all[i].has_unknown())
        {
          places.push_back(i);
          n_lips = std::max(n_lips, all[i].lip + 1);
        }
  }



  template <int dim>
  std::vector<double>
  LipClosure<dim>::openings(const Sample &sample)
  {
    const auto here =
      body.lip.states(sample.state.displacement, sample.state.contact_forces);
    if (!rates)
      rates = sample.secular_flow == nullptr
                ? std::vector<double>(here.size())
                : body.lip.opening_rates(sample.secular_flow->velocity);
    // Nodes that the flow opens for good only have residual forces. A node
    // without weight may be the only pressed node.
    constexpr double    least = std::numeric_limits<double>::min();
    std::vector<double> values;
    for (const unsigned int i : places)
      values.push_back(here[i].is_closed && (*rates)[i] == 0.
                         ? -std::max(here[i].pressure, least)
                         : std::max(0., here[i].opening));
    return values;
  }



  template <int dim>
  void
  LipClosure<dim>::observe(const Sample &sample)
  {
    if (sample.step == 0)
      {
        period.clear();
        changes.clear();
      }
    period.push_back({sample.instant, openings(sample)});
    if (period.size() > 1)
      {
        const Moment &begin = *(period.end() - 2), &end = period.back();
        for (unsigned int lip = 0; lip < n_lips; ++lip)
          if (status(lip, begin) != status(lip, end))
            {
              changes.push_back({sample.period,
                                 begin.instant,
                                 end.instant,
                                 sample.time - sample.instant,
                                 strain,
                                 sample.viscous_strain,
                                 {},
                                 {},
                                 committed});
              break;
            }
      }
    strain    = sample.viscous_strain;
    committed = sample.state.friction.reference;
  }



  template <int dim>
  void
  LipClosure<dim>::end_of_period(const PeriodReport &report)
  {
    if (body.held_by_contact.empty() || report.period > 1)
      return;
    std::vector<bool> pressed(body.space.lip.nodes.size());
    for (const Moment &moment : period)
      for (unsigned int i = 0; i < places.size(); ++i)
        if (moment.openings[i] < 0.)
          pressed[places[i]] = true;
    require_held(body.space, pressed);
  }



  template <int dim>
  std::pair<double, double>
  LipClosure<dim>::range(const unsigned int lip, const Moment &moment) const
  {
    std::pair<double, double> found = {std::numeric_limits<double>::max(),
                                       std::numeric_limits<double>::lowest()};
    for (unsigned int i = 0; i < places.size(); ++i)
      if (lip == n_lips || body.space.lip.nodes[places[i]].lip == lip)
        {
          found.first  = std::min(found.first, moment.openings[i]);
          found.second = std::max(found.second, moment.openings[i]);
        }
    return found;
  }



  template <int dim>
  LipStatus
  LipClosure<dim>::status(const unsigned int lip, const Moment &moment) const
  {
    const auto [least, most] = range(lip, moment);
    return least >= 0. ? LipStatus::open
           : most < 0. ? LipStatus::closed
                       : LipStatus::partly_closed;
  }



  template <int dim>
  std::vector<LipMoment>
  LipClosure<dim>::period_of(const unsigned int lip) const
  {
    std::vector<LipMoment> all;
    for (const Moment &moment : period)
      all.push_back({moment.instant, status(lip, moment)});
    return all;
  }



  template <int dim>
  double
  LipClosure<dim>::closed_time(const unsigned int node,
                               const unsigned int i) const
  {
    const double length = period[i + 1].instant - period[i].instant;
    const double begin  = period[i].openings[node];
    const double end    = period[i + 1].openings[node];
    if ((begin < 0.) == (end < 0.))
      return end < 0. ? length : 0.;
    // The motion is periodic: the last period ended like this one.
    const Moment &earlier = period[i > 0 ? i - 1 : period.size() - 2];
    const double  last_length =
      period[i > 0 ? i : period.size() - 1].instant - earlier.instant;
    const double before = earlier.openings[node];
    const double falls  = std::abs(before) - std::abs(begin);
    double       change = begin == 0. ? 0. : 0.5 * length;
    // A line that vanishes somewhat later is not a jump.
    if ((before < 0.) == (begin < 0.) && falls > 0. &&
        last_length > in_jump * period.back().instant &&
        std::abs(begin) * last_length <= (length + last_length) * falls)
      change = std::min(std::abs(begin) * last_length / falls, length);
    return begin < 0. ? change : length - change;
  }



  template <int dim>
  void
  LipClosure<dim>::serialize(StateArchive &archive)
  {
    archive.section("closure of the lip");
    std::size_t n_moments = period.size(), n_changes = changes.size();
    archive.common(n_moments);
    archive.common(n_changes);
    period.resize(n_moments);
    changes.resize(n_changes);
    for (Moment &moment : period)
      {
        archive.common(moment.instant);
        archive.common(moment.openings);
      }
    for (Change &change : changes)
      {
        archive.common(change.period);
        archive.common(change.begin);
        archive.common(change.end);
        archive.common(change.begin_of_period);
        archive.at_points(change.strain_at_begin);
        archive.at_points(change.strain_at_end);
        archive.on_bounds(change.committed);
      }
    archive.at_points(strain);
    archive.on_bounds(committed);
  }



  template <int dim>
  void
  LipClosure<dim>::summarise(Summary &summary)
  {
    if (!failure.empty())
      summary["warnings"].push_back(failure);
    if (period.size() > 1)
      {
        const auto [wholly, partly] = closed_parts(period_of(n_lips));
        summary["closed_part"]      = {{"wholly", wholly}, {"partly", partly}};
      }
    std::vector<std::string> columns = {"lip", "x", "y", "z"};
    columns.resize(1 + dim);
    columns.insert(columns.end(),
                   {"closed_part", "largest_opening", "largest_pressure"});
    std::vector<std::vector<double>> rows;
    for (unsigned int i = 0; i < places.size(); ++i)
      {
        double              closed = 0.;
        std::vector<double> instants, opening, pressure;
        for (unsigned int k = 0; k < period.size(); ++k)
          {
            instants.push_back(period[k].instant);
            opening.push_back(std::max(0., period[k].openings[i]));
            pressure.push_back(std::max(0., -period[k].openings[i]));
            if (k + 1 < period.size())
              closed += closed_time(i, k) /
                        (period.back().instant - period.front().instant);
          }
        const auto         &node = body.space.lip.nodes[places[i]];
        std::vector<double> row  = {1. + node.lip};
        row.insert(row.end(), node.point.begin_raw(), node.point.end_raw());
        row.push_back(closed);
        for (const auto *series : {&opening, &pressure})
          row.push_back(period.empty()
                          ? 0.
                          : SeriesExtremes(instants, *series).largest.value);
        rows.push_back(row);
      }
    double size = 0.;
    for (const auto &node : body.space.lip.nodes)
      size = std::max(size, node.point.norm());
    // Rows are sorted by lip, x and y; values equal to rounding are equal.
    const double rounding = 1e-10 * size;
    std::sort(rows.begin(), rows.end(), [rounding](auto &a, auto &b) {
      unsigned int i = 0;
      while (i < dim && std::abs(a[i] - b[i]) <= rounding)
        ++i;
      return a[i] < b[i];
    });
    CsvTable table(file_name, columns);
    for (const auto &row : rows)
      table.add_row(row);
  }



  template <int dim>
  std::vector<LipMoment>
  LipClosure<dim>::lip_at(const Point<dim> &tip) const
  {
    const auto &all = body.space.lip.nodes;
    const auto  nearest =
      std::min_element(all.begin(),
                       all.end(),
                       [&tip](const auto &a, const auto &b) {
                         return a.point.distance(tip) < b.point.distance(tip);
                       });
    return period_of(nearest->lip);
  }



  template class LipClosure<2>;
  template class LipClosure<3>;
} // namespace Crevasse
