// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/harmonic_balance/harmonic_responses.h>

#include <deal.II/base/mpi.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  HarmonicResponses<dim>::HarmonicResponses(const Space<dim>           &space,
                                            const QuadratureField<dim> &points,
                                            const MaterialState<dim> &material,
                                            LinearSolver  &linear_solver,
                                            const LipPart &lip,
                                            const double   memory)
    : space(space)
    , points(points)
    , material(material)
    , linear_solver(linear_solver)
    , lip(lip)
    , memory(memory)
  {
  }



  template <int dim>
  std::shared_ptr<HarmonicResponse>
  HarmonicResponses<dim>::at(const unsigned int        n,
                             const ComplexModuli<dim> &moduli)
  {
    if (const auto found = kept.find(n); found != kept.end())
      return found->second;
    std::shared_ptr<HarmonicResponse> response;
    if (const auto factor = common_factor<dim>(moduli,
                                               *material.stiffness,
                                               points.n_local_points(),
                                               space.communicator()))
      response = std::make_shared<ScaledResponse>(linear_solver,
                                                  elastic_compliance(),
                                                  *factor);
    else
      response = factorised(moduli);
    const double needed =
      Utilities::MPI::sum(double(response->memory_consumption()),
                          space.communicator());
    // Those that were made first are kept: the second time they are asked for
    // in the same order, and dropping the oldest would always drop the next.
    is_full = is_full || used_memory + needed > memory;
    if (!is_full)
      {
        used_memory += needed;
        kept[n] = response;
      }
    return response;
  }



  template <int dim>
  std::shared_ptr<const ScaledResponse::Matrix>
  HarmonicResponses<dim>::elastic_compliance()
  {
    if (compliance != nullptr)
      return compliance;
    auto matrix = std::make_shared<ScaledResponse::Matrix>();
    if (lip.n_nodes() > 0)
      {
        const Vector model = space.ghosted_vector();
        *matrix            = lip.compliance(linear_solver, model);
      }
    compliance = matrix;
    return compliance;
  }



  template <int dim>
  std::shared_ptr<HarmonicResponse>
  HarmonicResponses<dim>::factorised(const ComplexModuli<dim> &moduli)
  {
    const std::size_t n_points = points.n_local_points();
    assemble_stiffness(space,
                       points,
                       real_parts<dim>(moduli.sum, n_points),
                       real);
    if (imaginary.m() == 0)
      imaginary.reinit(real);
    assemble_stiffness(space,
                       points,
                       imaginary_parts<dim>(moduli.sum, n_points),
                       imaginary);
    auto response =
      std::make_shared<FactorisedResponse>(real, imaginary, lip, ordering);
    ordering = response->ordering();
    ++factorisations;
    return response;
  }



  template class HarmonicResponses<2>;
  template class HarmonicResponses<3>;
} // namespace Crevasse
