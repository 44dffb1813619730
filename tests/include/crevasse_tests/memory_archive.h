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
  /** From now on gives back what it was given. */
  void
  turn()
  {
    loads = true;
  }

  bool
  is_loading() const override
  {
    return loads;
  }

  bool
  has_same_ranks() const override
  {
    return true;
  }

  MPI_Comm
  communicator() const override
  {
    return MPI_COMM_SELF;
  }

  void
  nodal(Crevasse::Vector &field) override
  {
    if (!loads)
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

protected:
  void
  exchange(std::vector<char> &bytes) override
  {
    if (!loads)
      items.push_back(bytes);
    else
      {
        bytes = items.front();
        items.pop_front();
      }
  }

private:
  bool                          loads = false;
  std::deque<std::vector<char>> items;
  std::deque<Crevasse::Vector>  fields;
};

#endif
