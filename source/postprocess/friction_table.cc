// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/lip/along_lips.h>
#include <crevasse/postprocess/friction_table.h>

#include <deal.II/base/mpi.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** The component along the tangent of the plane; in space the size. */
    template <std::size_t n>
    double
    shown(const std::array<double, n> &along)
    {
      return n == 1 ? along[0] : std::hypot(along[0], along[n - 1]);
    }
  } // namespace



  template <int dim>
  FrictionTable<dim>::FrictionTable(const Body<dim>    &body,
                                    const std::string  &file_name,
                                    const NetSlip<dim> &net_slip,
                                    const double        tolerance,
                                    Log                &log)
    : body(body)
    , file_name(file_name)
    , net_slip(net_slip)
    , tolerance(tolerance)
    , log(log)
  {
    for (const unsigned int i : nodes_along_lips(body.space.lip))
      if (body.space.lip.nodes[i].has_unknown())
        places.push_back(i);
  }



  template <int dim>
  std::vector<typename FrictionTable<dim>::Pair>
  FrictionTable<dim>::look_at(const Sample &sample) const
  {
    constexpr unsigned int n      = 2 * (dim - 1);
    const ContactForces   &forces = sample.state.contact_forces;
    const auto            &nodes  = body.lip.nodes;
    const auto states = body.lip.states(sample.state.displacement, forces);
    std::vector<double> values(n * states.size());
    for (unsigned int k = 0; k < nodes.size(); ++k)
      for (unsigned int c = 0; c < dim - 1; ++c)
        if (const auto unknown = nodes[k].sliding[c];
            unknown != numbers::invalid_dof_index)
          {
            double *const here = &values[n * nodes[k].number];
            here[c]            = sample.state.displacement(unknown);
            if (nodes[k].weight > 0.)
              here[dim - 1 + c] = forces.tangential[c][k] / nodes[k].weight;
          }
    Utilities::MPI::sum(values, body.space.communicator(), values);
    std::vector<Pair> pairs;
    for (const unsigned int i : places)
      {
        Pair &pair    = pairs.emplace_back();
        pair.pressure = states[i].pressure;
        pair.closed   = states[i].is_closed ? 1. : 0.;
        for (unsigned int c = 0; c < dim - 1; ++c)
          {
            pair.jump[c]     = values[n * i + c];
            pair.traction[c] = values[n * i + dim - 1 + c];
          }
      }
    return pairs;
  }



  template <int dim>
  void
  FrictionTable<dim>::observe(const Sample &sample)
  {
    // A period begins where the one before ended.
    if (sample.step == 0)
      period.clear();
    period.push_back({sample.instant, look_at(sample)});
    constexpr double rounding = 1e-9;
    largest = std::max(largest, sample.state.displacement.linfty_norm());
    least   = rounding * largest;
  }



  template <int dim>
  void
  FrictionTable<dim>::serialize(StateArchive &archive)
  {
    archive.section("friction");
    archive.common(largest);
    std::size_t n_moments = period.size();
    archive.common(n_moments);
    period.resize(n_moments);
    for (Moment &moment : period)
      {
        archive.common(moment.instant);
        archive.common_list(moment.pairs);
      }
  }



  template <int dim>
  Tensor<1, dim - 1>
  FrictionTable<dim>::slip(const std::size_t pair,
                           const Moment     &from,
                           const Moment     &to) const
  {
    Tensor<1, dim - 1> slip;
    for (unsigned int c = 0; c < dim - 1; ++c)
      slip[c] = to.pairs[pair].jump[c] - from.pairs[pair].jump[c];
    return slip;
  }



  template <int dim>
  double
  FrictionTable<dim>::closed_part(const std::size_t moment,
                                  const std::size_t pair) const
  {
    const Pair &begin = period[moment - 1].pairs[pair];
    const Pair &end   = period[moment].pairs[pair];
    if (begin.closed == 0. || end.closed == 1.)
      return begin.closed;
    constexpr double unknown = 0.5;
    if (moment == 1 || period[moment - 2].pairs[pair].closed == 0.)
      return unknown;
    const double fall =
                   period[moment - 2].pairs[pair].pressure - begin.pressure,
                 before =
                   period[moment - 1].instant - period[moment - 2].instant,
                 step = period[moment].instant - period[moment - 1].instant;
    return fall > 0. ? std::min(1., begin.pressure * before / (fall * step))
                     : unknown;
  }



  template <int dim>
  double
  FrictionTable<dim>::state(const std::size_t moment,
                            const std::size_t pair) const
  {
    if (period[moment].pairs[pair].closed == 0.)
      return 0.;
    if (moment > 0 && period[moment - 1].pairs[pair].closed == 0.)
      return 1.; // it moved while it was open
    // The first sample shows the slip towards the next one.
    const std::size_t begin = moment == 0 ? 0 : moment - 1;
    if (begin + 1 == period.size())
      return 1.;
    const auto last = slip(pair, period[begin], period[begin + 1]);
    if (last.norm() <= least)
      return 1.;
    return dim == 2 && last[0] < 0. ? -2. : 2.;
  }



  template <int dim>
  void
  FrictionTable<dim>::write() const
  {
    std::vector<std::string> header = {"t", "lip", "x", "y"};
    if (dim == 3)
      header.push_back("z");
    header.insert(header.end(),
                  {"state", "slip", "tangential_traction", "normal_pressure"});
    CsvTable table(file_name, header);
    for (std::size_t m = 0; m < period.size(); ++m)
      for (std::size_t p = 0; p < places.size(); ++p)
        {
          const auto         &node = body.space.lip.nodes[places[p]];
          const Pair         &pair = period[m].pairs[p];
          std::vector<double> row  = {period[m].instant, 1. + node.lip};
          row.insert(row.end(), node.point.begin_raw(), node.point.end_raw());
          row.insert(row.end(),
                     {state(m, p),
                      shown(pair.jump),
                      shown(pair.traction),
                      pair.pressure});
          table.add_row(row);
        }
  }



  template <int dim>
  typename FrictionTable<dim>::Totals
  FrictionTable<dim>::totals() const
  {
    Totals all;
    for (std::size_t p = 0; p < places.size(); ++p)
      {
        double path    = 0.;
        bool   touches = false;
        for (std::size_t m = 1; m < period.size(); ++m)
          {
            const Pair  &begin = period[m - 1].pairs[p];
            const Pair  &end   = period[m].pairs[p];
            const double part  = closed_part(m, p);
            const auto   step  = part * slip(p, period[m - 1], period[m]);
            touches            = touches || begin.closed + end.closed > 0.;
            path += step.norm();
            // The mean of both ends is of second order in the step.
            for (unsigned int c = 0; c < dim - 1; ++c)
              all.work -= 0.5 * (begin.traction[c] + end.traction[c]) *
                          step[c] * body.space.lip.nodes[places[p]].weight;
          }
        all.closes = all.closes || touches;
        if (path > all.longest)
          {
            all.longest    = path;
            all.of_longest = p;
          }
        const double net = slip(p, period.front(), period.back()).norm();
        if (touches && net > all.net)
          {
            all.net    = net;
            all.of_net = p;
          }
      }
    return all;
  }



  template <int dim>
  void
  FrictionTable<dim>::summarise(Summary &summary)
  {
    write();
    const Totals all    = totals();
    const double error  = net_slip.error(); // nan if it is unknown
    const double noise  = 3. * std::fmin(tolerance, error) * net_slip.scale();
    const bool   slides = all.longest > least;
    const bool   ratchets =
      slides && all.net > noise && all.net > 1e-3 * all.longest;
    const std::string kind         = !all.closes ? "open"
                                     : !slides   ? "shakedown"
                                     : ratchets  ? "ratchetting"
                                                 : "alternating slip";
    Summary          &friction     = summary["friction"];
    friction["dissipation"]        = all.work;
    friction["largest_slip_range"] = all.longest;
    friction["net_slip"]           = all.net;
    friction["kind"]               = kind;
    if (places.empty())
      return;
    Text::Message message;
    message << "  friction: " << kind;
    const auto at = [&](const std::size_t pair) {
      return ", at " +
             Text::from_point(body.space.lip.nodes[places[pair]].point);
    };
    if (!all.closes)
      message << ", no lips touch in the period";
    else if (!slides)
      message << ", closed lips stick throughout the period";
    else
      message << ", lips slide by up to " << Text::from_number(all.longest, 3)
              << " per period while closed" << at(all.of_longest)
              << ", and friction dissipates " << Text::from_number(all.work, 3)
              << " per period";
    if (ratchets)
      message << "; each period leaves a slip of up to "
              << Text::from_number(all.net, 3) << at(all.of_net);
    log.line(message);
  }



  template class FrictionTable<2>;
  template class FrictionTable<3>;
} // namespace Crevasse
