// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_slip_while_closed_h
#define crevasse_postprocess_slip_while_closed_h

#include <crevasse/base/format.h>
#include <crevasse/base/log.h>
#include <crevasse/base/text.h>
#include <crevasse/model/body.h>
#include <crevasse/time/observer.h>


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
    /** References must outlive this object. */
    SlipWhileClosed(const Body<dim> &body, Log &log)
      : body(body)
      , log(log)
      , lengths(body.space.lip.nodes.size())
    {
    }

    void
    observe(const Sample &sample) override
    {
      const auto &nodes = body.space.lip.nodes;
      if (sample.step == 0)
        {
          lengths.assign(nodes.size(), 0.);
          before.clear();
        }
      const std::vector<double> values = jumps(sample);
      for (unsigned int i = 0; i < nodes.size(); ++i)
        {
          const double *const now = &values[i * (dim + 1)];
          if (now[dim] == 0. || before.empty() ||
              before[i * (dim + 1) + dim] == 0.)
            continue;
          dealii::Tensor<1, dim> step;
          for (unsigned int d = 0; d < dim; ++d)
            step[d] = now[d] - before[i * (dim + 1) + d];
          lengths[i] +=
            (step - (step * nodes[i].normal) * nodes[i].normal).norm();
        }
      before = values;
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
                 Text::from_number(*largest) + " in a period, at " +
                 Text::from_point(where) +
                 ": there friction, which is not in the model, would matter");
    }

  private:
    /** Of each node of LipBasis the jump of the displacement, and 1 if it is
     * closed. Collective. */
    std::vector<double>
    jumps(const Sample &sample) const
    {
      const State                                    &state = sample.state;
      const Space<dim>                               &space = body.space;
      std::map<dealii::types::global_dof_index, bool> is_closed;
      for (unsigned int k = 0; k < body.lip.nodes.size(); ++k)
        is_closed[body.lip.nodes[k].dof] = state.contact_forces[k] > 0.;
      Vector whole(state.displacement);
      if (sample.secular_flow != nullptr)
        whole.add(sample.time, sample.secular_flow->velocity);
      const Vector        u     = space.nodal_values(whole);
      const auto         &nodes = space.lip.nodes;
      std::vector<double> values(nodes.size() * (dim + 1));
      for (unsigned int i = 0; i < nodes.size(); ++i)
        {
          // Before rigid planes nothing slides on another lip.
          if (nodes[i].sides[1] == dealii::numbers::invalid_dof_index)
            continue;
          double *const of_node = &values[i * (dim + 1)];
          for (const unsigned int side : {0, 1})
            for (unsigned int d = 0; d < dim; ++d)
              if (const auto dof = nodes[i].sides[side] + d;
                  u.in_local_range(dof))
                of_node[d] += (side == 0 ? 1. : -1.) * u(dof);
          if (const auto node = is_closed.find(nodes[i].unknown);
              node != is_closed.end() && node->second)
            of_node[dim] = 1.;
        }
      dealii::Utilities::MPI::sum(values, space.communicator(), values);
      return values;
    }

    const Body<dim>    &body;
    Log                &log;
    std::vector<double> lengths; ///< of the last period
    std::vector<double> before;  ///< jumps() of the last sample
  };
} // namespace Crevasse

#endif
