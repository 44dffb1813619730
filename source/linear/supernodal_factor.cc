// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/linear/supernodal_factor.h>

#include <algorithm>
#include <cholmod.h>

// Compiles functions for processors with AVX2 and for all others; the loader
// selects one.
#if defined(__x86_64__) && !defined(__clang__) && __GNUC__ >= 12
#  define CREVASSE_FOR_EACH_PROCESSOR \
    __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#  define CREVASSE_FOR_EACH_PROCESSOR
#endif

namespace Crevasse
{
  SupernodalFactor::SupernodalFactor(const cholmod_factor_struct &factor)
    : n_supernodes(factor.nsuper)
    , columns(static_cast<const int *>(factor.super))
    , row_starts(static_cast<const int *>(factor.pi))
    , value_starts(static_cast<const int *>(factor.px))
    , rows(static_cast<const int *>(factor.s))
    , values(static_cast<const double *>(factor.x))
  {
    int most_rows = 0;
    for (int s = 0; s < n_supernodes; ++s)
      most_rows = std::max(most_rows, row_starts[s + 1] - row_starts[s]);
    work.resize(most_rows);
  }



  SupernodalFactor::Block
  SupernodalFactor::block(const int supernode, const int end) const
  {
    Block result;
    result.first     = columns[supernode];
    result.n_columns = std::min(columns[supernode + 1], end) - result.first;
    result.n_rows    = row_starts[supernode + 1] - row_starts[supernode];
    result.values    = values + value_starts[supernode];
    result.below     = rows + row_starts[supernode] + result.n_columns;
    result.n_below   = result.n_rows - result.n_columns;
    return result;
  }



  CREVASSE_FOR_EACH_PROCESSOR
  void
  SupernodalFactor::forward(double *x, const int end)
  {
    double *const product = work.data();
    for (int s = 0; s < n_supernodes && columns[s] < end; ++s)
      {
        const Block   b = block(s, end);
        double *const y = x + b.first;
        for (int j = 0; j < b.n_columns; ++j)
          {
            const double *const column = b.values + std::size_t(j) * b.n_rows;
            const double        y_j    = y[j] /= column[j];
            for (int i = j + 1; i < b.n_columns; ++i)
              y[i] -= y_j * column[i];
          }

        // Four columns at once: the product is read and written less often.
        std::fill_n(product, b.n_below, 0.);
        const double *c = b.values + b.n_columns;
        int           j = 0;
        for (; j + 3 < b.n_columns; j += 4, c += 4 * std::size_t(b.n_rows))
          {
            const double *const c_1 = c + b.n_rows, *const c_2 = c_1 + b.n_rows,
                                *const c_3 = c_2 + b.n_rows;
            const double y_0 = y[j], y_1 = y[j + 1], y_2 = y[j + 2],
                         y_3 = y[j + 3];
#pragma omp simd
            for (int i = 0; i < b.n_below; ++i)
              product[i] +=
                y_0 * c[i] + y_1 * c_1[i] + y_2 * c_2[i] + y_3 * c_3[i];
          }
        for (; j < b.n_columns; ++j, c += b.n_rows)
          {
            const double y_j = y[j];
#pragma omp simd
            for (int i = 0; i < b.n_below; ++i)
              product[i] += y_j * c[i];
          }
        for (int i = 0; i < b.n_below; ++i)
          x[b.below[i]] -= product[i];
      }
  }



  CREVASSE_FOR_EACH_PROCESSOR
  void
  SupernodalFactor::backward(double *x, const int end)
  {
    double *const known = work.data();
    for (int s = n_supernodes; s-- > 0;)
      {
        if (columns[s] >= end)
          continue;
        const Block   b = block(s, end);
        double *const y = x + b.first;
        for (int i = 0; i < b.n_below; ++i)
          known[i] = x[b.below[i]];

        const double *c = b.values + b.n_columns;
        int           j = 0;
        for (; j + 3 < b.n_columns; j += 4, c += 4 * std::size_t(b.n_rows))
          {
            const double *const c_1 = c + b.n_rows, *const c_2 = c_1 + b.n_rows,
                                *const c_3 = c_2 + b.n_rows;
            double sum_0 = 0., sum_1 = 0., sum_2 = 0., sum_3 = 0.;
#pragma omp simd reduction(+ : sum_0, sum_1, sum_2, sum_3)
            for (int i = 0; i < b.n_below; ++i)
              {
                sum_0 += c[i] * known[i];
                sum_1 += c_1[i] * known[i];
                sum_2 += c_2[i] * known[i];
                sum_3 += c_3[i] * known[i];
              }
            y[j] -= sum_0;
            y[j + 1] -= sum_1;
            y[j + 2] -= sum_2;
            y[j + 3] -= sum_3;
          }
        for (; j < b.n_columns; ++j, c += b.n_rows)
          {
            double sum = 0.;
#pragma omp simd reduction(+ : sum)
            for (int i = 0; i < b.n_below; ++i)
              sum += c[i] * known[i];
            y[j] -= sum;
          }

        for (j = b.n_columns; j-- > 0;)
          {
            const double *const column = b.values + std::size_t(j) * b.n_rows;
            double              sum    = y[j];
            for (int i = j + 1; i < b.n_columns; ++i)
              sum -= column[i] * y[i];
            y[j] = sum / column[j];
          }
      }
  }



  dealii::FullMatrix<double>
  SupernodalFactor::last_block(const int begin) const
  {
    const int                  n = columns[n_supernodes];
    dealii::FullMatrix<double> triangle(n - begin, n - begin);
    for (int s = 0; s < n_supernodes; ++s)
      for (int j = std::max(columns[s], begin); j < columns[s + 1]; ++j)
        {
          const Block         b      = block(s, n);
          const int           k      = j - b.first;
          const double *const column = b.values + std::size_t(k) * b.n_rows;
          const int *const    row    = rows + row_starts[s];
          for (int i = k; i < b.n_rows; ++i)
            triangle(row[i] - begin, j - begin) = column[i];
        }
    return triangle;
  }
} // namespace Crevasse
