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
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_precondition.h>

#include <crevasse_tests/slit_square.h>
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

  /** From the lower lip to the upper one. */
  dealii::Tensor<1, 2>
  jump(const PolarField &field)
  {
    return field.displacement({-0.7, 0.}) - field.displacement({-0.7, -0.});
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
   * stress and plane strain; the first one of each mode has K = sqrt(2 pi) / 2
   * mu and jumps as far as D does not. */
  void
  check_williams_terms(const bool plane_stress, const CrackMode mode)
  {
    const VoigtMatrix<2>  K = isotropic_stiffness<2>(7., 0.3, plane_stress);
    const PlaneElasticity elasticity(K);
    const bool            slides = mode == CrackMode::sliding;
    const std::string     name =
      std::string(plane_stress ? "plane stress" : "plane strain") +
      (slides ? ", mode II" : ", mode I");
    check(name + ": the stiffness is isotropic",
          PlaneElasticity::is_isotropic(K));
    check_below(name + ": plane modulus",
                std::abs(elasticity.modulus() -
                         7. / (plane_stress ? 1. : 1. - 0.09)),
                1e-12);
    double unbalanced = 0., on_lips = 0., ahead = 0., opening = 0.;
    for (unsigned int n = 1; n <= 8; ++n)
      {
        const PolarField term = williams_term(n, elasticity.kappa(), mode);
        // The second term of mode II is a rotation, without stress.
        if (!slides || n != 2)
          for (const double theta : {-2.3, 0.3, 1.1, 2.9})
            unbalanced = std::max(unbalanced,
                                  unbalanced_stress(term,
                                                    K,
                                                    {0.7 * std::cos(theta),
                                                     0.7 * std::sin(theta)}));
        for (const double y : {0., -0.})
          {
            const VoigtVector<2> lip = stress_of(term, K, {-0.7, y});
            on_lips = std::max({on_lips, std::abs(lip[1]), std::abs(lip[3])});
          }
        ahead =
          std::max(ahead,
                   std::abs(stress_of(term, K, {0.7, 0.})[slides ? 1 : 3]));
        opening = std::max(opening, std::abs(jump(term)[1]));
      }
    check_below(name + ": div s of eight terms", unbalanced, 1e-7);
    check_below(name + ": traction on both lips", on_lips, 1e-11);
    check_below(name + ": stress of the other mode ahead", ahead, 1e-12);
    if (slides)
      check_below(name + ": opening", opening, 1e-12);
    const PolarField first = williams_term(1, elasticity.kappa(), mode);
    check_below(name + ": K of the first term",
                std::abs(stress_of(first, K, {0.7, 0.})[slides ? 3 : 1] *
                           std::sqrt(2. * pi * 0.7) /
                           (2. * elasticity.shear_modulus) -
                         std::sqrt(2. * pi)),
                1e-12);
    check_below(name + ": jump of the first term",
                std::abs(jump(first)[slides ? 0 : 1] /
                           (2. * (elasticity.kappa() + 1.) * std::sqrt(0.7)) -
                         1.),
                1e-12);
    check_below(name + ": jump of D",
                jump(square_root_without_jump(mode)).norm(),
                1e-14);
  }

  /** On which lip a point is, its cell says, not what rounding has made of it.
   */
  void
  check_sides()
  {
    const CrackTip         tip{{},
                       dealii::Tensor<1, 2>({1., 0.}),
                       dealii::Tensor<1, 2>({0., 1.}),
                       true};
    const SingularFunction slides =
      make_singular_functions(
        1, tip, PlaneElasticity(isotropic_stiffness<2>(7., 0.3, true)), 0.1, 2.)
        .back();
    const auto above = slides.value({-0.7, -1e-17}, {-0.6, 0.1});
    const auto below = slides.value({-0.7, 1e-17}, {-0.6, -0.1});
    check_below("lips slide by as much to both sides",
                (above + below).norm() / above.norm(),
                1e-12);
    check_below("nothing is left where the crack ends",
                slides.value({-2., 1e-17}, {-1.9, 0.1}).norm() +
                  slides.gradient({-2., 0.1}, {-2.1, 0.1}).norm(),
                1e-15);
    const dealii::Point<2>     x(-0.6, 0.5), cell(-0.6, 0.51);
    const dealii::Tensor<2, 2> exact = slides.gradient(x, cell);
    constexpr double           h     = 1e-5;
    for (unsigned int d = 0; d < 2; ++d)
      {
        dealii::Tensor<1, 2> step;
        step[d] = h;
        dealii::Tensor<1, 2> difference =
          (slides.value(x + step, cell) - slides.value(x - step, cell)) /
          (2. * h);
        for (unsigned int c = 0; c < 2; ++c)
          difference[c] -= exact[c][d];
        check_below("gradient where it is cut off, less differences, along " +
                      std::to_string(d),
                    difference.norm() / exact.norm(),
                    1e-8);
      }
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
  check_operators(const std::string                    &name,
                  const std::shared_ptr<const Mesh<2>> &mesh,
                  const BoundaryRoles                  &roles,
                  const unsigned int                    degree,
                  const unsigned int                    n_functions)
  {
    const VoigtMatrix<2> K    = isotropic_stiffness<2>(7., 0.3, true);
    const auto           tips = find_crack_tips(*mesh, roles);
    section(name + ", Q" + std::to_string(degree));
    const double radius = straight_length(*mesh, roles, tips.at(0));
    check("one tip, the crack behind it leaves the body",
          tips.size() == 1 && std::isinf(radius));
    const Space<2> space(
      mesh,
      degree,
      roles,
      {},
      VolumetricStrain::full,
      make_singular_functions(3, tips[0], PlaneElasticity(K), 0.04, radius));
    check("as many functions as modes need",
          space.singular_shapes()->size() == n_functions);
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
    double                                         at_nodes = 0., volume = 0.;
    std::vector<std::vector<dealii::Tensor<1, 2>>> values;
    dealii::FEValues<2>                            at_support_points(
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
        space.singular_shapes()->values(at_support_points, values);
        for (unsigned int k = 0; k < n_functions; ++k)
          for (unsigned int i = 0; i < indices.size(); ++i)
            if (!hanging.is_constrained(indices[i]))
              at_nodes = std::max(at_nodes, values[k][i].norm());
        const dealii::FEValues<2> &own = cell_values.reinit(cell);
        for (const unsigned int point : own.quadrature_point_indices())
          volume += own.JxW(point);
      }
    check_below("singular functions at the nodes", at_nodes, 1e-12);
    check_below("sum of the weights of all rules - area",
                std::abs(
                  dealii::Utilities::MPI::sum(volume, MPI_COMM_WORLD) /
                    dealii::GridTools::volume(
                      static_cast<const dealii::Triangulation<2> &>(*mesh)) -
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
      geometry.width / (*geometry.subdivisions)[0] / std::pow(2., n_levels);
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
        geometry.subdivisions = std::to_string(mesh.subdivisions[0]) + ", " +
                                std::to_string(mesh.subdivisions[1]);
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
  for (const CrackMode mode : {CrackMode::opening, CrackMode::sliding})
    for (const bool plane_stress : {true, false})
      check_williams_terms(plane_stress, mode);
  check_sides();
  GeometryParameters geometry;
  geometry.subdivisions = "6, 3";
  BoundaryRoles two_lips;
  two_lips.crack = {1};
  for (const unsigned int degree : {1, 2})
    {
      check_operators("one lip",
                      cracked_plate(geometry, 2),
                      built_in_roles(geometry),
                      degree,
                      3);
      check_operators("two lips", slit_square(0.5, 3), two_lips, degree, 6);
    }
  section("condition");
  check_condition();
}
