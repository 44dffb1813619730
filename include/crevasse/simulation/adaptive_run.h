// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_adaptive_run_h
#define crevasse_simulation_adaptive_run_h

#include <crevasse/simulation/adapted_mesh.h>
#include <crevasse/simulation/workspace.h>
#include <crevasse/time/observer.h>

namespace Crevasse
{
  /**
   * A run from its scene to its results, on one mesh or on several: the mesh
   * that it begins on, and stages of some periods between which the mesh is
   * adapted to the last of them and the state taken over.
   */
  template <int dim>
  class AdaptiveRun
  {
  public:
    /** Finds what is wrong with the scene; computes nothing but elastic states
     * that the mesh is adapted to. Collective.
     *
     * @param checkpoints which it writes, and which it goes on from if they
     * say so; they must outlive this object. */
    AdaptiveRun(const Scene   &scene,
                const MPI_Comm communicator,
                Log           &log,
                Checkpoints   &checkpoints);

    /** Prints effects, sizes and predicted memory. */
    void
    describe() const;

    /** Computes the run and writes everything to the directory, which must
     * exist. Collective.
     *
     * @param stress_record see StressWriter.
     * @throw NumericalError; after all that was computed has been written if
     * the periodic state was not reached. */
    void
    run(const std::string &directory, const bool stress_record = false);

  private:
    /** Shows what is known about the meshes. */
    void
    serialize_summary(StateArchive &archive);

    /** Adapts the mesh to what was estimated, makes everything anew on it, and
     * takes the fields over. */
    void
    readapt(const dealii::Vector<float> &squares, const double error);

    RunState                             state; ///< timed from here on
    const Stopwatch                      watch{all_else};
    const Scene                          scene;
    Log                                 &log;
    Checkpoints                         &checkpoints;
    AdaptedMesh<dim>                     adapted;
    std::unique_ptr<const RunSetup<dim>> setup;
    Summary                              summary; ///< about the meshes
  };
} // namespace Crevasse

#endif
