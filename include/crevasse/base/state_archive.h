// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_state_archive_h
#define crevasse_base_state_archive_h

#include <crevasse/base/vector.h>

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
   * What the state of a run is written to, or read from: objects show what
   * they have, always in the same order, and one function of theirs serves for
   * both. Fields do not depend on which rank has which cells, so that another
   * number of ranks can go on. All functions are collective.
   */
  class StateArchive
  {
  public:
    virtual ~StateArchive() = default;

    /** Whether values are read: they replace those that are shown. */
    virtual bool
    is_loading() const = 0;

    /** Whether it is read by as many ranks as wrote it, so that what depends
     * on who has which cells is the same; true while it is written. */
    virtual bool
    has_same_ranks() const = 0;

    virtual MPI_Comm
    communicator() const = 0;

    /** The place of what follows, so that what does not belong together is
     * noticed. @throw FileError */
    void
    section(const std::string &name);

    /** A value that all ranks have alike: a number, a string, a container of
     * such, or a struct of numbers. */
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

    /** The same for many structs of numbers. */
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

    /** A number of each rank of which only the largest of all matters. */
    void
    maximum(double &value);

    /** A number of each rank of which only the sum matters. */
    void
    part_of_sum(double &value);

    /** A field of displacements or nodal forces: see Space. If it is empty it
     * stays so. */
    virtual void
    nodal(Vector &field) = 0;

    /** A field at quadrature points, with any number of branches: see
     * QuadratureField. If it is empty it stays so. */
    virtual void
    at_points(Vector &field) = 0;

    /** A number for each bound of this rank, in the order of
     * UnilateralBounds. If they are empty they stay so. */
    virtual void
    on_bounds(std::vector<double> &values) = 0;

    /** The same for what is true or false of each. */
    void
    on_bounds(std::vector<bool> &values);

    /** A number for each cell, by active cell index. */
    virtual void
    on_cells(dealii::Vector<double> &values) = 0;

  protected:
    /** Takes these bytes, or gives back those that were taken in their
     * turn. The first rank's are those of all. */
    virtual void
    exchange(std::vector<char> &bytes) = 0;
  };
} // namespace Crevasse

#endif
