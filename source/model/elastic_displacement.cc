// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/contact/unconstrained.h>
#include <crevasse/model/elastic_displacement.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    Vector
    open_displacement(const Scene             &scene,
                      ContactSystemCache<dim> &systems,
                      const Vector            &loads)
    {
      const UnilateralBounds none;
      ContactSystem<dim>    &system = systems.system_at(0.);
      const SignoriniProblem unconstrained(system.stiffness(), none);
      std::vector<double>    no_forces;
      Vector                 displacement;
      displacement.reinit(loads);
      Unconstrained(unconstrained,
                    system.linear_solver(),
                    scene.contact.tolerance)
        .solve(loads, displacement, no_forces);
      return displacement;
    }
  } // namespace



  template <int dim>
  Vector
  elastic_displacement(const Scene             &scene,
                       const Body<dim>         &body,
                       ContactSystemCache<dim> &systems,
                       const Vector            &loads,
                       const bool               lip_closed)
  {
    if (!lip_closed)
      return open_displacement(scene, systems, loads);

    // A closed lip is a symmetry plane. The other space's constraints agree
    // with this one's but for the lip, where the loads then do not count.
    BoundaryRoles roles = body.space.roles();
    roles.symmetry.insert(roles.contact.begin(), roles.contact.end());
    roles.contact.clear();
    const SingularShapes *const shapes = body.space.singular_shapes();
    const Space<dim>            closed_space(body.space.shared_mesh(),
                                  body.space.finite_element().degree,
                                  roles,
                                  fixed_points<dim>(scene),
                                  body.space.volumetric_strain(),
                                  shapes != nullptr ? shapes->functions()
                                                               : SingularFunctions());
    const UnilateralBounds      none;
    ContactSystem<dim>          closed(systems.settings(),
                              closed_space,
                              body.points,
                              *body.material.at(0.).stiffness,
                              none);
    Vector                      closed_loads(loads);
    closed_space.constraints().set_zero(closed_loads);
    Vector              displacement;
    std::vector<double> no_forces;
    displacement.reinit(loads);
    closed.contact_solver().solve(closed_loads, displacement, no_forces);

    systems.add(closed.statistics());
    return displacement;
  }



#define INSTANTIATE(dim)                                               \
  template Vector elastic_displacement<dim>(const Scene &,             \
                                            const Body<dim> &,         \
                                            ContactSystemCache<dim> &, \
                                            const Vector &,            \
                                            const bool)

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
