// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_checkpointer_h
#define crevasse_base_checkpointer_h

#include <crevasse/base/state_archive.h>

#include <functional>

namespace Crevasse
{
  /**
   * The moments between two steps: there a run may be saved, left, or resumed
   * where another one was left. What the state of the run consists of makes
   * itself known as a SerializationScope.
   */
  class Checkpointer
  {
  public:
    virtual ~Checkpointer() = default;

    /** Between two steps; all parts may be other ones afterwards. Collective.
     *
     * @param period 1 for the first.
     * @param step that comes next, 0 for the first. */
    virtual void
    between_steps(const unsigned int period, const unsigned int step) = 0;

    /** Where the first step of a period would begin if there were one more:
     * all parts are as if there were. Collective.
     *
     * @param has_converged false: the search ran out of periods. */
    virtual void
    at_end_of_search(const unsigned int period, const bool has_converged) = 0;

  protected:
    /** Shows all parts, in the order in which they became known. */
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

  /** Belongs to the state of the run as long as it lives. */
  class SerializationScope
  {
  public:
    /** @param checkpointer null: nobody asks. */
    SerializationScope(Checkpointer                              *checkpointer,
                       const std::function<void(StateArchive &)> &serialize)
      : checkpointer(checkpointer)
    {
      if (checkpointer != nullptr)
        checkpointer->parts.push_back(serialize);
    }

    ~SerializationScope()
    {
      // They go in the order opposite to that in which they came.
      if (checkpointer != nullptr)
        checkpointer->parts.pop_back();
    }

    SerializationScope(const SerializationScope &) = delete;
    SerializationScope &
    operator=(const SerializationScope &) = delete;

  private:
    Checkpointer *const checkpointer;
  };
} // namespace Crevasse

#endif
