// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/csv_table.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/contact/sweep.h>
#include <crevasse/model/elastic_displacement.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/simulation/run.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Largest residual max |A q − b|, a force. */
    double
    residual_norm(const SparseMatrix &matrix, const Vector &q, const Vector &b)
    {
      Vector residual(b);
      multiply(matrix, residual, q);
      residual -= b;
      return residual.linfty_norm();
    }



    /** Rounds the entries of a vector to 27 bits of mantissa. */
    Vector
    in_single_precision_of_1980(Vector vector)
    {
      for (double &value : vector)
        {
          int          exponent;
          const double mantissa = std::frexp(value, &exponent);
          value =
            std::ldexp(std::round(std::ldexp(mantissa, 27)), exponent - 27);
        }
      return vector;
    }
  } // namespace



  // Without constraints, at the instant of the largest load, the number of SOR
  // iterations to the residual of the direct solver, for each relaxation factor
  // of the scene and for the best factor, found by dichotomy. The paper's
  // machine is assumed to have single precision with 27 bits of mantissa: its
  // direct solver's residual then is that of a solution rounded to 27 bits, the
  // target of the table's second column.
  template <int dim>
  void
  Run<dim>::write_relaxation_table()
  {
    const SparseMatrix &matrix = systems.system_at(0.).problem().matrix();
    const Vector loads   = loads_at(body, instant_of_largest_load(body, steps));
    const double largest = loads.linfty_norm();
    if (largest == 0.)
      throw SceneError(
        "[Contact] Relaxation table: there is no load, so that iterations "
        "cannot be counted. Set [Loads], or leave the table empty.");
    const Vector direct =
      elastic_displacement(scene, body, systems, loads, false);
    const double target = residual_norm(matrix, direct, loads);
    const double target_1980 =
      residual_norm(matrix, in_single_precision_of_1980(direct), loads);

    const UnilateralBounds none;
    const SignoriniProblem problem(matrix, none);
    const Sweep            sweep(problem);
    const unsigned int     most = scene.contact.maximum_iterations;
    const double           best = sweep.best_factor(loads, target_1980, most);
    std::vector<double>    factors = scene.contact.relaxation_table;
    factors.push_back(best);
    std::sort(factors.begin(), factors.end());

    log.line(
      Text::format("\n  SOR without constraints: iterations to the direct "
                   "solver's residual, %.2e of the largest load",
                   target / largest));
    log.line(
      Text::format("  (27 bits: to the residual of the solution with a "
                   "mantissa of 27 bits, %.2e)",
                   target_1980 / largest));
    log.line("      factor    iterations       27 bits");
    const bool is_first_rank =
      Utilities::MPI::this_mpi_process(body.space.communicator()) == 0;
    CsvTable csv(is_first_rank ? checkpoints.directory + "/relaxation.csv" : "",
                 {"relaxation_factor", "iterations", "iterations_27_bits"});
    for (const double factor : factors)
      {
        std::string         line = Text::format("  %10.4f", factor);
        std::vector<double> row  = {factor};
        for (const double goal : {target, target_1980})
          {
            const SorCount count =
              sweep.count_iterations(loads, factor, goal, most);
            const std::string text =
              (count.reached ? "" : "> ") + std::to_string(count.iterations);
            line += Text::format("  %12s", text.c_str());
            row.push_back(count.reached ? count.iterations : std::nan(""));
          }
        log.line(line + (factor == best ? "  (best, by dichotomy)" : ""));
        csv.add_row(row);
      }
  }



  template void
  Run<2>::write_relaxation_table();
  template void
  Run<3>::write_relaxation_table();
} // namespace Crevasse
