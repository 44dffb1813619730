// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_adapted_mesh_h
#define crevasse_simulation_adapted_mesh_h

#include <crevasse/base/log.h>
#include <crevasse/base/summary.h>
#include <crevasse/checkpoint/checkpoints.h>
#include <crevasse/discretisation/refinement.h>
#include <crevasse/discretisation/stress_estimator.h>
#include <crevasse/model/body.h>
#include <crevasse/parameters/scene.h>
#include <crevasse/time/step_list.h>

#include <memory>
#include <vector>

namespace Crevasse
{
  /** What was estimated on one mesh. */
  struct MeshEstimate
  {
    dealii::types::global_dof_index cells, unknowns;
    double                          error;  ///< relative, of the stress
    double                          energy; ///< ½∫ s·K⁻¹s at the largest
    double                          seconds;
  };

  /** The instants whose errors count: those of the scene, or that of the
   * largest load. With thermal strain, which loads at other times, some more.
   */
  template <int dim>
  std::vector<double>
  instants_of_estimate(const Scene     &scene,
                       const Body<dim> &body,
                       const StepList  &steps);

  /**
   * The mesh that a run begins on: the geometry's, refined towards the tip, or
   * adapted to the elastic states at some instants of the period. Those take
   * no time steps: a mesh that is good for them is good for a stress that
   * viscosity has redistributed a little.
   */
  template <int dim>
  class AdaptedMesh
  {
  public:
    /** Collective. @throw SceneError or NumericalError.
     *
     * @param checkpoints The mesh is that of the resumed run. */
    AdaptedMesh(const Scene   &scene,
                const MPI_Comm communicator,
                Log           &log,
                Checkpoints   &checkpoints);

    /** Shows how the mesh came to be. */
    void
    serialize(StateArchive &archive);

    std::shared_ptr<Mesh<dim>>
    mesh() const;

    /** Flags cells of the mesh for a change that Target unknowns allows.
     * Collective. */
    void
    flag(const dealii::Vector<float> &squares);

    /** Instead of flag(): the mesh stays as it is. */
    void
    keep();

    /** Of the meshes on the way, this one the last; none if nothing was
     * adapted. */
    const std::vector<MeshEstimate> &
    estimates() const;

    /** What all of that took; 0 if nothing was adapted. */
    double
    seconds() const;

    /** summary.json "refinement" */
    void
    add_to(Summary &summary) const;

  private:
    /** Estimates on the mesh that there is.
     *
     * @return the squares for each cell. */
    dealii::Vector<float>
    estimate(Log &quiet);

    void
    report(Log &log) const;

    /** Whether it has no more than Target unknowns. Collective. */
    bool
    is_affordable(const Mesh<dim> &mesh) const;

    /** Sets flags for a change that Target unknowns allows: if the whole one
     * does not, fewer cells are divided. None if that does not help. */
    Marks
    affordable_marks(const dealii::Vector<float> &squares);

    /** Takes the next mesh, unless it would hardly be another one. */
    bool
    advance(const dealii::Vector<float> &squares);

    const Scene                scene; ///< with fast solvers
    MeshHistory<dim>           history;
    std::shared_ptr<Mesh<dim>> current;
    std::vector<MeshEstimate>  all;
    double                     seconds_of_all = 0.;
  };
} // namespace Crevasse

#endif
