// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_adaptive_run_h
#define crevasse_simulation_adaptive_run_h

#include <crevasse/model/state_transfer.h>
#include <crevasse/simulation/adapted_mesh.h>
#include <crevasse/simulation/run.h>

namespace Crevasse
{
  /**
   * Computes a run from its scene to its results, on one or several meshes: the
   * initial mesh, and stages of some periods, after which the mesh is adapted
   * to the last period and the state is transferred.
   */
  template <int dim>
  class AdaptiveRun
  {
  public:
    /** Checks the scene and logs effects, sizes and predicted memory; computes
     * only elastic states to which the mesh is adapted. Collective.
     *
     * @param checkpoints of the run, which it resumes from if they say so; must
     * outlive the AdaptiveRun. */
    AdaptiveRun(const Scene   &scene,
                const MPI_Comm communicator,
                Log           &log,
                Checkpoints   &checkpoints);

    /** Computes the run and writes its results to the directory of the
     * checkpoints, which must exist. Collective.
     *
     * @throw NumericalError; if the periodic state was not reached, after all
     * results are written. */
    void
    run();

    /** The present mesh. */
    std::shared_ptr<const Mesh<dim>>
    mesh() const
    {
      return adapted.mesh();
    }

  private:
    /** Serialises the summary of the meshes. */
    void
    serialize_summary(StateArchive &archive);

    /** Adapts the mesh to estimated errors. */
    void
    readapt();

    /** Lets the crack grow to its next length. */
    void
    grow();

    /** Changes the mesh, creates a new run on it, and transfers the fields. */
    void
    change_mesh(const std::function<void(StateTransfer<dim> &)> &change);

    RunState                  state; ///< state, with its timer
    const Stopwatch           watch{all_else};
    Scene                     scene; ///< with the present crack length
    Log                      &log;
    Checkpoints              &checkpoints;
    AdaptedMesh<dim>          adapted;
    std::unique_ptr<Run<dim>> on_mesh;
    Summary                   summary; ///< summary of meshes
  };
} // namespace Crevasse

#endif
