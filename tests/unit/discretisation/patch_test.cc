// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Patch test: a uniform stress, shear included, creeps exactly. The discrete
// solution of an unconstrained plate under the tractions of a uniform stress
// F(t) s is that stress at every quadrature point, on distorted cells and with
// hanging nodes, and the viscous strain is the scheme's own quadrature of F.

#include <crevasse/contact/no_contact.h>
#include <crevasse/discretisation/algorithmic_moduli.h>
#include <crevasse/discretisation/external_loads.h>
#include <crevasse/discretisation/material_field.h>
#include <crevasse/discretisation/stiffness.h>
#include <crevasse/discretisation/strain_operator.h>
#include <crevasse/linear/cholesky.h>
#include <crevasse/time/evolution.h>
#include <crevasse/time/instant_provider.h>
#include <crevasse/time/integrator_choice.h>

#include <crevasse_tests/distorted_cube.h>
#include <crevasse_tests/tests.h>

using namespace Crevasse;

namespace
{
  double
  load_factor(const double t)
  {
    return 1. + t * t;
  }

  /** Traction s n on the whole boundary of the unit square (cube). */
  template <int dim>
  LoadParameters
  uniform_stress_loads(const VoigtVector<dim> &s)
  {
    const auto normal = [](const char x) {
      return std::string("(") + x + " > 0.999999 ? 1 : (" + x +
             " < 0.000001 ? -1 : 0))";
    };
    std::string traction;
    for (unsigned int i = 0; i < dim; ++i)
      {
        traction += (i == 0 ? "(1 + t*t)*(" : "; (1 + t*t)*(");
        for (unsigned int j = 0; j < dim; ++j)
          traction += (j == 0 ? "" : " + ") +
                      std::to_string(s[voigt_index<dim>(i, j)]) + "*" +
                      normal("xyz"[j]);
        traction += ")";
      }
    LoadParameters loads;
    loads.traction = traction;
    return loads;
  }



  /** The same material and solver at all instants. */
  template <int dim>
  class ConstantInstant : public InstantProvider<dim>
  {
  public:
    ConstantInstant(const MaterialState<dim> &material,
                    ContactSolver            &contact_solver)
      : material(material)
      , contact_solver(contact_solver)
    {
    }

    Instant<dim>
    at(const double) override
    {
      return {material, contact_solver};
    }

    const MaterialState<dim> &
    material_at(const double) override
    {
      return material;
    }

    ImplicitInstant<dim>
    implicit_at(const double, const double) override
    {
      AssertThrow(false, dealii::ExcNotImplemented());
    }

    ImplicitInstant<dim>
    implicit_material_at(const double, const double) override
    {
      AssertThrow(false, dealii::ExcNotImplemented());
    }

    Tangent<dim>
    tangent_at(const double,
               const double,
               const Vector &,
               const Vector &) override
    {
      AssertThrow(false, dealii::ExcNotImplemented());
    }

    Tangent<dim>
    renew_tangent(const double,
                  const double,
                  const Vector &,
                  const Vector &) override
    {
      AssertThrow(false, dealii::ExcNotImplemented());
    }

    const RelaxationFunctions<dim> &
    relaxation_at(const double, const double) override
    {
      AssertThrow(false, dealii::ExcNotImplemented());
    }

    SolverStatistics
    statistics() const override
    {
      return contact_solver.statistics();
    }

  private:
    const MaterialState<dim> &material;
    ContactSolver            &contact_solver;
  };



  /** Statically determinate. */
  template <int dim>
  std::vector<FixedPoint<dim>>
  supports()
  {
    if constexpr (dim == 2)
      return {{dealii::Point<2>(0., 0.), {{true, true}}},
              {dealii::Point<2>(1., 0.), {{false, true}}}};
    else
      return {{dealii::Point<3>(0., 0., 0.), {{true, true, true}}},
              {dealii::Point<3>(1., 0., 0.), {{false, true, true}}},
              {dealii::Point<3>(0., 1., 0.), {{false, false, true}}}};
  }



