// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_model_body_h
#define crevasse_model_body_h

#include <crevasse/base/log.h>
#include <crevasse/contact/signorini_problem.h>
#include <crevasse/discretisation/external_loads.h>
#include <crevasse/discretisation/imposed_displacement.h>
#include <crevasse/discretisation/material_field.h>
#include <crevasse/discretisation/rigid_motions.h>
#include <crevasse/discretisation/strain_operator.h>
#include <crevasse/lip/friction.h>
#include <crevasse/parameters/effects.h>

namespace Crevasse
{
  /** The roles of the scene's boundaries: as given by the user, completed by
   * those of the built-in shape. @throw SceneError if there is a traction but
   * no loaded boundary. */
  BoundaryRoles
  boundary_roles(const Scene &scene);

  /** Creates the scene's mesh with the refinement that needs no solution:
   * uniform and towards the crack tip. Collective.
   * @param log Gets remarks on a mesh file, unless it is null.
   * @throw SceneError */
  template <int dim>
  std::shared_ptr<Mesh<dim>>
  make_scene_mesh(const Scene   &scene,
                  const MPI_Comm communicator,
                  Log           *log = nullptr);

  /**
   * The discretised body: mesh, spaces, lip and loads, before anything is
   * assembled or solved. Its construction checks mesh and boundaries.
   */
  template <int dim>
  struct Body
  {
    /** @param mesh of make_scene_mesh(), possibly adapted.
     * @throw SceneError, or NumericalError if a rigid-body motion is
     * unconstrained. */
    Body(const Scene &scene, std::shared_ptr<const Mesh<dim>> mesh);

    /** Displacement at all nodes, also where it is imposed. Collective.
     * @param displacement with the flow that is split off, if any.
     * @param t State::instant
     * @param time since the start of the run. */
    Vector
    nodal_displacement(const Vector &displacement,
                       const double  t,
                       const double  time) const;

    const Temperature<dim> temperature;
    const Effects          effects;
    const MaxwellLaw<dim>  law;
    const Space<dim>       space;
    /** Rigid-body motions that only contact stops. */
    const std::vector<RigidMotion> held_by_contact;
    const QuadratureField<dim>     points;
    const ImposedDisplacement<dim> imposed;
    const MaterialField<dim>       material;
    const StrainOperator<dim>      strain_operator;
    ContactBoundary<dim>           lip;
    const ExternalLoads<dim>       loads;
    std::optional<Friction<dim>>   friction; ///< none without friction
  };

  /** Limit of a property of the material at a tip, if it is the same from all
   * sides. Around the tip the property may vary.
   * @param side 0, or the sign of Y on the one side of the crack's line or
   * circle that counts: then no cell at the tip may lie on both. */
  std::optional<VoigtMatrix<2>>
  limit_at(const CrackTip                 &tip,
           const dealii::Triangulation<2> &mesh,
           const Property<VoigtMatrix<2>> &property,
           const Temperature<2>           &temperature,
           const double                    t,
           const double                    side = 0.);

  /** Stiffness at a tip at an instant, without the factor k.
   * @throw SceneError if it has no limit there. */
  VoigtMatrix<2>
  stiffness_at(const CrackTip                 &tip,
               const dealii::Triangulation<2> &mesh,
               const MaxwellLaw<2>            &law,
               const Temperature<2>           &temperature,
               const double                    t,
               const std::string              &wanted_by);

  /** Bounds of the discrete cone C: at the nodes of a lip, in their order, and
   * then the bound of the singular function that opens the lip. Its coefficient
   * is proportional to K_I: without the bound the lip would penetrate between
   * the nodes by √r. (w₃ opens it by r^{3/2} only, and has no bound.)
   * @param motions rigid-body motions that only the bounds stop. */
  template <int dim>
  UnilateralBounds
  unilateral_bounds(const ContactBoundary<dim>     &lip,
                    const Space<dim>               &space,
                    const std::vector<RigidMotion> &motions = {});

  /** Supports of the scene: its list, or those of its built-in shape. */
  template <int dim>
  std::vector<FixedPoint<dim>>
  fixed_points(const Scene &scene);

  /** Describes roles, boundary ids and supports in one line: "symmetry 2;
   * loaded 3; contact 4; fixed (0.5, 0): 1". */
  template <int dim>
  std::string
  describe_boundaries(const Scene &scene);
} // namespace Crevasse

#endif
