// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// D and its transpose, the assembled stiffness and the recovery of stresses are
// consistent with each other, on distorted cells with hanging nodes.

#include <crevasse/discretisation/stiffness.h>
#include <crevasse/discretisation/strain_operator.h>
#include <crevasse/linear/level_transfer.h>
#include <crevasse/linear/matrix_operator.h>
#include <crevasse/linear/point_moduli.h>
#include <crevasse/linear/stiffness_product.h>
#include <crevasse/lip/contact_boundary.h>
#include <crevasse/material/voigt_matrix.h>
#include <crevasse/postprocess/probe.h>

#include <crevasse_tests/distorted_cube.h>
#include <crevasse_tests/lane_widths.h>
#include <crevasse_tests/probe_row.h>
#include <crevasse_tests/tests.h>
#include <random>

using namespace Crevasse;

namespace
{
  void
  fill_at_random(Vector &vector)
  {
    std::mt19937                           generator(1980);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    for (double &value : vector)
      value = uniform(generator);
  }

  /** ∫ s : D q over this rank's cells. */
  template <int dim>
  double
  work(const Space<dim>           &space,
       const QuadratureField<dim> &points,
       const StrainOperator<dim>  &strain_operator,
       const Vector               &stress,
       const Vector               &q)
  {
    Vector strains;
    points.initialize(strains);
    strain_operator.for_each_strain(
      q, [&](const std::size_t point, const VoigtVector<dim> &strain) {
        QuadratureField<dim>::set(strains, point, strain);
      });
    dealii::FEValues<dim> values(space.mapping,
                                 space.finite_element,
                                 space.quadratures[0],
                                 dealii::update_JxW_values);
    double                sum = 0.;
    for (const auto &cell : space.dof_handler.active_cell_iterators())
      {
        values.reinit(cell);
        for (const unsigned int k : values.quadrature_point_indices())
          {
            const std::size_t place =
              points.offset(cell) + k * n_stress_components<dim>;
            sum += values.JxW(k) * (QuadratureField<dim>::get(stress, place) *
                                    QuadratureField<dim>::get(strains, place));
          }
      }
    return sum;
  }



  /** Relative ones. */
  struct Errors
  {
    double sweeps = 0., product = 0., single_product = 0., transpose = 0.;
  };

  double
  relative_difference(const Vector &found, const Vector &expected)
  {
    Vector difference(expected);
    difference -= found;
    return difference.linfty_norm() / expected.linfty_norm();
  }

  /** A q = Dᵀ K D q, with D and Dᵀ matrix-free and A assembled or as products,
   * and Dᵀ is the transpose of D for any stress. */
  template <int dim>
  void
  compare_stiffness(const Space<dim> &space, Errors &worst)
  {
    const QuadratureField<dim> points(space);
    const StrainOperator<dim>  strain_operator(space, points);
    const VoigtMatrix<dim>     K = isotropic_stiffness<dim>(7., 0.3, false);

    Vector q, assembled, matrix_free, stress;
    strain_operator.initialize(q);
    strain_operator.initialize(assembled);
    strain_operator.initialize(matrix_free);
    points.initialize(stress);
    fill_at_random(q);
    space.constraints.set_zero(q);

    SparseMatrix                        matrix;
    const PointValues<VoigtMatrix<dim>> stiffness(K);
    assemble_stiffness(space, points, stiffness, matrix);
    multiply(matrix, assembled, q);
    strain_operator.for_each_strain(
      q, [&](const std::size_t point, const VoigtVector<dim> &strain) {
        QuadratureField<dim>::set(stress, point, K * strain);
      });
    strain_operator.add_transpose(matrix_free, [&](const std::size_t point) {
      return QuadratureField<dim>::get(stress, point);
    });
    worst.sweeps =
      std::max(worst.sweeps, relative_difference(matrix_free, assembled));

    StiffnessProduct<dim, double>(space, points, stiffness)
      .vmult(matrix_free, q);
    worst.product =
      std::max(worst.product, relative_difference(matrix_free, assembled));

    const StiffnessProduct<dim, float> in_single(space, points, stiffness, 7.);
    LevelVector                        v, result;
    in_single.initialize(v);
    in_single.initialize(result);
    v.copy_locally_owned_data_from(q);
    in_single.vmult(result, v);
    matrix_free.copy_locally_owned_data_from(result);
    matrix_free *= 7. * std::pow(space.cell_loops()->length_unit(), dim - 2);
    worst.single_product =
      std::max(worst.single_product,
               relative_difference(matrix_free, assembled));

    fill_at_random(stress);
    const double expected = work(space, points, strain_operator, stress, q);
    Vector       force;
    strain_operator.initialize(force);
    strain_operator.add_transpose(force, [&](const std::size_t point) {
      return QuadratureField<dim>::get(stress, point);
    });
    worst.transpose =
      std::max(worst.transpose, std::abs(force * q / expected - 1.));
  }

