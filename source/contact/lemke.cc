// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/contact/lemke.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Direction d of the artificial variable: without ratios that are equal,
     * so that ties do not occur. */
    double
    covering(const unsigned int i)
    {
      const double golden = 0.6180339887498949 * (i + 1);
      return 1. + 0.1 * (golden - std::floor(golden));
    }



    /** The tableau of w − M z − d z_0 = r: columns w, z, z_0 and r. */
    class Tableau
    {
    public:
      Tableau(const FullMatrix<double> &M, const dealii::Vector<double> &r)
        : n(r.size())
        , basis(n)
        , rows(n, 2 * n + 2)
      {
        std::iota(basis.begin(), basis.end(), 0);
        for (unsigned int i = 0; i < n; ++i)
          {
            rows(i, i) = 1.;
            for (unsigned int j = 0; j < n; ++j)
              rows(i, n + j) = -M(i, j);
            rows(i, 2 * n)     = -covering(i);
            rows(i, 2 * n + 1) = r(i);
          }
      }

      /** Lets a variable enter in a row. @return the one that leaves. */
      unsigned int
      pivot(const unsigned int row, const unsigned int entering)
      {
        const double       divisor = rows(row, entering);
        const unsigned int end     = 2 * n + 2;
        for (unsigned int j = 0; j < end; ++j)
          rows(row, j) /= divisor;
        for (unsigned int i = 0; i < n; ++i)
          if (const double factor = rows(i, entering); i != row && factor != 0.)
            for (unsigned int j = 0; j < end; ++j)
              rows(i, j) -= factor * rows(row, j);
        return std::exchange(basis[row], entering);
      }

      /** Row of the variable that first vanishes as another one grows, the
       * artificial one if it is among these, or else that with the largest
       * pivot; n if none does: a ray. */
      unsigned int
      row_that_leaves(const unsigned int entering) const
      {
        constexpr double smallest = 1e-11, tie = 1e-10, zero = 1e-14;
        double           least = std::numeric_limits<double>::infinity();
        const auto       ratio = [&](const unsigned int i) {
          return std::max(rows(i, 2 * n + 1), 0.) / rows(i, entering);
        };
        for (unsigned int i = 0; i < n; ++i)
          if (rows(i, entering) > smallest)
            least = std::min(least, ratio(i));
        unsigned int best = n;
        for (unsigned int i = 0; i < n; ++i)
          if (rows(i, entering) > smallest &&
              ratio(i) <= least * (1. + tie) + zero)
            {
              if (basis[i] == 2 * n)
                return i;
              if (best == n || rows(i, entering) > rows(best, entering))
                best = i;
            }
        return best;
      }

      dealii::Vector<double>
      solution() const
      {
        dealii::Vector<double> z(n);
        for (unsigned int i = 0; i < n; ++i)
          if (basis[i] >= n && basis[i] < 2 * n)
            z(basis[i] - n) = rows(i, 2 * n + 1);
        return z;
      }

      const unsigned int n;

    private:
      std::vector<unsigned int> basis; ///< variable of each row
      FullMatrix<double>        rows;
    };
  } // namespace



  std::optional<dealii::Vector<double>>
  lemke(const FullMatrix<double> &M, const dealii::Vector<double> &r)
  {
    const unsigned int n   = r.size();
    unsigned int       row = 0;
    for (unsigned int i = 1; i < n; ++i)
      if (r(i) / covering(i) < r(row) / covering(row))
        row = i;
    if (r(row) >= 0.)
      return dealii::Vector<double>(n);
    Tableau      tableau(M, r);
    unsigned int entering = 2 * n;
    for (unsigned int k = 0; k < 50 * n && row < n; ++k)
      {
        const unsigned int leaving = tableau.pivot(row, entering);
        if (leaving == 2 * n)
          return tableau.solution();
        entering = leaving < n ? leaving + n : leaving - n;
        row      = tableau.row_that_leaves(entering);
      }
    return {};
  }
} // namespace Crevasse
