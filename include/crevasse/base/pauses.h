// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_pauses_h
#define crevasse_base_pauses_h

#include <crevasse/base/state_archive.h>

#include <functional>
#include <vector>

namespace Crevasse
{
  /**
   * The moments between two steps: there a run may be kept, left, or taken up
   * where another one was left. What the state of the run consists of makes
   * itself known as a StatePart.
   */
  class Pauses
  {
  public:
    virtual ~Pauses() = default;

    /** Between two steps; all parts may be other ones afterwards. Collective.
     *
     * @param period 1 for the first.
     * @param step that comes next, 0 for the first. */
    virtual void
    between_steps(const unsigned int period, const unsigned int step) = 0;

    /** Where the first step of a period would begin if there were one more:
     * all parts are as if there were. Collective. */
    virtual void
    before_what_is_not_computed(const unsigned int period) = 0;

  protected:
    /** Shows all parts, in the order in which they became known. */
    void
    serialize_parts(StateArchive &archive) const;

  private:
    friend class StatePart;

    std::vector<std::function<void(StateArchive &)>> parts;
  };

  /** Belongs to the state of the run as long as it lives. */
  class StatePart
  {
  public:
    /** @param pauses null: nobody asks. */
    StatePart(Pauses                                    *pauses,
              const std::function<void(StateArchive &)> &serialize);

    ~StatePart();

    StatePart(const StatePart &) = delete;
    StatePart &
    operator=(const StatePart &) = delete;

  private:
    Pauses *const pauses;
  };
} // namespace Crevasse

#endif
