// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_harmonic_response_h
#define crevasse_harmonic_balance_harmonic_response_h

#include <crevasse/harmonic_balance/complex_mumps.h>
#include <crevasse/harmonic_balance/lip_part.h>
#include <crevasse/harmonic_balance/periodic_contact_problem.h>
#include <crevasse/linear/linear_solver.h>

#include <complex>
#include <cstddef>
#include <memory>

namespace Crevasse
{
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  /** How a body answers to nodal loads that oscillate at one frequency: the
   * solutions of A* q = b, with the complex stiffness A* = ∫ DᵀK*D. */
  class HarmonicResponse
  {
  public:
    virtual ~HarmonicResponse() = default;

    /** S = L A*⁻¹ Lᵀ on a part of the lip, the same on all ranks. */
    virtual PeriodicContactProblem::Compliance
    compliance() const = 0;

    /** Overwrites the parts of b by those of q. Collective. */
    virtual void
    solve(Vector &real, Vector &imaginary) = 0;

    /** Bytes on this rank that are not shared with others. */
    virtual std::size_t
    memory_consumption() const = 0;
  };



  /** Where A* is the elastic stiffness A times one complex number: it takes
   * back-solves with A alone. */
  class ScaledResponse : public HarmonicResponse
  {
  public:
    using Matrix = dealii::FullMatrix<std::complex<double>>;

    /** @param linear_solver of A; it must outlive this object.
     * @param elastic_compliance L A⁻¹ Lᵀ. */
    ScaledResponse(LinearSolver                 &linear_solver,
                   std::shared_ptr<const Matrix> elastic_compliance,
                   const std::complex<double>    factor);

    PeriodicContactProblem::Compliance
    compliance() const override;

    void
    solve(Vector &real, Vector &imaginary) override;

    std::size_t
    memory_consumption() const override;

  private:
    LinearSolver                       &linear_solver;
    const std::shared_ptr<const Matrix> elastic_compliance;
    const std::complex<double>          inverse_factor;
  };



  /** Where A* has a factor of its own. */
  class FactorisedResponse : public HarmonicResponse
  {
  public:
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;

    /** Factorises. Collective.
     *
     * @param real @p imaginary the parts of A*, with the same pattern.
     * @param lip the part of the lip on which the compliance is asked for.
     * @param ordering see ComplexMumps.
     * @throw NumericalError if MUMPS fails. */
    FactorisedResponse(const Matrix                                 &real,
                       const Matrix                                 &imaginary,
                       const LipPart                                &lip,
                       std::shared_ptr<const ComplexMumps::Ordering> ordering);

    PeriodicContactProblem::Compliance
    compliance() const override;

    void
    solve(Vector &real, Vector &imaginary) override;

    std::size_t
    memory_consumption() const override;

    std::shared_ptr<const ComplexMumps::Ordering>
    ordering() const;

  private:
    const ComplexMumps        factor;
    const std::vector<double> signs; ///< of the nodes of the lip
  };
} // namespace Crevasse

#endif
