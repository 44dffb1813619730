// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Friction in space: seeded increments and their followers on an elastic
// half-space, from coefficients 0 to 2, also with the tangents of each pair
// turned; random stiffnesses, on some of which directions recur, so that
// Lemke's method must end them; and problems of the plane, in turned tangents.

#include <crevasse/contact/friction_problem.h>

#include <deal.II/lac/full_matrix.h>

#include <crevasse_tests/friction_violation.h>
#include <crevasse_tests/tests.h>
#include <random>

using namespace Crevasse;

namespace
{
  using Matrix  = dealii::LAPACKFullMatrix<double>;
  using Vector3 = dealii::Vector<double>;
  using Random  = std::mt19937;

  constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;

  double
  gaussian(Random &random)
  {
    return std::normal_distribution<double>()(random);
  }

  /** Openings come first, then jumps along each tangent. */
  FrictionProblem
  problem_of(const Matrix              &A,
             const std::vector<double> &gaps,
             const double               mu,
             const unsigned int         n_tangents)
  {
    const unsigned int                 m = gaps.size();
    std::vector<FrictionProblem::Pair> pairs;
    for (unsigned int i = 0; i < m; ++i)
      pairs.push_back(
        {i, {{m + i, n_tangents > 1 ? 2 * m + i : none}}, gaps[i]});
    FrictionProblem problem(A, pairs);
    problem.increment.coefficients.assign(m, mu);
    problem.increment.reference.assign(n_tangents, std::vector<double>(m));
    return problem;
  }

  void
  commit(FrictionProblem &problem, const Vector3 &jumps)
  {
    const unsigned int m = problem.pairs.size();
    for (const unsigned int c : {0, 1})
      problem.increment.reference[c].assign(jumps.begin() + (1 + c) * m,
                                            jumps.begin() + (2 + c) * m);
  }

  /** The turn of each pair's tangents. */
  struct Turn
  {
    Turn(const unsigned int m, Random &random)
    {
      for (unsigned int i = 0; i < m; ++i)
        angles.push_back(3. * gaussian(random));
    }

    /** Components along turned tangents; by @p sign = −1, those before. */
    Vector3
    of(const Vector3 &v, const double sign = 1.) const
    {
      const unsigned int m      = angles.size();
      Vector3            turned = v;
      for (unsigned int i = 0; i < m; ++i)
        {
          const double c = std::cos(angles[i]), s = sign * std::sin(angles[i]);
          turned(m + i)     = c * v(m + i) + s * v(2 * m + i);
          turned(2 * m + i) = c * v(2 * m + i) - s * v(m + i);
        }
      return turned;
    }

    Matrix
    of(const Matrix &A) const
    {
      const unsigned int n = A.m();
      Matrix             half(n), both(n);
      Vector3            column(n);
      for (const auto &[from, to] :
           {std::make_pair(&A, &half),
            std::make_pair(const_cast<const Matrix *>(&half), &both)})
        for (unsigned int j = 0; j < n; ++j)
          {
            for (unsigned int i = 0; i < n; ++i)
              column(i) = (*from)(j, i);
            const Vector3 turned = of(column);
            for (unsigned int i = 0; i < n; ++i)
              (*to)(i, j) = turned(i);
          }
      return both;
    }

    std::vector<double> angles;
  };

  /** Stiffness of an elastic half-space, G = 1 and ν = 0.2, at the centres of n
   * × n squares of its surface, |x|, |y| < 1: displacements of point forces
   * (Johnson, Contact Mechanics, 1985, section 3.6), of forces on their own
   * square those of a uniform traction at its centre. */
  class HalfSpace
  {
  public:
    HalfSpace(const unsigned int n)
      : m(n * n)
      , stiffness(3 * m)
    {
      for (unsigned int i = 0; i < m; ++i)
        places.push_back(
          {(i / n + 0.5) * 2. / n - 1., (i % n + 0.5) * 2. / n - 1.});
      for (unsigned int i = 0; i < m; ++i)
        for (unsigned int j = 0; j < m; ++j)
          set_compliance(i, j, 4. * std::log(1. + std::sqrt(2.)) * n / 2.);
      stiffness.invert();
      for (unsigned int i = 0; i < 3 * m; ++i)
        for (unsigned int j = 0; j < i; ++j)
          stiffness(i, j) = stiffness(j, i) =
            0.5 * (stiffness(i, j) + stiffness(j, i));
    }

