// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_lip_history_h
#define crevasse_time_lip_history_h

#include <crevasse/contact/signorini_problem.h>
#include <crevasse/time/stages.h>
#include <crevasse/time/state.h>

#include <deal.II/base/mpi.h>

namespace Crevasse
{
  /** Openings and contact forces of the bounds at the instants of a period. If
   * an instant is evaluated several times, the last one counts. */
  class LipHistory
  {
  public:
    using LipVector = dealii::Vector<double>;

    /** @param bounds must outlive the LipHistory. */
    explicit LipHistory(const UnilateralBounds &bounds)
      : bounds(bounds)
    {
    }

    /** Records what was solved at the instant @p t of the period. */
    void
    record(const double t, const State &state)
    {
      std::vector<double> &row = rows[t];
      row.clear();
      for (std::size_t k = 0; k < bounds.dofs.size(); ++k)
        {
          row.push_back(bounds.sign[k] * state.displacement(bounds.dofs[k]) -
                        bounds.gap[k]);
          row.push_back(state.contact_forces.normal[k] /
                        state.stiffness_factor);
        }
    }

    /** Values of each stage, for the bounds of all ranks. */
    struct OnLip
    {
      std::vector<LipVector> openings; ///< L q − gap
      std::vector<LipVector> forces;   ///< g divided by the stiffness factor

      void
      serialize(StateArchive &archive)
      {
        for (auto *values : {&openings, &forces})
          {
            std::size_t n = values->size();
            archive.common(n);
            values->resize(n);
            for (LipVector &value : *values)
              {
                std::vector<double> numbers(value.begin(), value.end());
                archive.common(numbers);
                value = LipVector(numbers.begin(), numbers.end());
              }
          }
      }
    };

    /** Makes all ranks know the lip at the stages, whose instants were
     * recorded, and forgets the period. Collective. */
    OnLip
    take(const Stages &stages, const MPI_Comm communicator)
    {
      OnLip all;
      for (const double t : stages.instants)
        {
          auto row = rows.lower_bound(t);
          if (row == rows.end() || (row != rows.begin() &&
                                    t - std::prev(row)->first < row->first - t))
            --row;
          LipVector          *values[] = {&all.openings.emplace_back(),
                                          &all.forces.emplace_back()};
          std::vector<double> of_all;
          for (const std::vector<double> &of_rank :
               dealii::Utilities::MPI::all_gather(communicator, row->second))
            of_all.insert(of_all.end(), of_rank.begin(), of_rank.end());
          for (unsigned int part = 0; part < 2; ++part)
            {
              values[part]->reinit(of_all.size() / 2);
              for (unsigned int k = 0; k < values[part]->size(); ++k)
                (*values[part])(k) = of_all[2 * k + part];
            }
        }
      rows.clear();
      return all;
    }

    void
    serialize(StateArchive &archive)
    {
      archive.section("lip history");
      std::vector<double> instants, column(bounds.dofs.size());
      for (const auto &row : rows)
        instants.push_back(row.first);
      archive.common(instants);
      for (const double t : instants)
        {
          std::vector<double> &row = rows[t];
          row.resize(2 * column.size());
          for (unsigned int part = 0; part < 2; ++part)
            {
              for (std::size_t k = 0; k < column.size(); ++k)
                column[k] = row[2 * k + part];
              archive.on_bounds(column);
              for (std::size_t k = 0; k < column.size(); ++k)
                row[2 * k + part] = column[k];
            }
        }
    }

  private:
    const UnilateralBounds               &bounds;
    std::map<double, std::vector<double>> rows; ///< by instant
  };
} // namespace Crevasse

#endif
