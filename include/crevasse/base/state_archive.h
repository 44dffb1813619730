// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_state_archive_h
#define crevasse_base_state_archive_h

#include <crevasse/base/problems.h>
#include <crevasse/base/vector.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>
#include <deal.II/lac/vector.h>

#include <boost/serialization/map.hpp>
#include <boost/serialization/set.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace Crevasse
{
  /**
   * Archive to write the state of a run to or to read it from. Objects
   * serialise their state in a fixed order with one function for both. All
   * functions are collective. Fields need a mesh: see FieldArchive.
   */
  class StateArchive
  {
  public:
    /** Creates an empty archive for writing. */
    explicit StateArchive(const MPI_Comm communicator)
      : mpi_communicator(communicator)
    {
    }

    /** Opens an archive for reading.
     * @param bytes bytes() of the first rank.
     * @param n_ranks number of ranks of the run that wrote the archive. */
    StateArchive(const MPI_Comm     communicator,
                 const std::string &bytes,
                 const unsigned int n_ranks)
      : mpi_communicator(communicator)
      , loads(true)
      , same_ranks(dealii::Utilities::MPI::n_mpi_processes(communicator) ==
                   n_ranks)
      , items(dealii::Utilities::unpack<std::vector<std::vector<char>>>(
          std::vector<char>(bytes.begin(), bytes.end()),
          false))
    {
    }

    virtual ~StateArchive()       = default;
    StateArchive(StateArchive &&) = default;
    StateArchive &
    operator=(StateArchive &&) = default;

    /** Whether the archive is read, and replaces its arguments. */
    bool
    is_loading() const
    {
      return loads;
    }

    /** Whether as many ranks read the archive as wrote it, so that each has the
     * same cells; true while the archive is written. */
    bool
    has_same_ranks() const
    {
      return same_ranks;
    }

    MPI_Comm
    communicator() const
    {
      return mpi_communicator;
    }

    /** Contents written so far, except for fields. */
    std::string
    bytes() const
    {
      const std::vector<char> packed = dealii::Utilities::pack(items, false);
      return {packed.begin(), packed.end()};
    }

    /** Begins a named section of the archive, so that a wrong order of reading
     * is noticed. @throw FileError */
    void
    section(const std::string &name)
    {
      std::string found = name;
      common(found);
      if (found != name)
        throw FileError(
          "The checkpoint does not fit: it has \"" + found + "\" where \"" +
          name + "\" is expected. Another version of the program wrote it.");
    }

    /** Serialises a value that all ranks have alike: a number, a string, a
     * container of these, or a struct of numbers. */
    template <typename T>
    void
    common(T &value)
    {
      std::vector<char> bytes;
      if (!is_loading())
        bytes = dealii::Utilities::pack(value, false);
      exchange(bytes);
      if (is_loading())
        value = dealii::Utilities::unpack<T>(bytes, false);
    }

    /** Serialises a list of structs of numbers that all ranks have alike. */
    template <typename T>
    void
    common_list(std::vector<T> &values)
    {
      static_assert(std::is_trivially_copyable<T>::value,
                    "nothing but numbers is kept of it");
      std::vector<char> bytes(values.size() * sizeof(T));
      if (!bytes.empty())
        std::memcpy(bytes.data(), values.data(), bytes.size());
      exchange(bytes);
      values.resize(bytes.size() / sizeof(T));
      if (!bytes.empty())
        std::memcpy(values.data(), bytes.data(), bytes.size());
    }

    /** Serialises the maximum over the ranks of a number. */
    void
    maximum(double &value)
    {
      double largest = dealii::Utilities::MPI::max(value, communicator());
      common(largest);
      if (is_loading())
        value = largest;
    }

    /** Serialises a field of displacements or nodal forces (see Space). An
     * empty field stays empty. */
    virtual void
    nodal(Vector &)
    {
      AssertThrow(false, dealii::ExcPureFunctionCalled());
    }

    /** Serialises a field at quadrature points with any number of branches (see
     * QuadratureField). An empty field stays empty. */
    virtual void
    at_points(Vector &)
    {
      AssertThrow(false, dealii::ExcPureFunctionCalled());
    }

    /** Serialises a number for each contact bound of this rank, in the order of
     * UnilateralBounds. An empty list stays empty. */
    virtual void
    on_bounds(std::vector<double> &)
    {
      AssertThrow(false, dealii::ExcPureFunctionCalled());
    }

    /** Serialises a flag for each contact bound of this rank. */
    void
    on_bounds(std::vector<bool> &values)
    {
      std::vector<double> numbers(values.begin(), values.end());
      on_bounds(numbers);
      if (is_loading())
        values.assign(numbers.begin(), numbers.end());
    }

    /** Serialises a number for each contact bound of this rank and tangent. */
    void
    on_bounds(std::vector<std::vector<double>> &of_tangents)
    {
      std::size_t n_tangents = of_tangents.size();
      common(n_tangents);
      of_tangents.resize(n_tangents);
      for (std::vector<double> &along : of_tangents)
        on_bounds(along);
    }

    /** Serialises a number for each cell, by active cell index. */
    virtual void
    on_cells(dealii::Vector<double> &)
    {
      AssertThrow(false, dealii::ExcPureFunctionCalled());
    }

  private:
    /** Writes these bytes, or reads the next bytes in the order of writing. The
     * first rank's bytes are used on all ranks. */
    void
    exchange(std::vector<char> &item)
    {
      if (loads)
        item = items.at(next++);
      else
        items.push_back(item);
    }

    MPI_Comm                       mpi_communicator;
    bool                           loads = false, same_ranks = true;
    std::vector<std::vector<char>> items;
    std::size_t                    next = 0; ///< next item to read
  };
} // namespace Crevasse

#endif
