// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/model/kept_tangents.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  template <int dim>
  KeptTangents<dim>::KeptTangents(const Body<dim> &body,
                                  const double     period,
                                  InstantMemory   &memory,
                                  const Makers    &makers)
    : body(body)
    , period(period)
    , memory(memory)
    , makers(makers)
  {
    memory.count([this]() {
      std::size_t bytes = 0;
      for (const auto &[t, kept] : tangents)
        bytes += kept.system->memory_consumption();
      return bytes;
    });
  }



  template <int dim>
  typename KeptTangents<dim>::Tangents::const_iterator
  KeptTangents<dim>::nearest_entry(const double t) const
  {
    const auto distance = [&](const auto &entry) {
      const double direct = std::abs(entry.first - t);
      return std::min(direct, period - direct);
    };
    return std::min_element(tangents.begin(),
                            tangents.end(),
                            [&](const auto &a, const auto &b) {
                              return distance(a) < distance(b);
                            });
  }



  template <int dim>
  const typename KeptTangents<dim>::Kept *
  KeptTangents<dim>::nearest(const double t) const
  {
    return tangents.empty() ? nullptr : &nearest_entry(t)->second;
  }



  template <int dim>
  const typename KeptTangents<dim>::Kept &
  KeptTangents<dim>::renew(const double  t,
                           const double  c,
                           const Vector &stress,
                           const Vector &known)
  {
    using Field                            = QuadratureField<dim>;
    const MaterialState<dim>     &material = makers.material(t);
    std::vector<VoigtMatrix<dim>> moduli(body.points.n_local_points);
    for (std::size_t point = 0; point < moduli.size(); ++point)
      moduli[point] = (*material.creep)[point].relaxed_stiffness(
        Field::get(stress, point * Field::n_components),
        Field::get(known, point * Field::n_components),
        material.stiffness_factor,
        std::log(material.kappa(c)));

    const auto drop = [this](const auto entry) {
      if (entry == tangents.end())
        return;
      of_the_past.add(entry->second.system->statistics());
      tangents.erase(entry);
    };
    drop(tangents.find(t));
    Kept made{c, stress, known, Moduli(std::move(moduli)), {}};
    made.system = makers.system(made.moduli);
    if (!tangents.empty() &&
        (tangents.size() == most ||
         !memory.grants(made.system->memory_consumption())))
      drop(nearest_entry(t));
    // Moving keeps the addresses of what the system refers to.
    return tangents.emplace(t, std::move(made)).first->second;
  }



  template <int dim>
  SolverStatistics
  KeptTangents<dim>::statistics() const
  {
    SolverStatistics all = of_the_past;
    for (const auto &[t, kept] : tangents)
      all.add(kept.system->statistics());
    return all;
  }



  template <int dim>
  void
  KeptTangents<dim>::serialize(StateArchive &archive)
  {
    std::vector<double> instants;
    if (!archive.is_loading())
      for (const auto &[t, kept] : tangents)
        instants.push_back(t);
    archive.common_list(instants);
    for (const double t : instants)
      {
        double c = 0.;
        Vector stress, known;
        body.points.initialize(stress);
        body.points.initialize(known);
        if (!archive.is_loading())
          {
            c      = tangents.at(t).c;
            stress = tangents.at(t).stress;
            known  = tangents.at(t).known;
          }
        archive.common(c);
        archive.at_points(stress);
        archive.at_points(known);
        if (archive.is_loading())
          renew(t, c, stress, known);
        tangents.at(t).system->contact_solver().serialize(archive);
      }
  }



  template class KeptTangents<2>;
  template class KeptTangents<3>;
} // namespace Crevasse
