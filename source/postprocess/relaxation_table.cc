// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/csv_table.h>
#include <crevasse/base/problems.h>
#include <crevasse/contact/sweep.h>
#include <crevasse/linear/matrix_operator.h>
#include <crevasse/model/elastic_displacement.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/postprocess/relaxation_table.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** max |A q − b|, a force. */
    double
    residual_norm(const SparseMatrix &matrix, const Vector &q, const Vector &b)
    {
      Vector residual(b);
      multiply(matrix, residual, q);
      residual -= b;
      return residual.linfty_norm();
    }



    /** The vector with its entries rounded to 27 bits of mantissa. */
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



    std::string
    table_row(const double    factor,
              const SorCount &count,
              const SorCount &count_1980,
              const char     *remark)
    {
      const auto text = [](const SorCount &c) {
        return c.reached ? std::to_string(c.iterations)
                         : "> " + std::to_string(c.iterations);
      };
      char row[120];
      std::snprintf(row,
                    sizeof(row),
                    "  %10.4f  %12s  %12s%s",
                    factor,
                    text(count).c_str(),
                    text(count_1980).c_str(),
                    remark);
      return row;
    }
  } // namespace



  template <int dim>
  void
  write_relaxation_table(const Scene             &scene,
                         const Body<dim>         &body,
                         ContactSystemCache<dim> &systems,
                         const StepList          &steps,
                         Log                     &log,
                         const std::string       &directory)
  {
    const SparseMatrix &matrix = systems.system_at(0.).problem().matrix();
    const Vector loads = loads_at(body, instant_of_largest_load(body, steps));
    if (loads.linfty_norm() == 0.)
      throw SceneError(
        "[Contact] Relaxation table: nothing is loaded, so that "
        "there is nothing to iterate for. Set [Loads] or leave "
        "the table empty.");
    const Vector direct =
      elastic_displacement(scene, body, systems, loads, false);
    const double target = residual_norm(matrix, direct, loads);
    const double target_1980 =
      residual_norm(matrix, in_single_precision_of_1980(direct), loads);

    const UnilateralBounds none;
    const SignoriniProblem problem(matrix, none);
    const Sweep            sweep(problem);
    const auto             count = [&](const double factor, const double goal) {
      return sweep.count_iterations(loads,
                                    factor,
                                    goal,
                                    scene.contact.maximum_iterations);
    };

    const double best =
      sweep.best_factor(loads, target_1980, scene.contact.maximum_iterations);
    std::vector<double> factors = scene.contact.relaxation_table;
    factors.push_back(best);
    std::sort(factors.begin(), factors.end());

    char text[160];
    std::snprintf(text,
                  sizeof(text),
                  "  SOR without constraints: iterations to the direct "
                  "solver's residual, %.2e of the largest load",
                  target / loads.linfty_norm());
    log.line("");
    log.line(text);
    std::snprintf(text,
                  sizeof(text),
                  "  (27 bits: to that of its solution with a mantissa of 27 "
                  "bits, %.2e)",
                  target_1980 / loads.linfty_norm());
    log.line(text);
    log.line("      factor    iterations       27 bits");
    const bool is_first_rank =
      Utilities::MPI::this_mpi_process(body.space.communicator()) == 0;
    std::unique_ptr<CsvTable> csv;
    collectively(body.space.communicator(), [&]() {
      if (is_first_rank)
        csv = std::make_unique<CsvTable>(
          directory + "/relaxation.csv",
          std::vector<std::string>{"relaxation_factor",
                                   "iterations",
                                   "iterations_27_bits"});
    });
    for (const double factor : factors)
      {
        const SorCount full = count(factor, target);
        const SorCount past = count(factor, target_1980);
        log.line(table_row(
          factor, full, past, factor == best ? "  (best, by dichotomy)" : ""));
        collectively(body.space.communicator(), [&]() {
          if (is_first_rank)
            csv->add_row(
              {factor,
               full.reached ? double(full.iterations) : std::nan(""),
               past.reached ? double(past.iterations) : std::nan("")});
        });
      }
  }



  template void
  write_relaxation_table<2>(const Scene &,
                            const Body<2> &,
                            ContactSystemCache<2> &,
                            const StepList &,
                            Log &,
                            const std::string &);
  template void
  write_relaxation_table<3>(const Scene &,
                            const Body<3> &,
                            ContactSystemCache<3> &,
                            const StepList &,
                            Log &,
                            const std::string &);
} // namespace Crevasse
