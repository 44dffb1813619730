// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/linear/amg_cg.h>

#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  AmgCg::AmgCg(const Matrix              &matrix,
               const std::vector<Vector> &near_null_space,
               const unsigned int         block_size,
               const bool                 higher_order)
    : matrix(matrix)
  {
    TrilinosWrappers::PreconditionAMG::AdditionalData settings;
    settings.elliptic              = true;
    settings.higher_order_elements = higher_order;

    Teuchos::ParameterList              parameters;
    std::unique_ptr<Epetra_MultiVector> no_modes;
    settings.set_parameters(parameters, no_modes, matrix);

    // deal.II supports piecewise constant modes only, which rotations are not.
    const std::size_t   n = matrix.local_size();
    std::vector<double> modes;
    // Reserve at least one entry: a rank without unknowns needs a pointer, too.
    modes.reserve(std::max<std::size_t>(1, n * near_null_space.size()));
    for (const Vector &mode : near_null_space)
      modes.insert(modes.end(), mode.begin(), mode.end());
    parameters.set("PDE equations", static_cast<int>(block_size));
    parameters.set("null space: type", "pre-computed");
    parameters.set("null space: dimension",
                   static_cast<int>(near_null_space.size()));
    parameters.set("null space: vectors", modes.data());

    multigrid.initialize(matrix, parameters);
  }

} // namespace Crevasse
