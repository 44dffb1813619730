// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/contact/no_contact.h>
#include <crevasse/discretisation/stress_estimator.h>
#include <crevasse/model/elastic_displacement.h>
#include <crevasse/time/evolution.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    Vector
    solution(ContactSolver &solver, const Vector &loads)
    {
      std::vector<double> no_forces;
      Vector              displacement;
      displacement.reinit(loads);
      solver.solve(loads, displacement, no_forces);
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
    const UnilateralBounds none;
    if (!lip_closed)
      {
        ContactSystem<dim>    &system = systems.system_at(0.);
        const SignoriniProblem unconstrained(system.problem().stiffness, none);
        NoContact              solver(unconstrained,
                         system.linear_solver(),
                         scene.contact.tolerance);
        return solution(solver, loads);
      }

    // Constraints of the other space differ only in the openings, where loads
    // then do not count.
    const SingularShapes *const shapes = body.space.singular_shapes();
    const Space<dim>            closed_space(body.space.triangulation,
                                  body.space.finite_element.degree,
                                  body.space.roles,
                                  fixed_points<dim>(scene),
                                  body.space.volumetric_strain,
                                  shapes != nullptr ? shapes->functions
                                                               : SingularFunctions(),
                                  true);
    ContactSystem<dim>          closed(systems.settings,
                              closed_space,
                              body.points,
                              *body.material.at(0.).stiffness,
                              none);
    Vector                      closed_loads(loads);
    closed_space.constraints.set_zero(closed_loads);
    const Vector displacement = solution(closed.contact_solver(), closed_loads);
    systems.add(closed.statistics());
    return displacement;
  }



  template <int dim>
  void
  look_at_elastic_states(const Body<dim>           &body,
                         ContactSystemCache<dim>   &systems,
                         const std::vector<double> &instants,
                         StressEstimator<dim>      &estimator)
  {
    Evolution<dim> evolution(body.strain_operator,
                             body.points,
                             body.loads,
                             systems);
    evolution.slide_with(body.friction);
    for (const double t : instants)
      {
        evolution.elastic_state(t);
        estimator.look_at(t,
                          evolution.state().stress,
                          evolution.state().contact_forces,
                          systems.at(t).material,
                          &evolution.state().displacement);
      }
  }



  template decltype(elastic_displacement<2>)   elastic_displacement<2>;
  template decltype(elastic_displacement<3>)   elastic_displacement<3>;
  template decltype(look_at_elastic_states<2>) look_at_elastic_states<2>;
  template decltype(look_at_elastic_states<3>) look_at_elastic_states<3>;
} // namespace Crevasse
