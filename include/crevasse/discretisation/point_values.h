// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_point_values_h
#define crevasse_discretisation_point_values_h

#include <cstdint>
#include <functional>
#include <map>
#include <type_traits>
#include <utility>
#include <vector>

namespace Crevasse
{
  /** Values at the quadrature points of this rank; a value that points share is
   * stored once: one matrix for a homogeneous body, two for two materials. */
  template <typename Value>
  class PointValues
  {
  public:
    /** Makes the same value for all points. */
    explicit PointValues(const Value &value)
      : values(1, value)
      , uniform(true)
    {
    }

    /** Makes a separate value for each point. */
    explicit PointValues(std::vector<Value> &&values)
      : values(std::move(values))
      , uniform(false)
    {
    }

    /** Makes shared values: point p has the value number @p which[p]. */
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

    /** Distinct values, in no particular order. */
    const std::vector<Value> &
    distinct() const
    {
      return values;
    }

    /** Number of a point's value in distinct(). */
    std::size_t
    index(const std::size_t point) const
    {
      return uniform ? 0 : (which.empty() ? point : which[point]);
    }

    /** Whether each point has a separate value. */
    bool
    is_individual() const
    {
      return !uniform && which.empty();
    }

    std::size_t
    memory_consumption() const
    {
      return values.size() * sizeof(Value) +
             which.size() * sizeof(std::uint32_t);
    }

  private:
    std::vector<Value>         values;
    std::vector<std::uint32_t> which;   ///< empty if uniform or individual
    bool                       uniform; ///< also on a rank without points
  };

  /** Values f(value) at each of n_points points, computed once if shared. */
  template <typename Value, typename Function>
  auto
  transform(const PointValues<Value> &values,
            const std::size_t         n_points,
            const Function           &f)
  {
    using Result = std::decay_t<decltype(f(values[0]))>;
    std::vector<Result> results;
    results.reserve(values.distinct().size());
    for (const Value &value : values.distinct())
      results.push_back(f(value));
    if (values.is_uniform())
      return PointValues<Result>(results.front());
    if (values.is_individual())
      return PointValues<Result>(std::move(results));
    std::vector<std::uint32_t> which(n_points);
    for (std::size_t p = 0; p < n_points; ++p)
      which[p] = values.index(p);
    return PointValues<Result>(std::move(results), std::move(which));
  }

  /** Values f(a, b) at each of n_points points, computed once for each shared
   * pair. */
  template <typename A, typename B, typename Function>
  auto
  combine(const PointValues<A> &a,
          const PointValues<B> &b,
          const std::size_t     n_points,
          const Function       &f)
  {
    using Result = std::decay_t<decltype(f(a[0], b[0]))>;
    if (a.is_uniform() && b.is_uniform())
      return PointValues<Result>(f(a[0], b[0]));
    std::vector<Result> results;
    if (a.is_individual() || b.is_individual())
      {
        results.resize(n_points);
        for (std::size_t p = 0; p < n_points; ++p)
          results[p] = f(a[p], b[p]);
        return PointValues<Result>(std::move(results));
      }
    std::vector<std::uint32_t> which(n_points);
    std::map<std::pair<std::size_t, std::size_t>, std::uint32_t> numbers;
    for (std::size_t p = 0; p < n_points; ++p)
      {
        const auto [number, is_new] =
          numbers.emplace(std::make_pair(a.index(p), b.index(p)),
                          results.size());
        if (is_new)
          results.push_back(f(a[p], b[p]));
        which[p] = number->second;
      }
    return PointValues<Result>(std::move(results), std::move(which));
  }

  /** Sum of two values at each point. */
  template <typename Value>
  PointValues<Value>
  add(const PointValues<Value> &a,
      const PointValues<Value> &b,
      const std::size_t         n_points)
  {
    return combine(a, b, n_points, std::plus<Value>());
  }
} // namespace Crevasse

#endif
