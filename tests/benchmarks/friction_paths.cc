// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Friction on the lips of plates: 2000 seeded increments, each with three
// followers, and 900 paths of six steps to and fro. Cracks are straight, close
// to a side, wavy, kinked, or between two materials, with 20 to 400 pairs and
// coefficients of 0 to 2. An increment is lost if its solution violates the law
// by more than 1e-9. Lemke's method solves some of up to 100 pairs, too: forces
// agree, or there are several solutions. Fails if an increment is lost, if more
// than 1 % end in a ray, or if 100 pairs need more than 3.5 sets from the last.
//
//   ninja -C build friction_paths && OMP_NUM_THREADS=1
//   build/tests/benchmarks/friction_paths [n]    # one nth of the problems

#include <crevasse/base/single_process.h>
#include <crevasse/contact/friction_problem.h>
#include <crevasse/linear/cholesky.h>

#include <deal.II/base/logstream.h>

#include <crevasse_tests/cracked_plate.h>
#include <crevasse_tests/friction_violation.h>
#include <cstdio>
#include <random>
#include <sstream>

using namespace Crevasse;

namespace
{
  using Small  = dealii::Vector<double>;
  using Random = std::mt19937;

  double
  normal(Random &random)
  {
    return std::normal_distribution<double>()(random);
  }

  /** The lip of a plate: its stiffness, and the loads of three tractions. */
  struct Lip
  {
    Lip(const LipShape shape, const unsigned int n_pairs)
      : plate(shape, n_pairs)
      , problem(plate.matrix, plate.bounds)
      , factor(plate.matrix, problem.all_lip_dofs())
    {
      for (const char *traction : {"0; 1", "1; 0", "0; x/2"})
        {
          Vector u;
          plate.strain_operator.initialize(u);
          factor.solve_with_lip(u, plate.loads(traction), [this](Small &c) {
            loads.push_back(c);
            c = 0.;
          });
        }
    }

    std::vector<FrictionProblem::Pair>
    pairs(const Small &gap) const
    {
      std::vector<FrictionProblem::Pair> all;
      for (unsigned int i = 0; i < gap.size(); ++i)
        all.push_back(
          {i,
           {{i + unsigned(gap.size()), dealii::numbers::invalid_unsigned_int}},
           gap(i)});
      return all;
    }

    /** Smooth functions of the place on the lip, of the size of 1. */
    Small
    smooth(Random &random) const
    {
      Small values(plate.lip.nodes.size());
      for (unsigned int k = 0; k < 4; ++k)
        {
          const double size  = normal(random) / (1 + k),
                       phase = 3. * normal(random);
          for (unsigned int i = 0; i < values.size(); ++i)
            values(i) += size * std::cos(0.5 * k * dealii::numbers::PI *
                                           plate.lip.nodes[i].point[0] +
                                         phase);
        }
      return values;
    }

    /** Smooth jumps, which vanish at the tips, of the size of those under a
     * stress of 1. */
    Small
    smooth_jumps(Random &random) const
    {
      Small values = smooth(random);
      for (unsigned int i = 0; i < values.size(); ++i)
        values(i) *= std::sqrt(std::max(0.,
                                        1. - plate.lip.nodes[i].point[0] *
                                               plate.lip.nodes[i].point[0]));
      return values;
    }

    Small
    random_loads(Random &random) const
    {
      Small       c(loads[0]);
      const Small across = smooth(random), along = smooth(random);
      c *= -std::uniform_real_distribution<double>(0., 1.5)(random);
      c.add(normal(random), loads[1], normal(random), loads[2]);
      for (unsigned int i = 0; i < across.size(); ++i)
        {
          const double stress = 0.3 * plate.lip.nodes[i].weight;
          c(i) += stress * across(i);
          c(i + across.size()) += stress * along(i);
        }
      return c;
    }

    const CrackedPlate     plate;
    const SignoriniProblem problem;
    Cholesky               factor;
    std::vector<Small>     loads;
  };



