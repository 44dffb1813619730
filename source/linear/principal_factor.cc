// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/linear/principal_factor.h>

#include <Teuchos_BLAS.hpp>
#include <Teuchos_LAPACK.hpp>
#include <algorithm>

namespace Crevasse
{
  void
  PrincipalFactor::choose(const std::vector<bool> &set)
  {
    unsigned int n_known = 0;
    while (n_known < order.size() && set[order[n_known]])
      ++n_known;
    std::vector<bool>         is_new = set;
    std::vector<unsigned int> all(order.begin(), order.begin() + n_known);
    for (unsigned int k = order.size(); k-- > n_known;)
      if (set[order[k]])
        all.push_back(order[k]);
    for (const unsigned int i : all)
      is_new[i] = false;
    for (unsigned int i = 0; i < is_new.size(); ++i)
      if (is_new[i])
        all.push_back(i);
    order = std::move(all);
    if (n_known < order.size())
      extend(n_known);
  }



  void
  PrincipalFactor::serialize(StateArchive &archive)
  {
    const std::size_t         n           = matrix.m();
    std::vector<unsigned int> other_order = order;
    std::vector<double>       triangle; // upper triangle of R, by columns
    for (std::size_t k = 0; k < order.size(); ++k)
      triangle.insert(triangle.end(), &values[n * k], &values[n * k + k] + 1);
    archive.common_list(other_order);
    archive.common_list(triangle);
    if (archive.is_loading() && archive.has_same_ranks() && n > 0)
      {
        order = std::move(other_order);
        values.resize(n * n);
        for (std::size_t k = 0; k < order.size(); ++k)
          std::copy_n(&triangle[k * (k + 1) / 2], k + 1, &values[n * k]);
      }
  }



  void
  PrincipalFactor::extend(const unsigned int n_known)
  {
    const int n = matrix.m(), k = n_known, m = order.size() - n_known;
    values.resize(std::size_t(n) * n);
    double *const R_12 = values.data() + std::size_t(n) * k, *R_22 = R_12 + k;
    for (int j = 0; j < m; ++j)
      for (int i = 0; i <= k + j; ++i)
        R_12[std::size_t(n) * j + i] = matrix(order[i], order[k + j]);

    // R₁₁ᵀ R₁₂ = A₁₂, R₂₂ᵀ R₂₂ = A₂₂ − R₁₂ᵀ R₁₂.
    const Teuchos::BLAS<int, double> blas;
    blas.TRSM(Teuchos::LEFT_SIDE,
              Teuchos::UPPER_TRI,
              Teuchos::TRANS,
              Teuchos::NON_UNIT_DIAG,
              k,
              m,
              1.,
              values.data(),
              n,
              R_12,
              n);
    blas.SYRK(
      Teuchos::UPPER_TRI, Teuchos::TRANS, m, k, -1., R_12, n, 1., R_22, n);
    int info = 0;
    Teuchos::LAPACK<int, double>().POTRF('U', m, R_22, n, &info);
    if (info != 0)
      {
        order.clear();
        throw NumericalError(
          "The stiffness of the crack lip is not positive definite for " +
          std::to_string(k + m) +
          " open nodes: it is too ill-conditioned for a direct solver. Check "
          "the moduli of [Material] for extreme contrasts and the mesh for "
          "degenerate cells.");
      }
  }



  void
  PrincipalFactor::solve(dealii::Vector<double> &x)
  {
    on_set.clear();
    for (const unsigned int i : order)
      on_set.push_back(x(i));
    x        = 0.;
    int info = 0;
    if (!order.empty())
      Teuchos::LAPACK<int, double>().POTRS('U',
                                           order.size(),
                                           1,
                                           values.data(),
                                           matrix.m(),
                                           on_set.data(),
                                           order.size(),
                                           &info);
    for (unsigned int k = 0; k < order.size(); ++k)
      x(order[k]) = on_set[k];
  }
} // namespace Crevasse
