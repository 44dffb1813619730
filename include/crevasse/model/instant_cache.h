// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_model_instant_cache_h
#define crevasse_model_instant_cache_h

#include <crevasse/base/log.h>

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace Crevasse
{
  /** Limit of the memory for cached values of instants, over all ranks and all
   * caches together. */
  class InstantMemory
  {
  public:
    /** @p log must outlive the InstantMemory. */
    InstantMemory(const MPI_Comm communicator, const double bytes, Log &log)
      : communicator(communicator)
      , limit(bytes)
      , log(log)
    {
    }

    /** Registers a function for the memory of a cache on this rank: contact
     * solvers grow. */
    void
    count(const std::function<std::size_t()> &bytes_kept)
    {
      caches.push_back(bytes_kept);
    }

    /** Whether so many more bytes on this rank may be cached; false ever after
     * one refusal. Collective. */
    bool
    grants(const std::size_t bytes)
    {
      if (is_full)
        return false;
      std::size_t all = bytes;
      for (const auto &bytes_kept : caches)
        all += bytes_kept();
      is_full = dealii::Utilities::MPI::sum(double(all), communicator) > limit;
      if (is_full)
        log.line(
          "  memory: [Linear solver] Memory for instants is used up; data of "
          "the other instants are computed again in each period");
      return !is_full;
    }

  private:
    const MPI_Comm                            communicator;
    const double                              limit;
    Log                                      &log;
    std::vector<std::function<std::size_t()>> caches;
    bool                                      is_full = false;
  };

  /**
   * Caches values of instants for the same instants of later periods, as long
   * as the memory lasts; other values are recomputed each time. The first
   * values are kept: as instants come in turn, dropping the oldest would always
   * drop the next.
   */
  template <typename Value>
  class InstantCache
  {
  public:
    /** Instant and second argument of a value: κ of AlgorithmicModuli. */
    using Key  = std::pair<double, double>;
    using Make = std::function<std::shared_ptr<Value>()>;

    /** @param drop called with a value that will be recomputed later.
     * @param bytes function for the memory of a value on this rank. */
    InstantCache(
      InstantMemory                                   &memory,
      const std::function<void(const Value &)>        &drop = {},
      const std::function<std::size_t(const Value &)> &bytes =
        [](const Value &value) { return value.memory_consumption(); })
      : memory(memory)
      , bytes(bytes)
      , drop(drop)
    {
      memory.count([this]() {
        std::size_t sum = 0;
        for (const auto &[key, value] : kept)
          sum += this->bytes(*value);
        return sum;
      });
    }

    InstantCache(const InstantCache &) = delete;

    /** The value of an instant, computed if need be. Collective. */
    std::shared_ptr<Value>
    at(const Key &key, const Make &make)
    {
      const auto found =
        kept.lower_bound({key.first, key.second * (1. - rounding)});
      if (found != kept.end() && are_equal(found->first, key))
        return found->second;
      if (scratch != nullptr && are_equal(scratch_key, key))
        return scratch;

      std::shared_ptr<Value> value = make();
      if (memory.grants(bytes(*value)))
        return kept.emplace(key, std::move(value)).first->second;
      if (scratch != nullptr && drop)
        drop(*scratch);
      scratch     = std::move(value);
      scratch_key = key;
      return scratch;
    }

    /** Keys of all present values. */
    std::vector<Key>
    keys() const
    {
      std::vector<Key> all;
      for (const auto &entry : kept)
        all.push_back(entry.first);
      if (scratch != nullptr)
        all.push_back(scratch_key);
      return all;
    }

    /** Calls @p show for all present values. */
    template <typename Function>
    void
    for_each(const Function &show) const
    {
      for (const auto &[key, value] : kept)
        show(*value);
      if (scratch != nullptr)
        show(*scratch);
    }

  private:
    /** Relative rounding of equal κ, as equal steps differ by rounding. */
    static constexpr double rounding = 1e-12;

    static bool
    are_equal(const Key &a, const Key &b)
    {
      return a.first == b.first &&
             std::abs(a.second - b.second) <= rounding * std::abs(b.second);
    }

    InstantMemory                                  &memory;
    const std::function<std::size_t(const Value &)> bytes;
    const std::function<void(const Value &)>        drop;

    std::map<Key, std::shared_ptr<Value>> kept;
    std::shared_ptr<Value>                scratch; ///< value that is not kept
    Key                                   scratch_key;
  };
} // namespace Crevasse

#endif
