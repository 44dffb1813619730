// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/csv_table.h>
#include <crevasse/discretisation/lip_faces.h>
#include <crevasse/postprocess/lip_closure.h>
#include <crevasse/postprocess/lip_state.h>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/connected_components.hpp>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  LipClosure<dim>::LipClosure(const Body<dim>   &body,
                              const double       largest_load,
                              const std::string &file_name)
    : body(body)
    , negligible_force(1e-9 * largest_load)
    , file_name(file_name)
    , lips(numbers_of_lips())
  {
    std::map<types::global_dof_index, unsigned int> number_of;
    for (unsigned int i = 0; i < lips.size(); ++i)
      if (const auto &node = body.space.lip.nodes[i]; node.has_unknown())
        {
          number_of[node.unknown] = nodes.size();
          nodes.push_back({lips[i]});
          places.push_back(i);
        }
    for (const LipNode<dim> &node : body.lip.nodes)
      mine.push_back(number_of.at(node.dof));
    steps.resize(
      lips.empty() ? 1 : 2 + *std::max_element(lips.begin(), lips.end()));
  }



  template <int dim>
  std::vector<unsigned int>
  LipClosure<dim>::numbers_of_lips() const
  {
    const auto &all = body.space.lip.nodes;
    std::multimap<types::global_dof_index, unsigned int> nodes_at;
    for (unsigned int i = 0; i < all.size(); ++i)
      for (const auto side : all[i].sides)
        nodes_at.emplace(side, i);
    boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS> graph(
      all.size());
    for (const LipFace<dim> &face : find_lip_faces(body.space))
      {
        const auto first = nodes_at.find(face.nodes.front().first);
        for (const auto &node : face.nodes)
          for (auto [at, end] = nodes_at.equal_range(node.first); at != end;
               ++at)
            add_edge(first->second, at->second, graph);
      }
    std::vector<unsigned int> numbers(all.size());
    boost::connected_components(graph, numbers.data());
    return numbers;
  }



  template <int dim>
  std::vector<double>
  LipClosure<dim>::openings(const State &state) const
  {
    const double        touching = largest_opening_of_closed(state);
    std::vector<double> values(nodes.size());
    for (unsigned int k = 0; k < mine.size(); ++k)
      {
        const LipNode<dim> &node  = body.lip.nodes[k];
        const double        force = state.contact_forces[k];
        values[mine[k]] =
          force > negligible_force &&
              node.is_pressed(force, state.displacement, touching)
            ? -force / node.weight
            : std::max(0., node.opening(state.displacement));
      }
    Utilities::MPI::sum(values, body.space.communicator(), values);
    return values;
  }



  template <int dim>
  void
  LipClosure<dim>::observe(const Sample &sample)
  {
    if (sample.step == 0)
      {
        for (Node &node : nodes)
          node = {node.lip};
        for (auto &of_lip : steps)
          of_lip.clear();
      }
    now = openings(sample.state);
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        Node &node            = nodes[i];
        node.largest_opening  = std::max(node.largest_opening, now[i]);
        node.largest_pressure = std::max(node.largest_pressure, -now[i]);
      }
    if (sample.step > 0)
      add_step(last_instant, sample.instant);
    earlier.swap(before);
    before.swap(now);
    last_step    = sample.time - last_time;
    last_time    = sample.time;
    last_instant = sample.instant;
  }



  template <int dim>
  void
  LipClosure<dim>::add_step(const double begin, const double end)
  {
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        const bool   was_closed = before[i] < 0., is_closed = now[i] < 0.;
        const double change =
          was_closed == is_closed ? end : instant_of_change(i, begin, end);
        const double closed_from = was_closed ? begin : change;
        const double closed_to   = is_closed ? end : change;
        nodes[i].closed += closed_to - closed_from;

        const double open_from = was_closed ? change : begin;
        const double open_to = is_closed ? (was_closed ? begin : change) : end;
        for (auto *lip : {&steps[nodes[i].lip], &steps.back()})
          {
            if (lip->empty() || lip->back().end < end)
              lip->push_back({begin, end, begin, end, begin, end});
            LipStep &step    = lip->back();
            step.closed_from = std::max(step.closed_from, closed_from);
            step.closed_to   = std::min(step.closed_to, closed_to);
            step.open_from   = std::max(step.open_from, open_from);
            step.open_to     = std::min(step.open_to, open_to);
          }
      }
  }



  template <int dim>
  double
  LipClosure<dim>::instant_of_change(const unsigned int node,
                                     const double       begin,
                                     const double       end) const
  {
    const double last = std::abs(before[node]);
    if (last == 0.)
      return begin;
    if (!earlier.empty() && (earlier[node] < 0.) == (before[node] < 0.) &&
        std::abs(earlier[node]) > last)
      {
        const double instant =
          begin + last * last_step / (std::abs(earlier[node]) - last);
        // A line that vanishes somewhat later is no jump.
        if (instant <= end + last_step)
          return std::min(instant, end);
      }
    return 0.5 * (begin + end);
  }



  template <int dim>
  void
  LipClosure<dim>::serialize(StateArchive &archive)
  {
    archive.section("closure of the lip");
    archive.common_list(nodes);
    for (auto &of_lip : steps)
      archive.common_list(of_lip);
    archive.common(before);
    archive.common(earlier);
    archive.common(last_instant);
    archive.common(last_step);
    archive.common(last_time);
  }



  template <int dim>
  void
  LipClosure<dim>::summarise(Summary &summary)
  {
    if (!steps.back().empty())
      {
        const auto [wholly, partly] = closed_parts(steps.back());
        summary["closed_part"]      = {{"wholly", wholly}, {"partly", partly}};
      }
    std::vector<std::string> columns = {"lip", "x", "y", "z"};
    columns.resize(1 + dim);
    columns.insert(columns.end(),
                   {"closed_part", "largest_opening", "largest_pressure"});
    std::vector<std::vector<double>> rows;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        const Node                 &node   = nodes[i];
        const std::vector<LipStep> &period = steps[node.lip];
        std::vector<double>         row    = {1. + node.lip};
        const Point<dim> &point = body.space.lip.nodes[places[i]].point;
        row.insert(row.end(), point.begin_raw(), point.end_raw());
        row.insert(row.end(),
                   {period.empty() ? 0.
                                   : node.closed / (period.back().end -
                                                    period.front().begin),
                    node.largest_opening,
                    node.largest_pressure});
        rows.push_back(row);
      }
    double size = 0.;
    for (const auto &node : body.space.lip.nodes)
      size = std::max(size, node.point.norm());
    // Along x, then y: rounding of a coordinate is no order.
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
  const std::vector<LipStep> &
  LipClosure<dim>::steps_of_lip_at(const Point<dim> &tip) const
  {
    const auto &all = body.space.lip.nodes;
    const auto  nearest =
      std::min_element(all.begin(),
                       all.end(),
                       [&tip](const auto &a, const auto &b) {
                         return a.point.distance(tip) < b.point.distance(tip);
                       });
    return steps[lips[nearest - all.begin()]];
  }



  template class LipClosure<2>;
  template class LipClosure<3>;
} // namespace Crevasse
