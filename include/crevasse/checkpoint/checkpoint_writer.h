// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_checkpoint_checkpoint_writer_h
#define crevasse_checkpoint_checkpoint_writer_h

#include <crevasse/base/checkpointer.h>
#include <crevasse/checkpoint/checkpoints.h>
#include <crevasse/model/body.h>

namespace Crevasse
{
  /**
   * Writes the state of a run as a checkpoint, or takes it over from one: the
   * beginning that Checkpoints knows of, a header, and all SerializationScopes.
   * What all ranks have alike is in common.bin; the mesh and the fields are in
   * the files that Triangulation::save() writes.
   */
  template <int dim>
  class CheckpointWriter : public Checkpointer
  {
  public:
    /** All arguments must outlive this object.
     *
     * @param n_stresses the fields of a stress that a checkpoint may have.
     * @param last_period after which more periods may be wanted: then there
     * is a checkpoint; 0: never.
     * @param header which a resumed run has read already. */
    CheckpointWriter(Checkpoints                  &checkpoints,
                     const Body<dim>              &body,
                     const unsigned int            n_stresses,
                     const unsigned int            last_period,
                     const Checkpoints::Serialize &header);

    /** @throw StoppedOnRequest if that is asked for, with a checkpoint. */
    void
    between_steps(const unsigned int period, const unsigned int step) override;

    /** Keeps what a run with more periods can resume from. */
    void
    at_end_of_search(const unsigned int period) override;

  private:
    void
    resume();

    /** @return whether it could be written; if not, the log has the reason. */
    bool
    write(const unsigned int period, const unsigned int step);

    Checkpoints                 &checkpoints;
    const Body<dim>             &body;
    const unsigned int           last_period;
    const Checkpoints::Serialize header;
    std::vector<std::size_t>     bytes_of_cells; ///< in the last checkpoint
  };
} // namespace Crevasse

#endif