  /** What solves needed. */
  struct Counts
  {
    unsigned int problems = 0, lost = 0, cold = 0, n_warm = 0, warm = 0,
                 most_warm = 0, rescues = 0, by_lemke = 0, rays = 0,
                 several = 0;
    double difference    = 0.; ///< of forces of one solution by both methods

    void
    add(const Counts &other)
    {
      problems += other.problems;
      lost += other.lost;
      cold += other.cold;
      n_warm += other.n_warm;
      warm += other.warm;
      most_warm = std::max(most_warm, other.most_warm);
      rescues += other.rescues;
      by_lemke += other.by_lemke;
      rays += other.rays;
      several += other.several;
      difference = std::max(difference, other.difference);
    }

    /** Compares a solution with that of Lemke's method. */
    void
    compare(const FrictionProblem &problem, const Small &c, const Small &q)
    {
      FrictionProblem lemke(problem.factor.matrix, problem.pairs);
      lemke.increment = problem.increment;
      ++by_lemke;
      try
        {
          lemke.solve_by_lemke(c, 2);
        }
      catch (const NumericalError &)
        {
          ++rays;
          return;
        }
      Small of_lemke(c.size()), forces(c.size());
      lemke.solve(c, of_lemke);
      lost += violation(lemke, c, of_lemke) <= 1e-9 ? 0 : 1;
      of_lemke -= q;
      problem.factor.matrix.vmult(forces, of_lemke);
      const double apart = forces.linfty_norm() / c.linfty_norm();
      if (apart <= 1e-9)
        difference = std::max(difference, apart);
      else
        ++several;
    }

    double
    mean_warm() const
    {
      return warm / double(n_warm);
    }

    void
    print(const char *name) const
    {
      std::printf(
        "%-22s %5u problems  %2u lost  %4.1f sets cold  %4.1f warm, "
        "at most %2u  %u by Lemke\n",
        name,
        problems,
        lost,
        cold / double(problems),
        mean_warm(),
        most_warm,
        rescues);
      std::fflush(stdout);
    }

    void
    print_lemke() const
    {
      std::printf(
        "Lemke's method on %u: %u rays; forces differ by %.1e; %u have "
        "several solutions\n",
        by_lemke,
        rays,
        difference,
        several);
    }
  };



  /** Which increments Lemke's method solves, too. */
  enum class Compare
  {
    none,
    first,
    last
  };



  /** An increment and its followers, at parts of the way from its loads to
   * other ones, each from the slip of the last. */
  Counts
  follow(const Lip                &lip,
         const Small              &gap,
         FrictionState             increment,
         const std::vector<double> parts,
         const Compare             how,
         Random                   &random)
  {
    const auto      pairs = lip.pairs(gap);
    const auto     &S     = lip.factor.lip_stiffness();
    FrictionProblem problem(S, pairs);
    const Small     first = lip.random_loads(random),
                second    = lip.random_loads(random);
    Small      c(first), q(first.size());
    Counts     counts;
    const auto solve = [&]() {
      problem.increment         = increment;
      const unsigned int n_sets = problem.solve(c, q);
      counts.lost += violation(problem, c, q) <= 1e-9 ? 0 : 1; // nan counts
      increment.reference[0].assign(q.begin() + gap.size(), q.end());
      return n_sets;
    };
    counts.problems = 1;
    counts.cold     = solve();
    if (how == Compare::first)
      counts.compare(problem, c, q);
    for (const double part : parts)
      {
        c = first;
        c.sadd(1. - part, part, second);
        const unsigned int n_sets = solve();
        counts.most_warm          = std::max(counts.most_warm, n_sets);
        counts.warm += n_sets;
        ++counts.n_warm;
      }
    if (how == Compare::last)
      counts.compare(problem, c, q);
    counts.rescues = problem.n_rescues();
    return counts;
  }



