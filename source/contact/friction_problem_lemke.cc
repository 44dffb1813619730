// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Lemke's method for FrictionProblem.

#include <crevasse/base/problems.h>
#include <crevasse/contact/friction_problem.h>
#include <crevasse/contact/lemke.h>

#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** The complementarity problem 0 ≤ z ⟂ w = M z + r ≥ 0 with a polygon for
     * Coulomb's limit. Blocks of z: g_N, the parts of g_T along each direction,
     * and the size of the slip; forces times `scale`, the size of a compliance.
     */
    struct PolygonalFriction
    {
      PolygonalFriction(const FrictionProblem        &problem,
                        const dealii::Vector<double> &loads,
                        const unsigned int            n_directions)
        : pairs(problem.pairs)
        , m(pairs.size())
        , K(n_directions)
        , compliance(problem.factor.matrix)
        , M((K + 2) * m)
        , r((K + 2) * m)
      {
        compliance.invert();
        for (unsigned int i = 0; i < loads.size(); ++i)
          scale += compliance(i, i) / loads.size();
        for (unsigned int a = 0; a <= K; ++a)
          for (unsigned int b = 0; b <= K; ++b)
            for (unsigned int i = 0; i < m; ++i)
              for (unsigned int j = 0; j < m; ++j)
                M(a * m + i, b * m + j) = between(i, part(a), j, part(b));
        for (unsigned int i = 0; i < m; ++i)
          {
            M((K + 1) * m + i, i) = problem.increment.coefficients[i];
            for (unsigned int a = 1; a <= K; ++a)
              {
                M(a * m + i, (K + 1) * m + i) = 1.;
                M((K + 1) * m + i, a * m + i) = -1.;
              }
          }
        set_free_jumps(problem.increment, loads);
      }

      /** Components of a block's force along normal and tangents. */
      std::array<double, 3>
      part(const unsigned int block) const
      {
        const double angle = 2. * numbers::PI * (block - 1.) / K;
        return block == 0 ? std::array<double, 3>{{1., 0., 0.}}
                          : std::array<double, 3>{
                              {0., std::cos(angle), std::sin(angle)}};
      }

      /** Component of the slip of a pair, from w, along a tangent. */
      double
      slip(const dealii::Vector<double> &w,
           const unsigned int            i,
           const unsigned int            tangent) const
      {
        const unsigned int a = 1 + tangent * K / 4;
        return !pairs[i].has(tangent)
                 ? 0.
                 : 0.5 * (w(a * m + i) - w((a + K / 2) * m + i));
      }

      const std::vector<FrictionProblem::Pair> &pairs;
      const unsigned int                        m, K;
      LAPACKFullMatrix<double>                  compliance;
      double                                    scale = 0.;
      FullMatrix<double>                        M;
      dealii::Vector<double>                    r;

    private:
      unsigned int
      unknown(const unsigned int i, const unsigned int component) const
      {
        return component == 0 ? pairs[i].normal
                              : pairs[i].tangents[component - 1];
      }

      /** Jump of pair i along a part per force on pair j along another. Missing
       * tangents have a compliance of their own, and are without load. */
      double
      between(const unsigned int           i,
              const std::array<double, 3> &along_i,
              const unsigned int           j,
              const std::array<double, 3> &along_j) const
      {
        double sum = 0.;
        for (unsigned int c = 0; c < 3; ++c)
          for (unsigned int e = 0; e < 3; ++e)
            {
              const unsigned int row = unknown(i, c), column = unknown(j, e);
              const bool         is_missing =
                std::max(row, column) == numbers::invalid_unsigned_int;
              sum += along_i[c] * along_j[e] *
                     (!is_missing        ? compliance(row, column) / scale
                      : i == j && c == e ? 1.
                                         : 0.);
            }
        return sum;
      }

      /** Sets r: jumps without forces of contact, from gap and q_T^ref on. */
      void
      set_free_jumps(const FrictionState          &increment,
                     const dealii::Vector<double> &loads)
      {
        dealii::Vector<double> jumps(loads.size());
        compliance.vmult(jumps, loads);
        for (unsigned int i = 0; i < m; ++i)
          {
            r(i) = jumps(pairs[i].normal) - pairs[i].gap;
            for (unsigned int a = 1; a <= K; ++a)
              for (const unsigned int c : {0, 1})
                if (pairs[i].has(c))
                  r(a * m + i) +=
                    part(a)[1 + c] *
                    (jumps(pairs[i].tangents[c]) - increment.reference[c][i]);
          }
        if (const double size = r.linfty_norm(); size > 0.)
          r /= size;
      }
    };
  } // namespace



  void
  FrictionProblem::solve_by_lemke(const LipVector   &loads,
                                  const unsigned int n_directions)
  {
    ++rescues;
    const PolygonalFriction polygonal(*this, loads, n_directions);
    const auto              z = lemke(polygonal.M, polygonal.r);
    if (!z)
      throw NumericalError(
        "The friction of " + std::to_string(pairs.size()) +
        " pairs of nodes has no solution that could be found: its stiffness is "
        "too ill-conditioned. Check the moduli of [Material] and the mesh.");
    // The variable that is not 0 tells the state.
    LipVector w(z->size());
    polygonal.M.vmult(w, *z);
    w += polygonal.r;
    for (unsigned int i = 0; i < pairs.size(); ++i)
      {
        const Tensor<1, 2> slip(
          {polygonal.slip(w, i, 0), polygonal.slip(w, i, 1)});
        states[i] = {};
        if ((*z)(i) <= 0.)
          states[i].kind = SlipState::open;
        else if ((*z)((n_directions + 1) * pairs.size() + i) > 0. &&
                 slip.norm() > 0.)
          states[i] = {SlipState::slip,
                       slip / slip.norm(),
                       pairs[i].n_tangents() < 2
                         ? 0.
                         : increment.coefficients[i] * (*z)(i) /
                             (polygonal.scale * slip.norm())};
      }
  }
} // namespace Crevasse
