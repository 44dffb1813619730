// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/postprocess/problem_export.h>

#include <deal.II/base/mpi.h>

#include <EpetraExt_MultiVectorOut.h>
#include <EpetraExt_RowMatrixOut.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <Epetra_MultiVector.h>
#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  ProblemExport::ProblemExport(const CurrentProblem &problem,
                               const RecordedSteps  &steps,
                               Log                  &log,
                               const std::string    &directory)
    : problem(problem)
    , missing(steps)
    , log(log)
    , directory(directory)
  {
  }



  void
  ProblemExport::observe(const Sample &sample)
  {
    if (missing.erase({sample.period, sample.step}) == 0)
      return;
    const std::string name = "contact_problem_" +
                             std::to_string(sample.period) + '_' +
                             std::to_string(sample.step);
    TrilinosWrappers::SparseMatrix matrix;
    matrix.copy_from(problem().matrix());
    matrix *= sample.state.stiffness_factor;
    const SignoriniProblem scaled(matrix, problem().bounds);
    write_matrix_market(scaled,
                        sample.right_hand_side,
                        sample.state.displacement,
                        directory + '/' + name);
    write_petsc_binary(scaled,
                       sample.right_hand_side,
                       sample.state.displacement,
                       directory + '/' + name);
    log.line("  wrote " + name + "_*.mtx, " + name + ".petsc");
  }



  void
  ProblemExport::serialize(StateArchive &archive)
  {
    archive.section("contact problems");
    archive.common(missing);
  }



  void
  ProblemExport::summarise(Summary &)
  {
    for (const auto &[period, step] : missing)
      log.line("  [Output] Contact problems: the run did not come to period " +
               std::to_string(period) + ", step " + std::to_string(step));
  }



  namespace
  {
    void
    require_written(const int error, const std::string &file_name)
    {
      if (error != 0)
        throw FileError("Cannot write " + file_name + ".");
    }



    void
    write_columns(const Epetra_Map          &map,
                  const std::vector<double> &columns,
                  const unsigned int         n_columns,
                  const std::string         &file_name,
                  const char                *what)
    {
      // An empty rank has no data to point to.
      double  nothing = 0.;
      double *data =
        columns.empty() ? &nothing : const_cast<double *>(columns.data());
      Epetra_MultiVector view(
        View, map, data, std::max(map.NumMyElements(), 1), n_columns);
      require_written(EpetraExt::MultiVectorToMatrixMarketFile(
                        file_name.c_str(), view, what, "", true),
                      file_name);
    }
  } // namespace



  void
  write_matrix_market(const SignoriniProblem &problem,
                      const Vector           &right_hand_side,
                      const Vector           &solution,
                      const std::string      &name)
  {
    const Epetra_CrsMatrix &matrix = problem.matrix().trilinos_matrix();
    require_written(
      EpetraExt::RowMatrixToMatrixMarketFile(
        (name + "_matrix.mtx").c_str(), matrix, "stiffness A", "", true),
      name + "_matrix.mtx");
    const Epetra_Map &map = problem.matrix().trilinos_matrix().RowMap();
    write_columns(map,
                  {right_hand_side.begin(), right_hand_side.end()},
                  1,
                  name + "_right_hand_side.mtx",
                  "right-hand side b");
    write_columns(map,
                  {solution.begin(), solution.end()},
                  1,
                  name + "_solution.mtx",
                  "solution q");

    const UnilateralBounds &bounds = problem.bounds;
    std::vector<double>     table(bounds.dofs.begin(), bounds.dofs.end());
    table.insert(table.end(), bounds.sign.begin(), bounds.sign.end());
    table.insert(table.end(), bounds.gap.begin(), bounds.gap.end());
    const Epetra_Map rows(-1, int(bounds.dofs.size()), 0, matrix.Comm());
    write_columns(
      rows, table, 3, name + "_lip.mtx", "columns: dof (from 0), sign, gap");
  }
} // namespace Crevasse
