// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_stress_writer_h
#define crevasse_postprocess_stress_writer_h

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/discretisation/cell_values.h>
#include <crevasse/model/body.h>
#include <crevasse/time/observer.h>

#include <deal.II/grid/cell_id.h>

#include <fstream>

namespace Crevasse
{
  /**
   * stress_samples.bin: the stress at all quadrature points at the instants of
   * the last period, for the errors of a sweep (sweep_errors.py). The file has
   * five integers of 64 bits, a mark and the numbers of dimensions, points,
   * stress components and instants, and then, in numbers of 64 bits,
   *
   * - the instants within the period,
   * - two integers for each point: the id of its cell,
   * - the coordinates of each point,
   * - for each instant the stress at each point.
   *
   * Points of all ranks follow each other; the ids of cells allow to sort the
   * points of runs on other numbers of ranks.
   */
  template <int dim>
  class StressWriter : public Observer
  {
  public:
    /** @p body must outlive the StressWriter. */
    StressWriter(const Body<dim> &body, const std::string &file_name)
      : body(body)
      , file_name(file_name)
    {
    }

    void
    observe(const Sample &sample) override
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

    /** Writes the file if anything was computed. Collective.
     * @throw FileError */
    void
    finish() override
    {
      CellValues<dim> cell_values(body.space, dealii::update_quadrature_points);
      std::vector<dealii::CellId::binary_type> cells;
      std::vector<double>                      coordinates;
      for (const auto &cell : owned_cells(body.space.dof_handler))
        for (const dealii::Point<dim> &point :
             cell_values.reinit(cell).get_quadrature_points())
          {
            cells.push_back(cell->id().template to_binary<dim>());
            coordinates.insert(coordinates.end(),
                               point.begin_raw(),
                               point.end_raw());
          }
      static_assert(sizeof(dealii::CellId::binary_type) == 16, "see above");

      const MPI_Comm communicator = body.space.communicator();
      const bool     writes =
        dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
      std::ofstream file;
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
      // All ranks continue together, even if writing fails.
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

  private:
    template <typename Number>
    static void
    write(std::ofstream &file, const std::vector<Number> &values)
    {
      file.write(reinterpret_cast<const char *>(values.data()),
                 values.size() * sizeof(Number));
    }

    /** Writes the values of all ranks on the first rank. */
    template <typename Number>
    static void
    write_all(std::ofstream             &file,
              const std::vector<Number> &values,
              const MPI_Comm             communicator)
    {
      for (const auto &theirs :
           dealii::Utilities::MPI::gather(communicator, values))
        write(file, theirs);
    }

    const Body<dim>                 &body;
    const std::string                file_name;
    std::vector<double>              instants;
    std::vector<std::vector<double>> samples; ///< samples, ≥ one an instant
  };
} // namespace Crevasse

#endif
