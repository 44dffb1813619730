// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_slip_while_closed_h
#define crevasse_postprocess_slip_while_closed_h

#include <crevasse/base/format.h>
#include <crevasse/base/log.h>
#include <crevasse/base/text.h>
#include <crevasse/model/body.h>
#include <crevasse/time/observer.h>

#include <boost/serialization/map.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

namespace Crevasse
{
  /**
   * How far closed lips slide on each other in the last period: at each pair of
   * nodes the length of the path of the tangential jump between samples at
   * which it is closed. The model has no friction; where they slide, friction
   * would matter.
   */
  template <int dim>
  class SlipWhileClosed : public Observer
  {
  public:
    /** Collective. References must outlive this object. */
    SlipWhileClosed(const Body<dim> &body, Log &log)
      : body(body)
      , log(log)
      , lengths(body.space.lip.nodes.size())
    {
      const Space<dim>             &space = body.space;
      std::map<Index, Jumps>        mine;
      std::map<Index, unsigned int> numbers;
      for (unsigned int i = 0; i < lengths.size(); ++i)
        // Before rigid planes nothing slides on another lip.
        if (const auto &node = space.lip.nodes[i];
            node.sides[1] != dealii::numbers::invalid_dof_index)
          {
            numbers[node.unknown] = i;
            for (unsigned int d = 0; d < dim; ++d)
              for (const unsigned int side : {0, 1})
                if (const Index dof = node.sides[side] + d;
                    space.locally_owned_unknowns.is_element(dof))
                  {
                    const auto *line =
                      space.constraints.get_constraint_entries(dof);
                    const Weights itself{{dof, 1.}};
                    for (const auto &[unknown, weight] :
                         line == nullptr ? itself : *line)
                      mine[unknown].emplace_back(i * (dim + 1) + d,
                                                 side == 0 ? weight : -weight);
                  }
          }
      for (const auto &of_rank :
           dealii::Utilities::MPI::all_gather(space.communicator(), mine))
        for (const auto &[unknown, entries] : of_rank)
          if (const auto &owned = space.locally_owned_unknowns;
              owned.is_element(unknown))
            {
              Jumps &of_unknown = jumps[owned.index_within_set(unknown)];
              of_unknown.insert(of_unknown.end(),
                                entries.begin(),
                                entries.end());
            }
      for (unsigned int k = 0; k < body.lip.nodes.size(); ++k)
        if (const auto at = numbers.find(body.lip.nodes[k].dof);
            at != numbers.end())
          bounds.emplace_back(k, at->second * (dim + 1) + dim);
    }

    void
    observe(const Sample &sample) override
    {
      if (sample.step == 0)
        {
          lengths.assign(lengths.size(), 0.);
          before.clear();
        }
      look_at(sample);
      for (unsigned int i = 0; i < lengths.size() && !before.empty(); ++i)
        {
          const double *const here  = &now[i * (dim + 1)];
          const double *const there = &before[i * (dim + 1)];
          if (here[dim] == 0. || there[dim] == 0.)
            continue;
          dealii::Tensor<1, dim> step;
          for (unsigned int d = 0; d < dim; ++d)
            step[d] = here[d] - there[d];
          const auto &normal = body.space.lip.nodes[i].normal;
          lengths[i] += (step - (step * normal) * normal).norm();
        }
      before.swap(now);
    }

    void
    serialize(StateArchive &archive) override
    {
      archive.section("slip while closed");
      archive.common(lengths);
      archive.common(before);
    }

    /** Adds "slip_while_closed" to the summary. */
    void
    summarise(Summary &summary) override
    {
      const auto largest = std::max_element(lengths.begin(), lengths.end());
      if (largest == lengths.end())
        return;
      const dealii::Point<dim> &where =
        body.space.lip.nodes[largest - lengths.begin()].point;
      Summary &slip   = summary["slip_while_closed"];
      slip["largest"] = *largest;
      for (unsigned int d = 0; d < dim; ++d)
        slip["at"].push_back(where[d]);
      constexpr double some = 1e-6; // of the largest displacement
      const double     size = summary["extremes"].value("displacement", 0.);
      if (*largest > some * size)
        log.line("  closed lips slide on each other by up to " +
                 Text::from_number(*largest, 3) + " in a period, at " +
                 Text::from_point(where) +
                 ": there friction, which is not in the model, would matter");
    }

  private:
    using Index   = dealii::types::global_dof_index;
    using Weights = OpeningUnknowns::Weights;
    /** Entries of a list of jumps, and with which weights an unknown is there.
     */
    using Jumps = std::vector<std::pair<unsigned int, double>>;

    /** Of each node of LipBasis the jump of the displacement, and 1 if it is
     * closed. Collective. */
    void
    look_at(const Sample &sample)
    {
      const SecularFlow *const flow = sample.secular_flow;
      now.assign(lengths.size() * (dim + 1), 0.);
      for (const auto &[unknown, entries] : jumps)
        {
          double u = sample.state.displacement.local_element(unknown);
          if (flow != nullptr)
            u += sample.time * flow->velocity.local_element(unknown);
          for (const auto &[entry, weight] : entries)
            now[entry] += weight * u;
        }
      for (const auto &[k, entry] : bounds)
        now[entry] = sample.state.contact_forces[k] > 0. ? 1. : 0.;
      dealii::Utilities::MPI::sum(now, body.space.communicator(), now);
    }

    const Body<dim>    &body;
    Log                &log;
    std::vector<double> lengths;     ///< of the last period
    std::vector<double> now, before; ///< look_at() at this and the last sample

    std::map<unsigned int, Jumps> jumps; ///< of this rank's unknowns
    /** This rank's bounds, and the entries that tell whether they are closed.
     */
    std::vector<std::pair<unsigned int, unsigned int>> bounds;
  };
} // namespace Crevasse

#endif
