// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Singular functions at the crack tip: what they satisfy, and that they are
// unknowns like the others for the strain operator and the stiffness, on a mesh
// with hanging nodes.

#include <crevasse/discretisation/cell_values.h>
#include <crevasse/discretisation/stiffness.h>
#include <crevasse/discretisation/strain_operator.h>
#include <crevasse/grid/geometry.h>
#include <crevasse/linear/matrix_operator.h>
#include <crevasse/material/voigt_matrix.h>
#include <crevasse/parameters/built_in_boundary.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_precondition.h>

#include <crevasse_tests/tests.h>
#include <random>

using namespace Crevasse;

namespace
{
  constexpr double pi = dealii::numbers::PI;

  VoigtVector<2>
  stress_of(const PolarField       &field,
            const VoigtMatrix<2>   &K,
            const dealii::Point<2> &x)
  {
    return K * voigt_strain<2>(field.gradient(x));
  }

  /** div s by central differences, times r^2 / |s|'s own scale. */
  double
  unbalanced_stress(const PolarField       &field,
                    const VoigtMatrix<2>   &K,
                    const dealii::Point<2> &x)
  {
    const double         h  = 1e-5;
    const auto           dx = dealii::Tensor<1, 2>({h, 0.});
    const auto           dy = dealii::Tensor<1, 2>({0., h});
    const VoigtVector<2> along_x =
      (stress_of(field, K, x + dx) - stress_of(field, K, x - dx)) / (2. * h);
    const VoigtVector<2> along_y =
      (stress_of(field, K, x + dy) - stress_of(field, K, x - dy)) / (2. * h);
    return std::hypot(along_x[0] + along_y[3], along_x[3] + along_y[1]) /
           stress_of(field, K, x).norm();
  }

  /** Williams' terms are in equilibrium and leave the lips free, in plane
   * stress and plane strain; the first one has K_I = sqrt(2 pi) / 2 mu. */
  void
  check_williams_terms(const bool plane_stress)
  {
    const VoigtMatrix<2>  K = isotropic_stiffness<2>(7., 0.3, plane_stress);
    const PlaneElasticity elasticity(K);
    const std::string     name = plane_stress ? "plane stress" : "plane strain";
    check(name + ": the stiffness is isotropic",
          PlaneElasticity::is_isotropic(K));
    check_below(name + ": plane modulus",
                std::abs(elasticity.modulus() -
                         7. / (plane_stress ? 1. : 1. - 0.09)),
                1e-12);
    double unbalanced = 0., on_lip = 0., shear_ahead = 0.;
    for (unsigned int n = 1; n <= 8; ++n)
      {
        const PolarField term = williams_term(n, elasticity.kappa());
        for (const double theta : {0.3, 1.1, 2.9})
          unbalanced = std::max(unbalanced,
                                unbalanced_stress(term,
                                                  K,
                                                  {0.7 * std::cos(theta),
                                                   0.7 * std::sin(theta)}));
        const VoigtVector<2> lip = stress_of(term, K, {-0.7, 1e-300});
        on_lip = std::max({on_lip, std::abs(lip[1]), std::abs(lip[3])});
        shear_ahead =
          std::max(shear_ahead, std::abs(stress_of(term, K, {0.7, 0.})[3]));
      }
    check_below(name + ": div s of eight terms", unbalanced, 1e-7);
    check_below(name + ": traction on the lip", on_lip, 1e-11);
    check_below(name + ": shear ahead of the tip", shear_ahead, 1e-12);
    const double stress_ahead =
      stress_of(williams_term(1, elasticity.kappa()), K, {0.7, 0.})[1];
    check_below(name + ": K_I of the first term",
                std::abs(stress_ahead * std::sqrt(2. * pi * 0.7) /
                           (2. * elasticity.shear_modulus) -
                         std::sqrt(2. * pi)),
                1e-12);
    // What rounding has put below the lip still is on it.
    const PolarField first = williams_term(1, elasticity.kappa());
    check_below(name + ": a lip that is not quite straight",
                (first.displacement({-0.7, -1e-17}) -
                 first.displacement({-0.7, 0.}))
                  .norm(),
                1e-12);
    const dealii::Tensor<1, 2> of_d =
      square_root_without_opening().displacement({-0.7, 0.});
    check_below(name + ": opening of D", std::abs(of_d[1]), 1e-15);
  }

