// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// The contact problem of a periodic motion: random viscoelastic bodies (seeded)
// whose relaxation times differ by factors of 10³ and more, solved to rounding;
// one solution whatever the method; shifts in time and units;
// a closed form; degenerate nodes; input that is refused.

#include <crevasse/base/problems.h>
#include <crevasse/harmonic_balance/periodic_contact.h>

#include <deal.II/base/numbers.h>

#include <crevasse_tests/tests.h>
#include <random>

using namespace Crevasse;

namespace
{
  using Complex = std::complex<double>;
  using Dense   = dealii::FullMatrix<double>;
  using Small   = dealii::Vector<double>;

  constexpr double pi = dealii::numbers::PI;

  std::mt19937 generator;

  double
  uniform(const double from, const double to)
  {
    return std::uniform_real_distribution<double>(from, to)(generator);
  }

  unsigned int
  one_of(const std::vector<unsigned int> &choices)
  {
    return choices[std::uniform_int_distribution<unsigned int>(
      0, choices.size() - 1)(generator)];
  }

  /** RᵀR + small identity for a random square R. */
  Dense
  random_positive_definite(const unsigned int n)
  {
    Dense root(n, n), result(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        root(i, j) = uniform(-1., 1.);
    root.Tmmult(result, root);
    result.diagadd(0.005);
    return result;
  }

  /** A part of a body with strains B u: its compliance K⁻¹, its fluidity H. */
  struct Element
  {
    Dense strains;
    Dense compliance;
    Dense fluidity;
  };

  /** Elements of random anisotropy, with relaxation times of 10^±decades
   * periods. */
  std::vector<Element>
  random_body(const unsigned int n_unknowns, const double decades)
  {
    std::vector<Element> body;
    for (unsigned int e = 0; e < n_unknowns / 3 + 1; ++e)
      {
        Element element{Dense(3, n_unknowns),
                        random_positive_definite(3),
                        random_positive_definite(3)};
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < n_unknowns; ++j)
            element.strains(i, j) = uniform(-1., 1.);
        element.compliance *= std::pow(10., uniform(-1.5, 1.5));
        element.fluidity *= std::pow(10., uniform(-decades, decades));
        body.push_back(element);
      }
    return body;
  }

  /** S = L A⁻¹ Lᵀ with A = Σ Bᵀ (K⁻¹ + rate H)⁻¹ B; L takes the first nodes. */
  std::shared_ptr<const dealii::FullMatrix<Complex>>
  compliance(const std::vector<Element> &body,
             const Complex               rate,
             const unsigned int          n_nodes)
  {
    const unsigned int          n = body.front().strains.n();
    dealii::FullMatrix<Complex> stiffness(n, n);
    for (const Element &element : body)
      {
        dealii::FullMatrix<Complex> moduli(3, 3);
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            moduli(i, j) =
              element.compliance(i, j) + rate * element.fluidity(i, j);
        moduli.gauss_jordan();
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
            for (unsigned int i = 0; i < 3; ++i)
              for (unsigned int j = 0; j < 3; ++j)
                stiffness(a, b) +=
                  element.strains(i, a) * moduli(i, j) * element.strains(j, b);
      }
    stiffness.gauss_jordan();
    auto result =
      std::make_shared<dealii::FullMatrix<Complex>>(n_nodes, n_nodes);
    for (unsigned int i = 0; i < n_nodes; ++i)
      for (unsigned int j = 0; j < n_nodes; ++j)
        (*result)(i, j) = 0.5 * (stiffness(i, j) + stiffness(j, i));
    return result;
  }

