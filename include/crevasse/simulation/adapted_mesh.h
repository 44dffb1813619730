// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_adapted_mesh_h
#define crevasse_simulation_adapted_mesh_h

#include <crevasse/base/summary.h>
#include <crevasse/checkpoint/checkpoints.h>
#include <crevasse/model/body.h>
#include <crevasse/model/refinement.h>
#include <crevasse/time/step_list.h>

namespace Crevasse
{
  /** Estimates of the error on one mesh. */
  struct MeshEstimate
  {
    dealii::types::global_dof_index cells, unknowns;
    double                          error;  ///< relative error of stress
    double                          energy; ///< largest ½∫ s·K⁻¹s
    double                          seconds;
  };

  /** Instants at which errors are estimated: the instants of the scene, or the
   * instant of the largest load and, with thermal strain, some more. */
  template <int dim>
  std::vector<double>
  instants_of_estimate(const Scene     &scene,
                       const Body<dim> &body,
                       const StepList  &steps);

  /**
   * The initial mesh of a run: the mesh of the geometry, refined towards the
   * tip, or adapted to elastic states at some instants of the period. These
   * need no time steps, and their mesh also suits a stress that viscosity has
   * redistributed a little.
   */
  template <int dim>
  class AdaptedMesh
  {
  public:
    /** Creates the mesh. Collective. @throw SceneError or NumericalError.
     *
     * @param checkpoints provide the mesh if a run is resumed. */
    AdaptedMesh(const Scene   &scene,
                const MPI_Comm communicator,
                Log           &log,
                Checkpoints   &checkpoints);

    /** Serialises the estimates and the crack length; the mesh is saved with
     * the fields. */
    void
    serialize(StateArchive &archive);

    std::shared_ptr<Mesh<dim>>
    mesh() const
    {
      return current;
    }

    /** Flags cells for a change of the mesh that Target unknowns allows, if
     * any. Collective.
     *
     * @param squares squared error of each cell.
     * @param n_unknowns of the present mesh.
     * @return whether cells are to be divided. */
    bool
    flag(const dealii::Vector<float> &squares, const double n_unknowns);

    /** Replaces a changed mesh by one with the same cells on each rank, in the
     * order of a checkpoint, so that a resumed run computes the same.
     * Collective. */
    void
    renew();

    /** Replaces the mesh by one with the same cells and a longer crack.
     * Collective. @throw SceneError if that crack needs other cells. */
    void
    grow(const double crack_length);

    /** Length of a built-in crack in the mesh. */
    double
    crack_length() const
    {
      return scene.geometry.crack_length;
    }

    /** Adds "refinement" to summary.json. */
    void
    add_to(Summary &summary) const;

  private:
    /** Estimates errors on the current mesh.
     *
     * @return the squared error of each cell. */
    dealii::Vector<float>
    estimate(Log &quiet);

    /** Whether the last mesh has occurred before, so that adaptation would
     * repeat itself: coarsening may balance refinement. */
    bool
    repeats() const;

    void
    report(Log &log) const;

    /** Adapts the mesh. @return false if it would hardly change. */
    bool
    advance(const dealii::Vector<float> &squares);

    Scene                      scene; ///< scene, with fast solvers
    std::shared_ptr<Mesh<dim>> current;
    /** Estimates on all meshes up to the current one; none: not adapted. */
    std::vector<MeshEstimate> all;
  };
} // namespace Crevasse

#endif
