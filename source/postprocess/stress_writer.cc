// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/discretisation/cell_values.h>
#include <crevasse/postprocess/stress_writer.h>

#include <deal.II/grid/cell_id.h>

#include <fstream>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    template <typename Number>
    void
    write(std::ofstream &file, const std::vector<Number> &values)
    {
      file.write(reinterpret_cast<const char *>(values.data()),
                 values.size() * sizeof(Number));
    }



    /** Those of all ranks, on the first one. */
    template <typename Number>
    void
    write_all(std::ofstream             &file,
              const std::vector<Number> &values,
              const MPI_Comm             communicator)
    {
      for (const auto &theirs : Utilities::MPI::gather(communicator, values))
        write(file, theirs);
    }
  } // namespace



  template <int dim>
  StressWriter<dim>::StressWriter(const Body<dim>   &body,
                                  const std::string &file_name)
    : body(body)
    , file_name(file_name)
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
  void
  StressWriter<dim>::summarise(Summary &)
  {
    CellValues<dim> cell_values(body.space, update_quadrature_points);
    std::vector<CellId::binary_type> cells;
    std::vector<double>              coordinates;
    for (const auto &cell : body.space.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const Point<dim> &point :
             cell_values.reinit(cell).get_quadrature_points())
          {
            cells.push_back(cell->id().template to_binary<dim>());
            coordinates.insert(coordinates.end(),
                               point.begin_raw(),
                               point.end_raw());
          }
    static_assert(sizeof(CellId::binary_type) == 16, "see above");

    const MPI_Comm communicator = body.space.communicator();
    const bool     writes = Utilities::MPI::this_mpi_process(communicator) == 0;
    std::ofstream  file;
    if (writes)
      {
        constexpr std::uint64_t mark = 0x3253534552545343; // "CSTRESS2"
        file.open(file_name, std::ios::binary);
        write(file,
              std::vector<std::uint64_t>{mark,
                                         dim,
                                         body.points.n_points(),
                                         n_stress_components<dim>,
                                         instants.size()});
        write(file, instants);
      }
    // All ranks go on together, whatever becomes of the file.
    write_all(file, cells, communicator);
    write_all(file, coordinates, communicator);
    for (std::size_t k = 0; k < instants.size(); ++k)
      write_all(file, samples[k], communicator);
    file.close();
    collectively(communicator, [&]() {
      if (writes && !file)
        throw FileError("Cannot write " + file_name + ": is the disk full?");
    });
  }



  template class StressWriter<2>;
  template class StressWriter<3>;
} // namespace Crevasse