  /** Period 1; the trapezoidal rule makes the highest harmonic of an even N
   * elastic. */
  PeriodicContactProblem
  random_problem(const unsigned int n_nodes,
                 const unsigned int n_instants,
                 const double       decades)
  {
    const unsigned int     N = n_instants;
    PeriodicContactProblem problem;
    const auto             body = random_body(n_nodes + 2, decades);
    for (unsigned int n = 1; n <= N / 2; ++n)
      {
        const double  half = pi * n / N;
        const Complex rate =
          2 * n == N ? 0. : 1. / Complex(0., 2. * N * std::tan(half));
        problem.compliances.push_back({compliance(body, rate, n_nodes), 1.});
      }

    problem.openings_without_contact.resize(N, Small(n_nodes));
    const unsigned int n_harmonics = one_of({1, 2, 4});
    for (unsigned int i = 0; i < n_nodes; ++i)
      for (unsigned int n = 0; n <= n_harmonics; ++n)
        {
          const double size  = uniform(0., 1.) / (1. + n);
          const double phase = uniform(0., 2. * pi);
          for (unsigned int j = 0; j < N; ++j)
            problem.openings_without_contact[j](i) +=
              size * std::cos(2. * pi * n * j / N + phase);
        }
    problem.mean_forces.reinit(n_nodes);
    const double level = std::pow(10., uniform(-2., 1.));
    for (unsigned int i = 0; i < n_nodes; ++i)
      problem.mean_forces(i) = level * uniform(0.1, 1.);
    return problem;
  }

  /** S ∗ g by sums instead of transforms. */
  std::vector<Small>
  convolution(const PeriodicContactProblem &problem,
              const std::vector<Small>     &forces)
  {
    const unsigned int N = forces.size(), p = forces[0].size();
    std::vector<Small> result(N, Small(p));
    for (unsigned int n = 1; n <= N / 2; ++n)
      {
        const auto phase = [&](const unsigned int j) {
          return std::polar(1., 2. * pi * ((n * j) % N) / N);
        };
        dealii::Vector<Complex> harmonic(p), moved(p);
        for (unsigned int j = 0; j < N; ++j)
          for (unsigned int i = 0; i < p; ++i)
            harmonic(i) += forces[j](i) / double(N) * std::conj(phase(j));
        const auto &[matrix, factor] = problem.compliances[n - 1];
        matrix->vmult(moved, harmonic);
        for (unsigned int j = 0; j < N; ++j)
          for (unsigned int i = 0; i < p; ++i)
            result[j](i) +=
              (2 * n == N ? 1. : 2.) * std::real(factor * moved(i) * phase(j));
      }
    return result;
  }

  double
  largest(const std::vector<Small> &function)
  {
    double result = 0.;
    for (const Small &at_instant : function)
      result = std::max(result, at_instant.linfty_norm());
    return result;
  }

  /** The largest difference of forces, relative to the largest one. */
  double
  difference(const std::vector<Small> &a, const std::vector<Small> &b)
  {
    std::vector<Small> between(a);
    for (unsigned int j = 0; j < a.size(); ++j)
      between[j] -= b[j];
    return largest(between) / largest(a);
  }

  /** |min(g, w)|, the defect of w and that of the mean, all relative to the
   * largest force, and opening without contact or moved by forces. */
  double
  violation(const PeriodicContactProblem  &problem,
            const PeriodicContactSolution &solution)
  {
    const auto        &g = solution.forces;
    const unsigned int N = g.size(), p = g[0].size();
    const auto         moved = convolution(problem, g);
    const double       force = largest(g);
    double length = largest(problem.openings_without_contact) + largest(moved);
    for (const auto &[matrix, factor] : problem.compliances)
      length += force * std::abs(factor * (*matrix)(0, 0)) / N;
    double worst = 0.;
    for (unsigned int i = 0; i < p; ++i)
      {
        double mean = 0.;
        for (unsigned int j = 0; j < N; ++j)
          {
            const double w = problem.openings_without_contact[j](i) +
                             moved[j](i) + solution.offsets(i);
            mean += g[j](i) / N;
            worst =
              std::max(worst, std::abs(std::min(g[j](i) / force, w / length)));
          }
        worst =
          std::max(worst, std::abs(mean - problem.mean_forces(i)) / force);
      }
    return worst;
  }