  /** A plate with a crack from the right, refined at its tip. */
  std::shared_ptr<const Mesh<2>>
  cracked_plate(const GeometryParameters &geometry, const unsigned int n_levels)
  {
    auto mesh = std::make_shared<Mesh<2>>(MPI_COMM_WORLD);
    make_mesh<2>(geometry, *mesh);
    const dealii::Point<2> tip(tip_abscissa(geometry), 0.);
    for (unsigned int level = 0; level < n_levels; ++level)
      {
        for (const auto &cell : mesh->active_cell_iterators())
          if (cell->is_locally_owned())
            for (const unsigned int v : cell->vertex_indices())
              if (cell->vertex(v).distance(tip) < 1e-10)
                cell->set_refine_flag();
        mesh->execute_coarsening_and_refinement();
      }
    return mesh;
  }

  /** D, its transpose and the stiffness agree, the coefficients included. */
  void
  check_operators(const unsigned int degree)
  {
    GeometryParameters geometry;
    geometry.subdivisions      = {6, 3};
    const auto           mesh  = cracked_plate(geometry, 2);
    const BoundaryRoles  roles = built_in_roles(geometry);
    const VoigtMatrix<2> K     = isotropic_stiffness<2>(7., 0.3, true);

    const auto tips = find_crack_tips(*mesh, roles);
    section("Q" + std::to_string(degree));
    check("one tip, the crack on its right",
          tips.size() == 1 && tips[0].ahead[0] == -1. &&
            tips[0].inward[1] == 1.);
    const Space<2> space(
      mesh,
      degree,
      roles,
      {},
      VolumetricStrain::full,
      make_singular_functions(3, tips[0], PlaneElasticity(K), 0.04));
    const QuadratureField<2> points(space);
    const StrainOperator<2>  strain_operator(space, points);

    Vector q, assembled, matrix_free, stress;
    strain_operator.initialize(q);
    strain_operator.initialize(assembled);
    strain_operator.initialize(matrix_free);
    points.initialize(stress);
    std::mt19937                           generator(1980);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    for (double &value : q)
      value = uniform(generator);
    space.constraints.set_zero(q);

    SparseMatrix matrix;
    assemble_stiffness(space, points, PointValues<VoigtMatrix<2>>(K), matrix);
    multiply(matrix, assembled, q);
    strain_operator.for_each_strain(
      q, [&](const std::size_t point, const VoigtVector<2> &strain) {
        QuadratureField<2>::set(stress, point, K * strain);
      });
    strain_operator.add_transpose(matrix_free, [&](const std::size_t point) {
      return QuadratureField<2>::get(stress, point);
    });
    const double size = assembled.linfty_norm();
    assembled -= matrix_free;
    check_below("A q - D'K D q, relative",
                assembled.linfty_norm() / size,
                1e-13);

    // The field of a coefficient is psi at the nodes of no cell, and all of it
    // where the nodes have the interpolation.
    double                            at_nodes = 0., volume = 0.;
    std::vector<dealii::Tensor<1, 2>> values;
    dealii::FEValues<2>               at_support_points(
      space.mapping,
      space.finite_element,
      dealii::Quadrature<2>(space.finite_element.get_unit_support_points()),
      dealii::update_values | dealii::update_quadrature_points);
    CellValues<2> cell_values(space, dealii::update_JxW_values);
    std::vector<dealii::types::global_dof_index> indices(
      space.finite_element.n_dofs_per_cell());
    dealii::IndexSet relevant;
    dealii::DoFTools::extract_locally_relevant_dofs(space.dof_handler,
                                                    relevant);
    dealii::AffineConstraints<double> hanging(relevant);
    dealii::DoFTools::make_hanging_node_constraints(space.dof_handler, hanging);
    hanging.close();
    for (const auto &cell : space.dof_handler.active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        at_support_points.reinit(cell);
        cell->get_dof_indices(indices);
        for (unsigned int k = 0; k < 3; ++k)
          {
            space.singular_shapes()->values(k, at_support_points, values);
            for (unsigned int i = 0; i < indices.size(); ++i)
              if (!hanging.is_constrained(indices[i]))
                at_nodes = std::max(at_nodes, values[i].norm());
          }
        const dealii::FEValues<2> &own = cell_values.reinit(cell);
        for (const unsigned int point : own.quadrature_point_indices())
          volume += own.JxW(point);
      }
    check_below("singular functions at the nodes", at_nodes, 1e-12);
    check_below("sum of the weights of all rules - area",
                std::abs(dealii::Utilities::MPI::sum(volume, MPI_COMM_WORLD) -
                         1.),
                1e-13);
  }

