// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_harmonic_responses_h
#define crevasse_harmonic_balance_harmonic_responses_h

#include <crevasse/discretisation/algorithmic_moduli.h>
#include <crevasse/harmonic_balance/lip_part.h>
#include <crevasse/harmonic_balance/periodic_contact.h>
#include <crevasse/model/body.h>


namespace Crevasse
{
  /** The K*ₙ of a harmonic. */
  template <int dim>
  using ComplexModuli = AlgorithmicModuli<dim, std::complex<double>>;

  /** How a body answers to nodal loads that oscillate at one frequency: the
   * solutions of A* q = b, with the complex stiffness A* = ∫ DᵀK*D. */
  struct HarmonicResponse
  {
    /** S = L A*⁻¹ Lᵀ on a part of the lip, the same on all ranks. */
    PeriodicContactProblem::Compliance compliance;

    /** Overwrites the parts of b by those of q. Collective. */
    std::function<void(Vector &real, Vector &imaginary)> solve;

    /** Bytes on this rank that are not shared with others. */
    std::size_t memory_consumption;
  };

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
    HarmonicResponses(const Body<dim>          &body,
                      const MaterialState<dim> &material,
                      LinearSolver             &linear_solver,
                      const LipPart            &lip,
                      const double              memory);

    /** The response to harmonic @p n with these moduli, all without the factor
     * k. Collective. @throw NumericalError if MUMPS fails. */
    HarmonicResponse
    at(const unsigned int n, const ComplexModuli<dim> &moduli);

    /** The response by a factor of its own. Collective. @throw NumericalError
     * if MUMPS fails. */
    HarmonicResponse
    factorised(const ComplexModuli<dim> &moduli);

    unsigned int n_factorisations = 0; ///< complex ones, so far

  private:
    /** The response where A* is A times a number. */
    HarmonicResponse
    scaled(const std::complex<double> factor);

    const Body<dim>          &body;
    const MaterialState<dim> &material;
    LinearSolver             &linear_solver;
    const LipPart            &lip;
    const double              memory;

    double       used_memory = 0.;
    bool         is_full     = false;
    SparseMatrix real, imaginary; ///< of the last factor
    std::shared_ptr<const dealii::FullMatrix<std::complex<double>>>
      elastic_compliance;                              ///< L A⁻¹ Lᵀ
    std::shared_ptr<const std::vector<int>>  ordering; ///< see ComplexMumps
    std::map<unsigned int, HarmonicResponse> kept;
  };
} // namespace Crevasse

#endif