  PeriodicContactSolution
  solve_with(const PeriodicContactProblem &problem,
             const unsigned int            largest_dense_system,
             const unsigned int            most_gmres_steps = 2000)
  {
    PeriodicContactOptions options;
    options.largest_dense_system = largest_dense_system;
    options.most_gmres_steps     = most_gmres_steps;
    return solve_periodic_contact(problem, options);
  }

  /** Relaxation times within a factor of 10³ around the period, and 10⁶. */
  void
  random_problems()
  {
    generator.seed(1980);
    constexpr unsigned int n_problems = 200;
    unsigned int           n_rescued  = 0;
    double                 worst = 0., worst_certificate = 0.;
    for (unsigned int k = 0; k < n_problems; ++k)
      {
        const unsigned int N =
          one_of({1, 2, 3, 4, 5, 7, 8, 12, 15, 16, 21, 24, 32, 33, 40, 64});
        const auto problem  = random_problem(1 + k % 8, N, k % 2 ? 3. : 1.5);
        const auto solution = solve_periodic_contact(problem);
        worst               = std::max(worst, violation(problem, solution));
        worst_certificate =
          std::max(worst_certificate, solution.certificate.worst());
        n_rescued += solution.n_proximal_steps > 0 ? 1 : 0;
      }
    check_below("certificate", worst_certificate, 1e-11);
    check_below("violation", worst, 1e-11);
    // By nine, where this was written.
    check("proximal points were needed, by few",
          n_rescued > 0 && n_rescued < n_problems / 10);
  }

  /** One solution by factors and by GMRES. */
  void
  one_solution()
  {
    generator.seed(1992);
    double difference_to_gmres = 0.;
    bool   both_methods        = true;
    for (unsigned int k = 0; k < 60; ++k)
      {
        const unsigned int p = 1 + k % 8, N = one_of({2, 3, 8, 15, 24, 33});
        const auto         problem  = random_problem(p, N, k % 2 ? 3. : 1.5);
        const auto         factored = solve_with(problem, 5000);
        const auto         gmres    = solve_with(problem, 0);
        difference_to_gmres =
          std::max(difference_to_gmres,
                   difference(factored.forces, gmres.forces));
        both_methods = both_methods && factored.n_gmres_iterations == 0 &&
                       gmres.n_gmres_iterations > 0;
      }
    check_below("GMRES changes forces by", difference_to_gmres, 1e-8);
    check("statistics tell which method it was", both_methods);
  }

  /** Later by some instants is later by some instants; other units are only
   * other units. */
  void
  invariance()
  {
    generator.seed(2002);
    double shifts_count = 0., units_count = 0.;
    for (unsigned int k = 0; k < 20; ++k)
      {
        const unsigned int N        = one_of({5, 8, 15, 24});
        const auto         problem  = random_problem(1 + k % 8, N, 1.5);
        const auto         solution = solve_periodic_contact(problem);

        auto               later    = problem;
        const unsigned int instants = 1 + k % (N - 1);
        std::rotate(later.openings_without_contact.begin(),
                    later.openings_without_contact.begin() + instants,
                    later.openings_without_contact.end());
        auto forces = solve_periodic_contact(later).forces;
        std::rotate(forces.begin(), forces.end() - instants, forces.end());
        shifts_count =
          std::max(shifts_count, difference(solution.forces, forces));

        for (const double force : {1e-12, 1e12})
          for (const double length : {1e-12, 1e12})
            {
              auto scaled = problem;
              scaled.mean_forces *= force;
              for (auto &compliance : scaled.compliances)
                compliance.factor *= length / force;
              for (Small &opening : scaled.openings_without_contact)
                opening *= length;
              auto result = solve_with(scaled, k % 2 ? 0 : 5000);
              for (Small &at_instant : result.forces)
                at_instant /= force;
              result.offsets /= length;
              result.offsets -= solution.offsets;
              units_count =
                std::max({units_count,
                          difference(solution.forces, result.forces),
                          result.offsets.linfty_norm()});
            }
      }
    check_below("a shift in time changes forces by", shifts_count, 1e-9);
    check_below("units change forces and offsets by", units_count, 1e-9);
  }

