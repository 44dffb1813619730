// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/discretisation/cell_values.h>
#include <crevasse/study/stress_reader.h>
#include <crevasse/study/stress_writer.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/cell_id.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <numeric>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    void
    write_numbers(std::ofstream &file, const std::vector<double> &values)
    {
      file.write(reinterpret_cast<const char *>(values.data()),
                 values.size() * sizeof(double));
    }
  } // namespace



  template <int dim>
  StressWriter<dim>::StressWriter(const Body<dim> &body, const double period)
    : body(body)
    , period(period)
  {
  }



  template <int dim>
  void
  StressWriter<dim>::observe(const Sample &sample)
  {
    if (sample.step == 0)
      instants.clear();
    const std::size_t k = instants.size();
    instants.push_back(sample.instant);
    if (samples.size() <= k)
      samples.emplace_back();
    const Vector &stress = sample.state.stress;
    samples[k].assign(stress.begin(), stress.end());
  }



  template <int dim>
  std::vector<typename StressWriter<dim>::PointsOfCell>
  StressWriter<dim>::cells_in_order() const
  {
    std::vector<std::pair<CellId::binary_type, std::size_t>> mine;
    for (const auto &cell : body.space.mesh().active_cell_iterators())
      if (cell->is_locally_owned())
        mine.emplace_back(cell->id().template to_binary<dim>(),
                          body.space.quadrature(cell).size());

    std::vector<std::pair<CellId, PointsOfCell>> cells;
    std::size_t                                  first = 0;
    for (const auto &theirs :
         Utilities::MPI::gather(body.space.communicator(), mine))
      for (const auto &[id, n_points] : theirs)
        {
          cells.push_back({CellId(id), {first, n_points}});
          first += n_points;
        }
    std::sort(cells.begin(), cells.end(), [](const auto &a, const auto &b) {
      return a.first < b.first;
    });
    std::vector<PointsOfCell> points;
    for (const auto &[id, of_cell] : cells)
      points.push_back(of_cell);
    return points;
  }



  template <int dim>
  std::vector<double>
  StressWriter<dim>::gather(const std::vector<double>       &values,
                            const std::vector<PointsOfCell> &cells) const
  {
    std::vector<double> all;
    for (const auto &theirs :
         Utilities::MPI::gather(body.space.communicator(), values))
      all.insert(all.end(), theirs.begin(), theirs.end());
    if (cells.empty())
      return all;

    const std::size_t   n = all.size() / body.points.n_points(); // of a point
    std::vector<double> sorted;
    sorted.reserve(all.size());
    for (const PointsOfCell &cell : cells)
      sorted.insert(sorted.end(),
                    all.begin() + cell.first * n,
                    all.begin() + (cell.first + cell.n_points) * n);
    return sorted;
  }



  template <int dim>
  std::vector<double>
  StressWriter<dim>::coordinates() const
  {
    CellValues<dim>     cell_values(body.space, update_quadrature_points);
    std::vector<double> all;
    for (const auto &cell : body.space.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        for (const Point<dim> &point :
             cell_values.reinit(cell).get_quadrature_points())
          all.insert(all.end(), point.begin_raw(), point.end_raw());
    return all;
  }



  template <int dim>
  void
  StressWriter<dim>::write(const std::string &file_name) const
  {
    if (instants.empty())
      return;
    StressRecordHeader header;
    header.dimension    = dim;
    header.n_points     = body.points.n_points();
    header.n_components = n_stress_components<dim>;
    header.n_samples    = instants.size();
    header.period       = period;

    const MPI_Comm communicator = body.space.communicator();
    const bool     writes = Utilities::MPI::this_mpi_process(communicator) == 0;
    const std::string part = file_name + ".part";
    std::ofstream     file;
    if (writes)
      {
        file.open(part, std::ios::binary);
        file.write(reinterpret_cast<const char *>(&header), sizeof(header));
        write_numbers(file, instants);
      }
    // All ranks go on together, whatever becomes of the file.
    const std::vector<PointsOfCell> cells = cells_in_order();
    write_numbers(file, gather(coordinates(), cells));
    for (std::size_t k = 0; k < instants.size(); ++k)
      write_numbers(file, gather(samples[k], cells));
    file.close();
    collectively(communicator, [&]() {
      if (writes &&
          (!file || std::rename(part.c_str(), file_name.c_str()) != 0))
        throw FileError("Cannot write " + file_name + ": is the disk full?");
    });
  }



  template class StressWriter<2>;
  template class StressWriter<3>;
} // namespace Crevasse
