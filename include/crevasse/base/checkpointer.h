// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_checkpointer_h
#define crevasse_base_checkpointer_h

#include <crevasse/base/state_archive.h>

#include <functional>

namespace Crevasse
{
  /**
   * Saves, stops or resumes a run between two time steps. Parts of the state of
   * the run register with a SerializationScope.
   */
  class Checkpointer
  {
  public:
    virtual ~Checkpointer() = default;

    /** Called between two time steps. When a run resumes, the parts of the
     * state are replaced. Collective.
     *
     * @param period Current period, 1 for the first.
     * @param step Next time step of the period, 0 for the first. */
    virtual void
    between_steps(const unsigned int period, const unsigned int step) = 0;

    /** Called at the end of the search for the periodic state, with the parts
     * of the state as if the next period began. Collective.
     *
     * @param has_converged false: the search ran out of periods. */
    virtual void
    at_end_of_search(const unsigned int period, const bool has_converged) = 0;

  protected:
    /** Serialises all parts of the state in the order of registration. */
    void
    serialize_parts(StateArchive &archive) const
    {
      for (const auto &serialize : parts)
        serialize(archive);
    }

  private:
    friend class SerializationScope;

    std::vector<std::function<void(StateArchive &)>> parts;
  };

  /** Registers a part of the state of the run during its life. */
  class SerializationScope
  {
  public:
    /** @param checkpointer May be null: nothing is registered. */
    SerializationScope(Checkpointer                              *checkpointer,
                       const std::function<void(StateArchive &)> &serialize)
      : checkpointer(checkpointer)
    {
      if (checkpointer != nullptr)
        checkpointer->parts.push_back(serialize);
    }

    ~SerializationScope()
    {
      // Parts are unregistered in reverse order of registration.
      if (checkpointer != nullptr)
        checkpointer->parts.pop_back();
    }

    SerializationScope(const SerializationScope &) = delete;

  private:
    Checkpointer *const checkpointer;
  };
} // namespace Crevasse

#endif
