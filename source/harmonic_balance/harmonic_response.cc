// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/harmonic_balance/harmonic_response.h>

#include <algorithm>
#include <utility>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Of a residual, relative to its right-hand side. */
    constexpr double linear_accuracy = 1e-12;
  } // namespace



  ScaledResponse::ScaledResponse(
    LinearSolver                 &linear_solver,
    std::shared_ptr<const Matrix> elastic_compliance,
    const std::complex<double>    factor)
    : linear_solver(linear_solver)
    , elastic_compliance(std::move(elastic_compliance))
    , inverse_factor(1. / factor)
  {
  }



  PeriodicContactProblem::Compliance
  ScaledResponse::compliance() const
  {
    return {elastic_compliance, inverse_factor};
  }



  void
  ScaledResponse::solve(Vector &real, Vector &imaginary)
  {
    const double norm = std::max(real.l2_norm(), imaginary.l2_norm());
    if (norm == 0.)
      return;
    std::vector<Vector> both;
    both.push_back(std::move(real));
    both.push_back(std::move(imaginary));
    linear_solver.solve(both, linear_accuracy * norm);
    real      = both[0];
    imaginary = both[1];
    real *= inverse_factor.real();
    real.add(-inverse_factor.imag(), both[1]);
    imaginary *= inverse_factor.real();
    imaginary.add(inverse_factor.imag(), both[0]);
  }



  std::size_t
  ScaledResponse::memory_consumption() const
  {
    return sizeof(*this);
  }



  FactorisedResponse::FactorisedResponse(
    const Matrix                                 &real,
    const Matrix                                 &imaginary,
    const LipPart                                &lip,
    std::shared_ptr<const ComplexMumps::Ordering> ordering)
    : factor(real, imaginary, lip.dofs(), std::move(ordering))
    , signs(lip.signs())
  {
  }



  PeriodicContactProblem::Compliance
  FactorisedResponse::compliance() const
  {
    auto matrix =
      std::make_shared<FullMatrix<std::complex<double>>>(factor.compliance());
    for (unsigned int i = 0; i < signs.size(); ++i)
      for (unsigned int j = 0; j < signs.size(); ++j)
        (*matrix)(i, j) *= signs[i] * signs[j];
    return {matrix, 1.};
  }



  void
  FactorisedResponse::solve(Vector &real, Vector &imaginary)
  {
    factor.solve(real, imaginary);
  }



  std::size_t
  FactorisedResponse::memory_consumption() const
  {
    return factor.memory_consumption();
  }



  std::shared_ptr<const ComplexMumps::Ordering>
  FactorisedResponse::ordering() const
  {
    return factor.ordering();
  }
} // namespace Crevasse
