// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/contact/signorini_problem.h>
#include <crevasse/linear/matrix_operator.h>

namespace Crevasse
{
  using namespace dealii;

  SignoriniProblem::SignoriniProblem(const LinearOperator   &stiffness,
                                     const UnilateralBounds &bounds)
    : stiffness(stiffness)
    , bounds(bounds)
    , all_dofs(of_all_ranks(stiffness.get_mpi_communicator(), bounds.dofs))
  {
    for (const auto &along : bounds.tangents)
      tangents.push_back(of_all_ranks(stiffness.get_mpi_communicator(), along));
    for (const auto i : diagonal().locally_owned_elements())
      if (!(diagonal()(i) > 0.))
        throw NumericalError(
          "Diagonal entry " + std::to_string(i) + " of the stiffness is " +
          std::to_string(diagonal()(i)) +
          ", so that the stiffness is not positive definite. Check the "
          "moduli of [Material] and the mesh for inverted cells.");
  }



  SignoriniProblem::SignoriniProblem(std::shared_ptr<const LinearOperator> own,
                                     const UnilateralBounds &bounds)
    : SignoriniProblem(*own, bounds)
  {
    of_matrix = std::move(own);
  }



  SignoriniProblem::SignoriniProblem(const SparseMatrix     &matrix,
                                     const UnilateralBounds &bounds)
    : SignoriniProblem(std::make_shared<MatrixOperator>(matrix), bounds)
  {
  }



  dealii::Vector<double>
  SignoriniProblem::of_all(const std::vector<double> &local) const
  {
    const std::vector<double> all =
      of_all_ranks(stiffness.get_mpi_communicator(), local);
    return dealii::Vector<double>(all.begin(), all.end());
  }



  LinearOperator::Indices
  SignoriniProblem::all_lip_dofs() const
  {
    LinearOperator::Indices all = all_dofs;
    for (const auto &along : tangents)
      for (const auto dof : along)
        if (dof != numbers::invalid_dof_index)
          all.push_back(dof);
    return all;
  }



  std::vector<double>
  SignoriniProblem::springs() const
  {
    // Weak enough for few solutions, far above rounding.
    constexpr double    weak = 1e-8;
    std::vector<double> all;
    for (const auto dof : bounds.dofs)
      all.push_back(weak * diagonal()(dof));
    return all;
  }
} // namespace Crevasse
