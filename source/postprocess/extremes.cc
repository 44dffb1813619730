// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/postprocess/extremes.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  Extremes<dim>::Extremes(const Body<dim> &body,
                          const bool       of_last_period,
                          const RunState  &before,
                          Log             &log)
    : body(body)
    , of_last_period(of_last_period)
    , log(log)
    , stress(before.largest_stress)
    , displacement(before.largest_displacement)
  {
  }



  template <int dim>
  void
  Extremes<dim>::observe(const Sample &sample)
  {
    if (of_last_period && sample.step == 0)
      displacement = viscous_strain = 0.;
    displacement =
      std::max(displacement, sample.state.displacement.linfty_norm());
    if (sample.viscous_strain.size() > 0)
      viscous_strain =
        std::max(viscous_strain, sample.viscous_strain.linfty_norm());
  }



  template <int dim>
  void
  Extremes<dim>::end_of_period(const PeriodReport &report)
  {
    stress = of_last_period ? report.largest_stress
                            : std::max(stress, report.largest_stress);
  }



  template <int dim>
  void
  Extremes<dim>::serialize(StateArchive &archive)
  {
    archive.common(stress);
    archive.common(displacement);
    archive.common(viscous_strain);
  }



  template <int dim>
  double
  Extremes<dim>::stress_rounding() const
  {
    if (stress == 0.)
      return 0.;
    double     stiffness = 0.;
    const auto material  = body.material.at(0.);
    for (const VoigtMatrix<dim> &K : material.stiffness->distinct())
      stiffness = std::max(stiffness, K.norm());
    stiffness = Utilities::MPI::max(stiffness, body.space.communicator());
    return std::numeric_limits<double>::epsilon() * stiffness * viscous_strain /
           stress;
  }



  template <int dim>
  void
  Extremes<dim>::warn_of_large_displacements() const
  {
    constexpr double       small = 0.1;
    const BoundingBox<dim> box(body.space.mesh().get_vertices());
    const auto            &corners  = box.get_boundary_points();
    const double           diagonal = corners.first.distance(corners.second);
    if (displacement <= small * diagonal)
      return;
    std::ostringstream text;
    text << "  Beware: displacements reach " << displacement
         << ", and the body is " << diagonal
         << " from corner to corner: the theory is one of small strains. Have "
            "loads, lengths and moduli one system of units, and may the body "
            "flow for so long?";
    log.line(text.str());
  }



  template <int dim>
  void
  Extremes<dim>::summarise(Summary &summary)
  {
    summary["extremes"]["stress"] = stress;
    // With singular functions some unknowns are no displacements.
    if (body.space.singular_shapes() == nullptr)
      {
        summary["extremes"]["displacement"] = displacement;
        warn_of_large_displacements();
      }
    if (body.effects.viscosity.on)
      summary["certificate"]["stress_rounding"] = stress_rounding();
  }



  template class Extremes<2>;
  template class Extremes<3>;
} // namespace Crevasse
