// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_harmonic_responses_h
#define crevasse_harmonic_balance_harmonic_responses_h

#include <crevasse/discretisation/space.h>
#include <crevasse/discretisation/stiffness.h>
#include <crevasse/harmonic_balance/complex_moduli.h>
#include <crevasse/harmonic_balance/harmonic_response.h>

#include <map>
#include <memory>

namespace Crevasse
{
  /**
   * Makes the responses of a body to the harmonics, each the cheapest there is:
   * back-solves with the elastic stiffness where K* is a multiple of K, a
   * complex factor elsewhere. Factors are kept for the second time that they
   * are asked for, as long as the memory lasts.
   */
  template <int dim>
  class HarmonicResponses
  {
  public:
    /** All arguments must outlive this object.
     *
     * @param linear_solver of the elastic stiffness A, without its factor k.
     * @param lip the nodes whose compliance is asked for.
     * @param memory in bytes, of all ranks. */
    HarmonicResponses(const Space<dim>           &space,
                      const QuadratureField<dim> &points,
                      const MaterialState<dim>   &material,
                      LinearSolver               &linear_solver,
                      const LipPart              &lip,
                      const double                memory);

    /** The response to harmonic @p n with these moduli, all without the factor
     * k. Collective. @throw NumericalError if MUMPS fails. */
    std::shared_ptr<HarmonicResponse>
    at(const unsigned int n, const ComplexModuli<dim> &moduli);

    /** Complex factorisations so far. */
    unsigned int
    n_factorisations() const
    {
      return factorisations;
    }

  private:
    /** L A⁻¹ Lᵀ, computed when it is first asked for. */
    std::shared_ptr<const ScaledResponse::Matrix>
    elastic_compliance();

    std::shared_ptr<HarmonicResponse>
    factorised(const ComplexModuli<dim> &moduli);

    const Space<dim>           &space;
    const QuadratureField<dim> &points;
    const MaterialState<dim>   &material;
    LinearSolver               &linear_solver;
    const LipPart              &lip;
    const double                memory;

    double       used_memory    = 0.;
    bool         is_full        = false;
    unsigned int factorisations = 0;
    SparseMatrix real, imaginary; ///< of the last factor
    std::shared_ptr<const ScaledResponse::Matrix>             compliance;
    std::shared_ptr<const ComplexMumps::Ordering>             ordering;
    std::map<unsigned int, std::shared_ptr<HarmonicResponse>> kept;
  };
} // namespace Crevasse

#endif