  template <int dim>
  void
  compare_stiffness(const unsigned int     degree,
                    const VolumetricStrain volumetric = VolumetricStrain::full)
  {
    BoundaryRoles roles;
    roles.symmetry = {0};
    roles.clamped  = {2};
    for (const bool is_sheared : {false, true})
      {
        const auto mesh =
          distorted_cube_with_hanging_nodes<dim>(6 - dim,
                                                 is_sheared ? 0. : 0.25,
                                                 is_sheared ? 0.3 : 0.);
        Errors worst;
        for_each_lane_width([&]() {
          const Space<dim> space(mesh, degree, roles, {}, volumetric);
          compare_stiffness(space, worst);
        });
        const std::string name =
          std::to_string(dim) + "D, Q" + std::to_string(degree) +
          (volumetric == VolumetricStrain::mean ? ", mean volume" : "") +
          (is_sheared ? ", sheared" : "");
        check_below(name + ": A q - D'K D q, relative", worst.sweeps, 1e-13);
        check_below(name + ": A q by products, relative", worst.product, 1e-13);
        check_below(name + ": A q in single precision, relative",
                    worst.single_product,
                    1e-5);
        check_below(name + ": (D's, q) - (s, D q), relative",
                    worst.transpose,
                    1e-12);
      }
  }

  /** An isotropic K, which needs fewer numbers, is recognised. */
  template <int dim>
  void
  recognise_isotropy()
  {
    const auto is_isotropic = [](const VoigtMatrix<dim> &K) {
      return IsotropicModuli<dim>::represents(K, true);
    };
    const VoigtMatrix<dim> isotropic = isotropic_stiffness<dim>(7., 0.3, false);
    bool                   tells_apart = true;
    for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
      for (unsigned int j = 0; j < n_stress_components<dim>; ++j)
        {
          VoigtMatrix<dim> K = isotropic;
          K[i][j] += 1e-10;
          tells_apart = tells_apart && !is_isotropic(K);
        }
    check(std::to_string(dim) + "D: isotropy is recognised",
          is_isotropic(isotropic) && tells_apart);
  }

  /** Fields of the element's own degree are recovered exactly on rectangular
   * cells, hanging nodes included; a probe sees what the nodes see. */
  template <int dim>
  void
  recover_polynomial(const unsigned int degree)
  {
    BoundaryRoles roles;
    roles.symmetry = {0};
    roles.contact  = {2};
    FixedPoint<dim> top;
    for (unsigned int d = 0; d < dim; ++d)
      {
        top.point[d]      = 1.;
        top.components[d] = (d == 1);
      }
    dealii::Point<dim> inside(dealii::Point<dim>::unit_vector(0) * 0.27 +
                              dealii::Point<dim>::unit_vector(1) * 0.61);
    if (dim == 3)
      inside[dim - 1] = 0.34;
    const dealii::Point<dim> at_corner(dealii::Point<dim>::unit_vector(0));

    const Space<dim> space(distorted_cube_with_hanging_nodes<dim>(6 - dim, 0.),
                           degree,
                           roles,
                           {top});
    const QuadratureField<dim> points(space);
    const StressRecovery<dim>  recovery(space, points);
    const ContactBoundary<dim> lip(space.lip,
                                   space.dof_handler,
                                   space.locally_owned_unknowns,
                                   Expression("0"));
    const auto named = [](const char *name, const dealii::Point<dim> &point) {
      return NamedPoint{name, {point.begin_raw(), point.end_raw()}};
    };
    const ProbeEvaluator<dim> probe(named("P", inside), space, recovery, lip);
    const ProbeEvaluator<dim> corner(named("C", at_corner),
                                     space,
                                     recovery,
                                     lip);

    const auto polynomial = [&](const dealii::Point<dim> &x) {
      return degree == 1 ? 2. + 3. * x[0] - x[1] + x[dim - 1]
                         : 2. + 3. * x[0] * x[0] - x[0] * x[dim - 1] + x[1];
    };
    Vector field;
    points.initialize(field);
    dealii::FEValues<dim> values(space.mapping,
                                 space.finite_element,
                                 space.quadratures[0],
                                 dealii::update_quadrature_points);
    for (const auto &cell : space.dof_handler.active_cell_iterators())
      {
        values.reinit(cell);
        for (const unsigned int q : values.quadrature_point_indices())
          for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
            field.local_element(points.offset(cell) +
                                q * n_stress_components<dim> + c) =
              (c + 1.) * polynomial(values.quadrature_point(q));
      }

    const std::string name =
      std::to_string(dim) + "D, Q" + std::to_string(degree);
    for (const auto *p : {&probe, &corner})
      {
        const dealii::Point<dim> x     = p == &probe ? inside : at_corner;
        double                   error = 0.;
        State                    state;
        state.stress = field;
        state.contact_forces.normal.resize(lip.nodes.size());
        const auto row = probe_row(*p, space, points, state);
        for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
          error =
            std::max(error,
                     std::abs(row[1 + dim + c] - (c + 1.) * polynomial(x)));
        check_below(name + ": recovered at probe " + p->name, error, 1e-12);
      }
    check(name + ": the corner lies on the lip, the inner point does not",
          corner.on_lip && !probe.on_lip);

    double size = 0.;
    for (const LipNode<dim> &node : lip.nodes)
      size += node.weight;
    check_below(name + ": sum of the lip's weights - size",
                std::abs(size - 1.),
                1e-14);
  }
} // namespace

void
operators()
{
  recognise_isotropy<2>();
  recognise_isotropy<3>();
  for (const unsigned int degree : {1, 2})
    {
      compare_stiffness<2>(degree);
      compare_stiffness<3>(degree);
      recover_polynomial<2>(degree);
      recover_polynomial<3>(degree);
    }
  compare_stiffness<2>(1, VolumetricStrain::mean);
  compare_stiffness<3>(1, VolumetricStrain::mean);
}