  PeriodicContactProblem
  elastic_node(const unsigned int N, const double compliance)
  {
    PeriodicContactProblem problem;
    const auto one = std::make_shared<dealii::FullMatrix<Complex>>(1, 1);
    (*one)(0, 0)   = 1.;
    problem.compliances.resize(N / 2, {one, compliance});
    problem.openings_without_contact.resize(N, Small(1));
    problem.mean_forces.reinit(1);
    return problem;
  }

  /** S ∗ g = S (g − ḡ) for one elastic node: g = max(0, a − w⁰) / S, where a is
   * given here and the mean follows. */
  void
  closed_form()
  {
    constexpr double compliance = 0.7;
    double           error      = 0.;
    for (const unsigned int N : {1, 2, 3, 8, 33, 64})
      for (const double level : {-0.95, -0.5, 0., 0.3, 2.})
        {
          auto   problem = elastic_node(N, compliance);
          double mean    = 0.;
          for (unsigned int j = 0; j < N; ++j)
            {
              problem.openings_without_contact[j](0) =
                -std::cos(2. * pi * j / N) + 0.2 * std::sin(6. * pi * j / N);
              mean +=
                std::max(0., level - problem.openings_without_contact[j](0)) /
                compliance / N;
            }
          problem.mean_forces(0) = mean;
          const auto solution    = solve_periodic_contact(problem);
          for (unsigned int j = 0; j < N; ++j)
            {
              const double below =
                level - problem.openings_without_contact[j](0);
              error = std::max(error,
                               std::abs(solution.forces[j](0) -
                                        std::max(0., below) / compliance));
            }
          if (N > 1)
            error = std::max(error,
                             std::abs(solution.offsets(0) + level -
                                      compliance * mean));
        }
    check_below("error of the closed form", error, 1e-12);
  }

  /** From forces and openings to the problem that they solve, with many nodes
   * and instants where both vanish. */
  void
  degenerate_nodes()
  {
    generator.seed(1974);
    double error = 0., worst = 0.;
    for (unsigned int k = 0; k < 100; ++k)
      {
        const unsigned int p = 1 + k % 8, N = one_of({2, 5, 8, 15, 24});
        auto               problem = random_problem(p, N, k % 2 ? 3. : 1.5);
        std::vector<Small> forces(N, Small(p)), openings(N, Small(p));
        problem.mean_forces = 0.;
        for (unsigned int i = 0; i < p; ++i)
          for (unsigned int j = 0; j < N; ++j)
            {
              const unsigned int kind = j == i % N ? 0 : one_of({0, 1, 2, 2});
              forces[j](i)            = kind == 0 ? uniform(0.1, 1.) : 0.;
              openings[j](i)          = kind == 1 ? uniform(0.1, 1.) : 0.;
              problem.mean_forces(i) += forces[j](i) / N;
            }
        const auto moved = convolution(problem, forces);
        for (unsigned int j = 0; j < N; ++j)
          {
            problem.openings_without_contact[j] = openings[j];
            problem.openings_without_contact[j] -= moved[j];
          }
        const auto result = solve_with(problem, k % 3 ? 350 : 0);
        error             = std::max(error, difference(forces, result.forces));
        worst             = std::max(worst, result.certificate.worst());
      }
    check_below("error with degenerate nodes", error, 1e-8);
    check_below("their certificate", worst, 1e-9);

    // Nothing varies; a jump between two constants; a force that touches zero.
    worst = 0.;
    for (const unsigned int N : {2, 3, 8, 33})
      for (const double mean : {1e-6, 0.1, 10.})
        {
          auto problem           = elastic_node(N, 1.);
          problem.mean_forces(0) = mean;
          auto solution          = solve_periodic_contact(problem);
          worst = std::max(worst, violation(problem, solution));
          for (unsigned int j = 0; j < N; ++j)
            worst =
              std::max(worst, std::abs(solution.forces[j](0) / mean - 1.));
          for (unsigned int j = 0; j < N / 2; ++j)
            problem.openings_without_contact[j](0) = 1.;
          worst = std::max(worst,
                           violation(problem, solve_periodic_contact(problem)));
          for (unsigned int j = 0; j < N; ++j)
            problem.openings_without_contact[j](0) =
              mean * std::cos(2. * pi * j / N);
          worst = std::max(worst,
                           violation(problem, solve_periodic_contact(problem)));
        }
    check_below("violation where much is equal", worst, 1e-12);
  }

