// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_tests_memory_archive_h
#define crevasse_tests_memory_archive_h

#include <crevasse/base/state_archive.h>

#include <deque>

/** Keeps the state of something on one rank. */
class MemoryArchive : public Crevasse::StateArchive
{
public:
  MemoryArchive()
    : StateArchive(MPI_COMM_SELF)
  {
  }

  /** From now on gives back what it was given. */
  void
  turn()
  {
    static_cast<StateArchive &>(*this) =
      StateArchive(MPI_COMM_SELF, bytes(), 1);
  }

  void
  nodal(Crevasse::Vector &field) override
  {
    if (!is_loading())
      fields.push_back(field);
    else
      {
        field = fields.front();
        fields.pop_front();
      }
  }

  void
  at_points(Crevasse::Vector &field) override
  {
    nodal(field);
  }

  void
  on_bounds(std::vector<double> &values) override
  {
    common(values);
  }
  using StateArchive::on_bounds;

  void
  on_cells(dealii::Vector<double> &values) override
  {
    std::vector<double> numbers(values.begin(), values.end());
    common(numbers);
    values = dealii::Vector<double>(numbers.begin(), numbers.end());
  }

private:
  std::deque<Crevasse::Vector> fields;
};

#endif
