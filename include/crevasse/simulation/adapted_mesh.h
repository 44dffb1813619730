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

    /** Shows what was estimated; the mesh is saved with the fields. */
    void
    serialize(StateArchive &archive);

    std::shared_ptr<Mesh<dim>>
    mesh() const
    {
      return current;
    }

    /** Flags cells of the mesh for a change that Target unknowns allows, if
     * there is one. Collective.
     *
     * @param n_unknowns on the mesh as it is.
     * @return whether cells are to be divided. */
    bool
    flag(const dealii::Vector<float> &squares, const double n_unknowns);

    /** To be called after the mesh has been changed: takes another one with the
     * same cells on each rank, in the order in which a checkpoint has them. So
     * a resumed run computes the same. Collective. */
    void
    renew();

    /** summary.json "refinement" */
    void
    add_to(Summary &summary) const;

  private:
    /** Estimates on the mesh that there is.
     *
     * @return the squares for each cell. */
    dealii::Vector<float>
    estimate(Log &quiet);

    /** Whether the last mesh has been there before, so that all that follows
     * would come again: what is joined may balance what is divided. */
    bool
    repeats() const;

    void
    report(Log &log) const;

    /** Changes the mesh, unless it would hardly be another one. */
    bool
    advance(const dealii::Vector<float> &squares);

    const Scene                scene; ///< with fast solvers
    std::shared_ptr<Mesh<dim>> current;
    /** On the way, this one the last; none if nothing was adapted. */
    std::vector<MeshEstimate> all;
  };
} // namespace Crevasse

#endif
