// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#ifndef crevasse_discretisation_point_values_h
#define crevasse_discretisation_point_values_h

#include <cstdint>
#include <utility>
#include <vector>

namespace Crevasse
{
  /** A value for each quadrature point of this rank, stored once where points
   * share it: one matrix for a homogeneous body, two for two materials. */
  template <typename Value>
  class PointValues
  {
  public:
    /** The same value everywhere. */
    explicit PointValues(const Value &value)
      : values(1, value)
      , uniform(true)
    {
    }

    /** Each point has its own. */
    explicit PointValues(std::vector<Value> &&values)
      : values(std::move(values))
      , uniform(false)
    {
    }

    /** For point p the value @p which[p]. */
    PointValues(std::vector<Value> &&values, std::vector<std::uint32_t> &&which)
      : values(std::move(values))
      , which(std::move(which))
      , uniform(false)
    {
    }

    const Value &
    operator[](const std::size_t point) const
    {
      return values[index(point)];
    }

    bool
    is_uniform() const
    {
      return uniform;
    }

    /** The values that occur, in no particular order. */
    const std::vector<Value> &
    distinct() const
    {
      return values;
    }

    /** Which of these a point has. */
    std::size_t
    index(const std::size_t point) const
    {
      return uniform ? 0 : (which.empty() ? point : which[point]);
    }

    std::size_t
    memory_consumption() const
    {
      return values.size() * sizeof(Value) +
             which.size() * sizeof(std::uint32_t);
    }

  private:
    std::vector<Value>         values;
    std::vector<std::uint32_t> which;   ///< empty: one for all or for each
    bool                       uniform; ///< also on a rank without points
  };
} // namespace Crevasse

#endif
