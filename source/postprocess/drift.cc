// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/postprocess/drift.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  Drift<dim>::Drift(const StepList                         &steps,
                    const ContactBoundary<dim>             &lip,
                    const std::vector<ProbeEvaluator<dim>> &probes,
                    const ContactTable<dim>                *contact_table)
    : steps(steps)
    , lip(lip)
    , probes(probes)
    , contact_table(contact_table)
  {
  }



  template <int dim>
  void
  Drift<dim>::observe(const Sample &sample)
  {
    if (sample.step == 0)
      start = sample.state.displacement;
    else if (sample.step == steps.n_steps())
      {
        drift = sample.state.displacement;
        drift -= start;
        if (sample.secular_flow != nullptr)
          drift.add(steps.period(), sample.secular_flow->velocity);
      }
  }



  template <int dim>
  void
  Drift<dim>::serialize(StateArchive &archive)
  {
    archive.section("drift");
    archive.nodal(start);
  }



  template <int dim>
  double
  Drift<dim>::largest_closing(const double accuracy) const
  {
    double closing = 0.;
    for (const LipNode<dim> &node : lip.nodes())
      closing = std::max(closing, -node.sign * drift(node.dof));
    closing = Utilities::MPI::max(closing, drift.get_mpi_communicator());
    // Where the lip never opens, solves move its nodes by what they leave.
    constexpr double some = 100.;
    const bool       is_noise =
      closing <= some * accuracy * contact_table->largest_displacement();
    return is_noise ? 0. : closing;
  }



  template <int dim>
  void
  Drift<dim>::summarise(Summary &summary)
  {
    const double period   = steps.period();
    auto        &rates    = summary["drift"];
    rates["largest_rate"] = drift.linfty_norm() / period;
    for (const auto &probe : probes)
      {
        const Tensor<1, dim> rate = probe.displacement(drift) / period;
        for (unsigned int d = 0; d < dim; ++d)
          rates["per_probe"][probe.name()].push_back(rate[d]);
      }
    if (contact_table != nullptr)
      rates["largest_closing_rate"] =
        largest_closing(summary["certificate"]["accuracy"]) / period;
  }



  template class Drift<2>;
  template class Drift<3>;
} // namespace Crevasse
