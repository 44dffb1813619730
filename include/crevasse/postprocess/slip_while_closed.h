// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_slip_while_closed_h
#define crevasse_postprocess_slip_while_closed_h

#include <crevasse/base/log.h>
#include <crevasse/base/text.h>
#include <crevasse/model/body.h>
#include <crevasse/time/observer.h>


namespace Crevasse
{
  /**
   * Measures how far closed lips slide on each other in the last period: for
   * each pair of nodes, the path length of the tangential jump between samples
   * at which the pair is closed. Without friction, where lips slide, friction
   * would matter.
   */
  template <int dim>
  class SlipWhileClosed : public Observer
  {
  public:
    /** Collective. References must outlive the SlipWhileClosed. */
    SlipWhileClosed(const Body<dim> &body, Log &log)
      : body(body)
      , log(log)
      , lengths(body.space.lip.nodes.size())
    {
    }

    void
    observe(const Sample &sample) override
    {
      if (sample.step == 0)
        {
          lengths.assign(lengths.size(), 0.);
          before.clear();
        }
      std::vector<double> now = look_at(sample);
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
      constexpr double some = 1e-6; // relative to displacement
      const double     size = summary["extremes"].value("displacement", 0.);
      if (*largest > some * size)
        log.line("  closed lips slide on each other by up to " +
                 Text::from_number(*largest, 3) + " per period, at " +
                 Text::from_point(where) + "; friction would matter there" +
                 (dim == 2 ? ": [Boundary] Friction coefficient" : ""));
    }

  private:
    /** For each node of LipBasis, the jump of the displacement, and 1 if the
     * node is closed. Collective. */
    std::vector<double>
    look_at(const Sample &sample) const
    {
      Vector u = sample.state.displacement;
      if (const SecularFlow *const flow = sample.secular_flow; flow != nullptr)
        u.add(sample.time, flow->velocity);
      const LipBasis<dim> &lip   = body.space.lip;
      const auto           jumps = lip.jumps(
        body.nodal_displacement(u, sample.state.instant, sample.time));
      const auto states =
        body.lip.states(sample.state.displacement, sample.state.contact_forces);
      std::vector<double> all;
      for (unsigned int i = 0; i < jumps.size(); ++i)
        {
          all.insert(all.end(), jumps[i].begin_raw(), jumps[i].end_raw());
          // At rigid planes there is no second lip to slide on.
          const bool has_two =
            lip.nodes[i].sides[1] != dealii::numbers::invalid_dof_index;
          all.push_back(has_two && states[i].is_closed ? 1. : 0.);
        }
      return all;
    }

    const Body<dim>    &body;
    Log                &log;
    std::vector<double> lengths; ///< slip in the last period
    std::vector<double> before;  ///< states at the last sample
  };
} // namespace Crevasse

#endif