    /** A smooth function of the place that vanishes at the edges. */
    Vector3
    smooth(Random &random) const
    {
      Vector3 values(m);
      for (unsigned int a = 0; a < 3; ++a)
        {
          const double size = gaussian(random) / (1 + a),
                       p = 3. * gaussian(random), q = 3. * gaussian(random);
          for (unsigned int i = 0; i < m; ++i)
            {
              const auto [x, y] = places[i];
              const double edge = std::max(std::abs(x), std::abs(y));
              values(i) += size * std::cos(1.5 * a * x + p) *
                           std::cos(1.5 * a * y + q) *
                           std::sqrt(std::max(1.02 - edge * edge, 0.));
            }
        }
      return values;
    }

    /** Loads of random jumps. */
    Vector3
    loads(Random &random) const
    {
      Vector3 jumps(3 * m), loads(3 * m);
      for (const unsigned int c : {0, 1, 2})
        {
          const Vector3 of_component = smooth(random);
          for (unsigned int i = 0; i < m; ++i)
            jumps(c * m + i) =
              c == 0 ? -0.5 + 0.7 * of_component(i) : 0.5 * of_component(i);
        }
      stiffness.vmult(loads, jumps);
      return loads;
    }

    const unsigned int m;
    Matrix             stiffness;

  private:
    void
    set_compliance(const unsigned int i, const unsigned int j, const double own)
    {
      constexpr double nu = 0.2, factor = 0.5 / dealii::numbers::PI;
      const double     x  = places[i].first - places[j].first,
                   y      = places[i].second - places[j].second;
      const double square = i == j ? 1. : x * x + y * y, r = std::sqrt(square);
      const double part               = i == j ? 0.5 : x * x / square;
      const double of_r               = factor * (i == j ? own : 1. / r);
      const double uz                 = factor * 0.5 * (1. - 2. * nu) / square;
      stiffness(i, j)                 = (1. - nu) * of_r;
      stiffness(m + i, m + j)         = (1. - nu + nu * part) * of_r;
      stiffness(2 * m + i, 2 * m + j) = (1. - nu * part) * of_r;
      stiffness(m + i, 2 * m + j)     = stiffness(2 * m + i, m + j) =
        nu * x * y / square * of_r;
      stiffness(i, m + j)     = uz * x;
      stiffness(m + i, j)     = -uz * x;
      stiffness(i, 2 * m + j) = uz * y;
      stiffness(2 * m + i, j) = -uz * y;
    }

    std::vector<std::pair<double, double>> places;
  };

  void
  half_space(const unsigned int n, const unsigned int n_problems)
  {
    Random          random(1882 + n);
    const HalfSpace body(n);
    double          worst = 0., again = 0., turned = 0.;
    unsigned int    cold = 0, warm = 0, most = 0, rescues = 0;
    for (unsigned int k = 0; k < n_problems; ++k)
      {
        const double        mu[] = {0., 0.1, 0.3, 0.6, 1., 1.5, 2.};
        std::vector<double> gaps(body.m);
        if (k % 2 == 1)
          for (unsigned int i = 0; i < body.m; ++i)
            gaps[i] = -0.1 * std::abs(body.smooth(random)(i));
        FrictionProblem lip = problem_of(body.stiffness, gaps, mu[k % 7], 2);
        if (k % 3 == 1)
          for (auto &along : lip.increment.reference)
            {
              const Vector3 slip = body.smooth(random);
              along.assign(slip.begin(), slip.end());
            }
        const Vector3 first = body.loads(random), second = body.loads(random);
        Vector3       q(3 * body.m), same(q);
        for (unsigned int step = 0; step < 4; ++step)
          {
            Vector3 loads = first;
            loads.sadd(1. - 0.05 * step, 0.05 * step, second);
            const bool is_turned = step == 0 && k < 10;
            if (is_turned)
              {
                const Turn      turn(body.m, random);
                const Matrix    A     = turn.of(body.stiffness);
                FrictionProblem other = problem_of(A, gaps, mu[k % 7], 2);
                Vector3         reference(3 * body.m);
                for (const unsigned int c : {0, 1})
                  std::copy(lip.increment.reference[c].begin(),
                            lip.increment.reference[c].end(),
                            reference.begin() + (1 + c) * body.m);
                commit(other, turn.of(reference));
                other.solve(turn.of(loads), same);
                same = turn.of(same, -1.);
              }
            const unsigned int n_sets = lip.solve(loads, q);
            (step == 0 ? cold : warm) += n_sets;
            most  = std::max(most, n_sets);
            worst = std::max(worst, violation(lip, loads, q));
            if (is_turned)
              {
                same -= q;
                turned = std::max(turned, same.linfty_norm() / q.linfty_norm());
              }
            commit(lip, q);
            lip.solve(loads, same);
            same -= q;
            again = std::max(again, same.linfty_norm() / q.linfty_norm());
          }
        rescues += lip.n_rescues();
      }
    section(std::to_string(body.m) + " pairs on a half-space");
    check_below("mean number of steps, cold", cold / double(n_problems), 7.);
    check_below("mean number of steps, warm", warm / (3. * n_problems), 5.);
    check_below("largest number of steps", most, 15.);
    check("none needs another method", rescues == 0);
    check_below("violation", worst, 1e-9);
    check_below("solved again from its own slip", again, 1e-11);
    check_below("in turned tangents", turned, 1e-10);
  }