  /** The condition number of A after diagonal scaling, with the first n
   * singular functions: from the Lanczos process of conjugate gradients. The
   * body is held far from the tip: a single point held at the tip is a
   * singularity of its own, which w₁ resolves better (a ratio of 1.3 on the
   * coarsest mesh). */
  double
  condition_number(const GeometryParameters &geometry,
                   const unsigned int        n_levels,
                   const unsigned int        degree,
                   const unsigned int        n)
  {
    const auto           mesh  = cracked_plate(geometry, n_levels);
    const BoundaryRoles  roles = built_in_roles(geometry);
    const VoigtMatrix<2> K     = isotropic_stiffness<2>(7., 0.3, true);
    const CrackTip       tip   = find_crack_tips(*mesh, roles)[0];
    const double         size =
      geometry.width / geometry.subdivisions[0] / std::pow(2., n_levels);
    const Space<2> space(
      mesh,
      degree,
      roles,
      {{dealii::Point<2>(), {{true, false}}}},
      VolumetricStrain::full,
      n == 0 ? SingularFunctions()
             : make_singular_functions(n, tip, PlaneElasticity(K), size));
    const QuadratureField<2> points(space);
    SparseMatrix             matrix;
    assemble_stiffness(space, points, PointValues<VoigtMatrix<2>>(K), matrix);

    Vector                                 b = space.ghosted_vector(), x(b);
    std::mt19937                           generator(1980);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    for (double &value : b)
      value = uniform(generator);
    space.constraints.set_zero(b);
    double                   condition = 0.;
    dealii::ReductionControl control(10000, 0., 1e-13, false, false);
    dealii::SolverCG<Vector> cg(control);
    dealii::TrilinosWrappers::PreconditionJacobi jacobi;
    jacobi.initialize(matrix);
    cg.connect_condition_number_slot(
      [&condition](const double value) { condition = value; });
    cg.solve(MatrixOperator(matrix), x, b, jacobi);
    return condition;
  }

  /** Singular functions hardly make a difference to the condition. */
  void
  check_condition()
  {
    struct Case
    {
      std::vector<unsigned int> subdivisions;
      unsigned int              n_levels, degree;
    };
    for (const Case &mesh : {Case{{14, 4}, 0, 1},
                             Case{{28, 28}, 0, 1},
                             Case{{14, 4}, 0, 2},
                             Case{{14, 14}, 0, 2},
                             Case{{6, 4}, 4, 2}})
      {
        GeometryParameters geometry;
        geometry.subdivisions = mesh.subdivisions;
        const double without =
          condition_number(geometry, mesh.n_levels, mesh.degree, 0);
        for (unsigned int n = 1; n <= 3; ++n)
          {
            const double ratio =
              condition_number(geometry, mesh.n_levels, mesh.degree, n) /
              without;
            check_below("Q" + std::to_string(mesh.degree) + ", " +
                          std::to_string(mesh.subdivisions[0]) + " x " +
                          std::to_string(mesh.subdivisions[1]) + ", " +
                          std::to_string(mesh.n_levels) + " levels, " +
                          std::to_string(n) +
                          " functions: ratio of condition numbers",
                        ratio,
                        1.2);
          }
      }
  }
} // namespace

void
singular_functions()
{
  check_williams_terms(true);
  check_williams_terms(false);
  check_operators(1);
  check_operators(2);
  section("condition");
  check_condition();
}