  bool
  refuses(const PeriodicContactProblem &problem, const std::string &hint)
  {
    try
      {
        solve_periodic_contact(problem);
      }
    catch (const NumericalError &error)
      {
        return std::string(error.what()).find(hint) != std::string::npos;
      }
    return false;
  }

  void
  refusals()
  {
    generator.seed(1);
    const auto good = random_problem(2, 8, 1.5);
    auto       bad  = good;

    bad.openings_without_contact[3](1) = std::nan("");
    check("an opening that is no number is refused",
          refuses(bad, "not finite"));
    bad                       = good;
    bad.compliances[1].factor = std::nan("");
    check("a compliance that is no number is refused",
          refuses(bad, "not finite"));
    bad = good;
    for (auto &compliance : bad.compliances)
      compliance.factor = 0.;
    check("no compliance is refused, with a hint",
          refuses(bad, "[Periodic state] Method = anderson"));
    for (auto &compliance : bad.compliances)
      compliance.factor = -1.;
    check("a negative compliance is refused, with a hint",
          refuses(bad, "[Periodic state] Method = anderson"));
  }

  /** Where GMRES may not take the steps that it needs, a factor is made. */
  void
  too_few_steps()
  {
    generator.seed(4);
    const auto problem  = random_problem(4, 12, 3.);
    const auto few      = solve_with(problem, 0, 1);
    const auto as_usual = solve_with(problem, 0);
    check("GMRES takes some steps",
          few.n_gmres_iterations > 0 &&
            as_usual.n_gmres_iterations > few.n_gmres_iterations);
    check_below("too few steps of GMRES change forces by",
                difference(as_usual.forces, few.forces),
                1e-10);
  }

  /** What is wrong by 1e-6 is seen, and named. */
  void
  certificates()
  {
    generator.seed(3);
    const auto problem = random_problem(3, 8, 1.5);
    const auto right   = solve_periodic_contact(problem);
    check_below("certificate of the solution",
                certify(problem, right).worst(),
                1e-13);

    const double force  = 1e-6 * largest(right.forces);
    double       length = largest(problem.openings_without_contact);
    for (const auto &[matrix, factor] : problem.compliances)
      for (unsigned int i = 0; i < 3; ++i)
        length = std::max(length,
                          largest(problem.openings_without_contact) +
                            largest(right.forces) *
                              std::abs(factor * (*matrix)(i, i)));
    length *= 1e-6;
    auto       wrong = right;
    const auto push  = [&](const double by) {
      wrong = right;
      for (Small &at_instant : wrong.forces)
        at_instant.add(by);
      return certify(problem, wrong);
    };
    check("a wrong mean is seen", push(force).mean_defect > 0.9e-6);
    check("tension is seen", push(-force).tension > 0.9e-6);
    const auto move = [&](const double by) {
      wrong = right;
      wrong.offsets.add(by);
      return certify(problem, wrong);
    };
    check("penetration is seen", move(-length).penetration > 0.9e-6);
    check("openings under force are seen",
          move(length).complementarity > 0.9e-6);
    wrong.forces[0](2) = std::nan("");
    check("what is no number is seen",
          std::isinf(certify(problem, wrong).worst()));
  }
} // namespace

void
periodic_contact()
{
  random_problems();
  one_solution();
  invariance();
  closed_form();
  degenerate_nodes();
  too_few_steps();
  certificates();
  refusals();
}