  Matrix
  random_stiffness(const unsigned int n, Random &random)
  {
    dealii::FullMatrix<double> root(n), product(n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        root(i, j) = gaussian(random);
    root.Tmmult(product, root);
    for (unsigned int i = 0; i < n; ++i)
      product(i, i) += 0.1;
    Matrix A(n);
    A = product;
    return A;
  }

  Vector3
  random_vector(const unsigned int n, Random &random)
  {
    Vector3 values(n);
    for (double &value : values)
      value = gaussian(random);
    return values;
  }

  void
  random_stiffnesses()
  {
    Random       random(1998);
    double       worst   = 0.;
    unsigned int rescues = 0;
    for (unsigned int k = 0; k < 5000; ++k)
      {
        const unsigned int m   = 1 + k % 8;
        const Matrix       A   = random_stiffness(3 * m, random);
        FrictionProblem    lip = problem_of(A,
                                         std::vector<double>(m, k % 2 * -0.1),
                                         0.25 * (k % 9),
                                         2);
        for (auto &along : lip.increment.reference)
          along.assign(m, k % 3 * 0.05);
        const Vector3 loads = random_vector(3 * m, random);
        Vector3       q(3 * m);
        lip.solve(loads, q);
        worst = std::max(worst, violation(lip, loads, q));
        rescues += lip.n_rescues();
      }
    section("random stiffnesses");
    check_below("violation", worst, 1e-9);
    check("some cycles were met and ended", rescues > 0);
  }

  /** A problem of the plane, with the stiffness along the second tangents that
   * of the first, and without load there: nothing slides along these. */
  void
  plane_in_space()
  {
    Random       random(1926);
    double       worst = 0.;
    unsigned int n     = 0;
    for (unsigned int k = 0; k < 300; ++k)
      {
        const unsigned int m = 1 + k % 8;
        const Matrix       A = random_stiffness(2 * m, random);
        Matrix             both(3 * m);
        for (unsigned int i = 0; i < 2 * m; ++i)
          for (unsigned int j = 0; j < 2 * m; ++j)
            {
              both(i, j) = A(i, j);
              if (i >= m && j >= m)
                both(m + i, m + j) = A(i, j);
            }
        const Vector3 loads = random_vector(2 * m, random);
        Vector3       of_space(loads), q(2 * m), in_space(3 * m);
        of_space.grow_or_shrink(3 * m);
        const std::vector<double> gaps(m, k % 2 * -0.1);
        const double              mu    = 0.2 * (k % 6);
        FrictionProblem           plane = problem_of(A, gaps, mu, 1);
        plane.solve(loads, q);
        if (plane.n_rescues() > 0)
          continue; // another of several solutions may follow
        const Turn      turn(m, random);
        const Matrix    turned = turn.of(both);
        FrictionProblem space  = problem_of(turned, gaps, mu, 2);
        space.solve(turn.of(of_space), in_space);
        in_space = turn.of(in_space, -1.);
        ++n;
        for (unsigned int i = 0; i < 3 * m; ++i)
          worst = std::max(worst,
                           std::abs(in_space(i) - (i < 2 * m ? q(i) : 0.)) /
                             q.linfty_norm());
      }
    section("problems of the plane");
    check("most are compared", n > 250);
    check_below("difference", worst, 1e-10);
  }
} // namespace

void
friction_in_space()
{
  half_space(8, is_full() ? 200 : 40);
  half_space(12, is_full() ? 200 : 8);
  random_stiffnesses();
  plane_in_space();
}