  /** A stress with all components that a traction can bring about. */
  template <int dim>
  VoigtVector<dim>
  uniform_stress()
  {
    VoigtVector<dim> s;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        s[voigt_index<dim>(i, j)] =
          (i == j ? 3. - 5. * i + j * j : 1.5 - 0.7 * (i + j - 1.));
    return s;
  }



  template <int dim>
  void
  patch_test(const unsigned int degree, const ViscosityType viscosity)
  {
    MaterialParameters material;
    material.young_modulus         = "13000";
    material.poisson_ratio         = "0.2";
    material.viscosity             = viscosity;
    material.relaxation_time       = "3";
    material.viscous_modulus       = "30000";
    material.viscous_poisson_ratio = "0.5";
    const MaxwellLaw<dim>  law(material);
    const Temperature<dim> temperature(Expression("0"), "", 1.);

    BoundaryRoles roles;
    roles.loaded = {0, 1, 2, 3};
    for (const dealii::types::boundary_id side : {4, 5})
      if (dim == 3)
        roles.loaded.insert(side);
    // On more quadratic cells in space rounding shows: three points hold it.
    const unsigned int n = dim == 2 ? 4 : 4 - degree;
    const Space<dim>   space(distorted_cube_with_hanging_nodes<dim>(n, 0.25),
                           degree,
                           roles,
                           supports<dim>());
    const QuadratureField<dim> points(space);
    const StrainOperator<dim>  strain_operator(space, points);

    const VoigtVector<dim>   s = uniform_stress<dim>();
    const ExternalLoads<dim> loads(space,
                                   strain_operator,
                                   uniform_stress_loads<dim>(s));
    SparseMatrix             matrix;
    const MaterialField<dim> field(space, points, law, temperature);
    const MaterialState<dim> state = field.at(0.);
    assemble_stiffness(space, points, *state.stiffness, matrix);
    const UnilateralBounds none;
    const SignoriniProblem problem(matrix, none);
    Cholesky               cholesky(matrix);
    NoContact              solver(problem, cholesky, 1e-12);
    ConstantInstant<dim>   instants(state, solver);
    Evolution<dim>         evolution(strain_operator, points, loads, instants);

    Vector r;
    points.initialize(r);
    Vector                    rate(r);
    TimeIntegrationParameters parameters;
    parameters.scheme                      = Scheme::heun;
    const std::unique_ptr<Integrator> heun = make_integrator(parameters, false);
    const double                      time_step = 0.5;
    double integral = 0., stress_error = 0., strain_error = 0.;
    for (unsigned int k = 0; k < 5; ++k)
      {
        const double t = k * time_step;
        heun->start(evolution, t, r, rate);
        const Vector &stress = evolution.state().stress;
        for (std::size_t i = 0; i < stress.locally_owned_size();
             i += n_stress_components<dim>)
          stress_error = std::max(
            stress_error,
            (QuadratureField<dim>::get(stress, i) / load_factor(t) - s).norm());
        heun->advance({evolution, t, time_step, rate, r});
        integral += time_step * (0.25 * load_factor(t) +
                                 0.75 * load_factor(t + 2. / 3. * time_step));
      }
    const VoigtVector<dim> expected = integral * ((*state.fluidity[0])[0] * s);
    for (std::size_t i = 0; i < r.locally_owned_size();
         i += n_stress_components<dim>)
      strain_error =
        std::max(strain_error,
                 (QuadratureField<dim>::get(r, i) - expected).norm() /
                   expected.norm());

    section(std::to_string(dim) + "D, Q" + std::to_string(degree) + ", " +
            name_of(viscosity));
    check("hanging nodes",
          space.constraints.n_constraints() > 0 &&
            space.mesh().has_hanging_nodes());
    check_below("stress error / largest stress",
                stress_error / s.norm(),
                1e-12);
    check_below("viscous strain, relative error", strain_error, 1e-12);
  }
} // namespace

void
patch_test()
{
  for (const unsigned int degree : {1, 2})
    for (const ViscosityType viscosity :
         {ViscosityType::relaxation_time, ViscosityType::isotropic})
      {
        patch_test<2>(degree, viscosity);
        patch_test<3>(degree, viscosity);
      }
}