  Counts
  increments(const Lip &lip, const unsigned int per_coefficient, Random &random)
  {
    Counts             all;
    const unsigned int m = lip.plate.lip.nodes.size();
    for (const double mu : {0., 0.1, 0.2, 0.3, 0.6, 1., 1.5, 2.})
      for (unsigned int k = 0; k < per_coefficient; ++k)
        {
          Small         gap(m);
          FrictionState increment{std::vector<double>(m, mu),
                                  {std::vector<double>(m)}};
          if (random() % 2 == 0)
            {
              gap = lip.smooth_jumps(random);
              for (double &value : gap)
                value = -0.5 * std::abs(value);
            }
          if (random() % 2 == 0)
            {
              const Small slip = lip.smooth_jumps(random);
              increment.reference[0].assign(slip.begin(), slip.end());
            }
          all.add(follow(lip,
                         gap,
                         increment,
                         {0.05, 0.1, 0.15},
                         m <= 100 ? Compare::first : Compare::none,
                         random));
        }
    return all;
  }



  /** Paths to and fro, without gaps and from rest. */
  Counts
  paths(const Lip &lip, const unsigned int per_coefficient, Random &random)
  {
    Counts             all;
    const unsigned int m = lip.plate.lip.nodes.size();
    for (const double mu : {0.1, 0.3, 1.})
      for (unsigned int k = 0; k < per_coefficient; ++k)
        all.add(follow(lip,
                       Small(m),
                       {std::vector<double>(m, mu), {std::vector<double>(m)}},
                       {0.05, 0.1, 0.15, 0.1, 0.05, 0.},
                       Compare::last,
                       random));
    return all;
  }



  /** Numbers of iterations of GMRES. */
  struct Iterations
  {
    unsigned int solves = 0, sum = 0, most = 0, limited = 0;

    /** Adds those in what deal.II logged. */
    void
    read(const std::string &log)
    {
      const std::string words = "Convergence step ";
      for (std::size_t at = 0; (at = log.find(words, at)) != std::string::npos;)
        {
          at += words.size();
          const unsigned int n = std::stoul(log.substr(at));
          ++solves;
          sum += n;
          most = std::max(most, n);
          limited += n >= 15 ? 1 : 0;
        }
    }
  };
} // namespace



int
main(int argc, char **argv)
{
  set_up_single_process();
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  // 10 increments and 60 paths for each lip and coefficient, or a part.
  const unsigned int part = argc > 1 ? std::stoul(argv[1]) : 1;
  std::ostringstream log;
  dealii::deallog.attach(log);
  Random     random(1785);
  Counts     all, of_100, of_paths;
  Iterations iterations;
  const auto of_part = [&random, part](const unsigned int n) {
    return n / part + (random() % part < n % part ? 1 : 0);
  };
  for (const auto &[shape, name] :
       {std::make_pair(LipShape::straight, "straight"),
        std::make_pair(LipShape::shallow, "shallow"),
        std::make_pair(LipShape::wavy, "wavy"),
        std::make_pair(LipShape::kinked, "kinked"),
        std::make_pair(LipShape::bimaterial, "bimaterial")})
    for (const unsigned int n_pairs : {20, 50, 100, 200, 400})
      {
        const Lip lip(shape, n_pairs);
        Counts    counts = increments(lip, of_part(10), random);
        all.add(counts);
        if (n_pairs == 100)
          {
            of_100.add(counts);
            of_paths.add(paths(lip, of_part(60), random));
          }
        if (counts.problems > 0)
          counts.print(
            (std::string(name) + ", " + std::to_string(n_pairs) + " pairs")
              .c_str());
        iterations.read(log.str());
        log.str("");
      }
  all.print("all increments");
  of_100.print("those of 100 pairs");
  of_paths.print("paths of 100 pairs");
  all.add(of_paths);
  all.print_lemke();
  std::printf(
    "GMRES: %u systems, %.1f iterations, at most %u; %u need 15 or "
    "elimination\n",
    iterations.solves,
    iterations.sum / double(iterations.solves),
    iterations.most,
    iterations.limited);
  const bool good = all.lost == 0 && 100 * all.rays <= all.by_lemke &&
                    of_100.mean_warm() <= 3.5 &&
                    10 * iterations.limited <= iterations.solves;
  return good ? 0 : 1;
}
