// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// The matrix-free A is the assembled one; geometric multigrid solves with it,
// in as many iterations on any mesh, with hanging nodes, coefficients that jump
// and a part of the lip closed; on any number of ranks.

#include <crevasse/base/problems.h>
#include <crevasse/contact/active_set.h>
#include <crevasse/discretisation/rigid_modes.h>
#include <crevasse/discretisation/rigid_motions.h>
#include <crevasse/discretisation/stiffness.h>
#include <crevasse/linear/gmg_cg.h>
#include <crevasse/linear/matrix_operator.h>
#include <crevasse/linear/mumps.h>
#include <crevasse/linear/operator_check.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <crevasse_tests/cracked_block.h>
#include <crevasse_tests/lane_widths.h>
#include <crevasse_tests/tests.h>
#include <vector>

using namespace Crevasse;

namespace
{
  template <int dim>
  std::string
  name(const BlockKind &kind)
  {
    std::string text = std::to_string(dim) + "D, degree " +
                       std::to_string(kind.degree) + ", " +
                       std::to_string(kind.n_uniform) + " refinements";
    if (kind.n_tip > 0)
      text += ", " + std::to_string(kind.n_tip) + " at the tip";
    if (kind.jump != 1.)
      text += ", jumps";
    if (kind.volumetric_strain == VolumetricStrain::mean)
      text += ", mean dilatations";
    return text;
  }

  /** Entries between -1 and 1 where nothing is constrained, other ones for
   * each phase. */
  template <int dim>
  Vector
  some_vector(const CrackedBlock<dim> &block, const double phase = 1.)
  {
    Vector v;
    block.strain_operator.initialize(v);
    for (const auto i : v.locally_owned_elements())
      v(i) = block.space.constraints.is_constrained(i)
               ? 0.
               : std::sin(phase + 7. * double(i));
    return v;
  }

  double
  relative_difference(const Vector &a, const Vector &b)
  {
    Vector difference(b);
    difference -= a;
    return difference.linfty_norm() / b.linfty_norm();
  }

  /** Each point with its own stiffness. */
  template <int dim>
  PointValues<VoigtMatrix<dim>>
  varying(const CrackedBlock<dim> &block)
  {
    std::vector<VoigtMatrix<dim>> values(block.points.n_local_points,
                                         block.stiffness[0]);
    for (std::size_t p = 0; p < values.size(); ++p)
      values[p] *= 1. + 0.5 * std::sin(double(p));
    return PointValues<VoigtMatrix<dim>>(std::move(values));
  }

  /** The relative differences between A as a matrix and as products. */
  template <int dim>
  std::pair<double, double>
  differences(const BlockKind &kind, const bool varies)
  {
    const CrackedBlock<dim> block(MPI_COMM_WORLD, kind);
    const Vector            v = some_vector(block);
    const auto   stiffness    = varies ? varying(block) : block.stiffness;
    SparseMatrix matrix;
    assemble_stiffness(block.space, block.points, stiffness, matrix);
    const StiffnessOperator<dim> A(block.space, block.points, stiffness);
    Vector                       expected(v), result(v);
    multiply(matrix, expected, v);
    A.vmult(result, v);
    require_same_product(A, block.space, block.points, stiffness);

    // Where no hanging node adds to it.
    double of_diagonal = 0.;
    for (const auto i : v.locally_owned_elements())
      if (kind.n_tip == 0 && !block.space.constraints.is_constrained(i))
        of_diagonal =
          std::max(of_diagonal,
                   std::abs(A.diagonal()(i) / matrix.diag_element(i) - 1.));
    return {relative_difference(result, expected),
            dealii::Utilities::MPI::max(of_diagonal, MPI_COMM_WORLD)};
  }

  template <int dim>
  void
  compare_with_matrix(const BlockKind &kind)
  {
    for (const bool varies : {false, true})
      {
        double of_product = 0., of_diagonal = 0.;
        for_each_lane_width([&]() {
          const auto of_width = differences<dim>(kind, varies);
          of_product          = std::max(of_product, of_width.first);
          of_diagonal         = std::max(of_diagonal, of_width.second);
        });
        const std::string of_block =
          name<dim>(kind) + (varies ? ", varying" : "");
        check_below(of_block + ": product with A", of_product, 1e-12);
        check_below(of_block + ": diagonal of A", of_diagonal, 1e-12);
      }
  }

  /** A square whose left half has cells of 1/64 and its right half of 1/32. */
  std::shared_ptr<Mesh<2>>
  half_refined_square()
  {
    auto mesh = std::make_shared<Mesh<2>>(MPI_COMM_WORLD);
    dealii::GridGenerator::hyper_cube(*mesh);
    mesh->refine_global(5);
    for (const auto &cell : mesh->active_cell_iterators())
      if (cell->is_locally_owned() && cell->center()[0] < 0.5)
        cell->set_refine_flag();
    mesh->execute_coarsening_and_refinement();
    return mesh;
  }

  /** Whether the program refuses A of such a stiffness and mesh. */
  bool
  is_refused(const StiffnessOperator<2>        &A,
             const Space<2>                    &space,
             const QuadratureField<2>          &points,
             const PointValues<VoigtMatrix<2>> &stiffness)
  {
    try
      {
        require_same_product(A, space, points, stiffness);
      }
    catch (const NumericalError &)
      {
        return true;
      }
    return false;
  }

  /** x → x + a x². */
  void
  stretch(Mesh<2> &mesh, const double a)
  {
    dealii::GridTools::transform(
      [a](const dealii::Point<2> &x) {
        return dealii::Point<2>(x[0] + a * x[0] * x[0], x[1]);
      },
      mesh);
  }

  /** What the program asks of A before it solves with it. */
  void
  check_that_errors_are_found()
  {
    const auto mesh = half_refined_square();
    stretch(*mesh, 1e-8);
    const Space<2>           space(mesh, 1, {}, {});
    const QuadratureField<2> points(space);
    const VoigtMatrix<2>     K = isotropic_stiffness<2>(7., 0.3, false);
    const PointValues<VoigtMatrix<2>> stiffness(K);
    const StiffnessOperator<2>        A(space, points, stiffness);

    Vector v(A.diagonal());
    for (const auto i : v.locally_owned_elements())
      v(i) =
        space.constraints.is_constrained(i) ? 0. : std::sin(7. * double(i));
    Vector       expected(v), result(v);
    SparseMatrix matrix;
    assemble_stiffness(space, points, stiffness, matrix);
    multiply(matrix, expected, v);
    A.vmult(result, v);
    check_below("Widths of cells differ by 1e-8: product with A",
                relative_difference(result, expected),
                1e-12);

    check("A is not refused", !is_refused(A, space, points, stiffness));
    check("An error of 1e-9 in the product is found",
          is_refused(
            A, space, points, PointValues<VoigtMatrix<2>>((1. + 1e-9) * K)));
    // D, too, has the former geometry.
    stretch(*mesh, 1e-7);
    check("An error of 1e-7 in the geometry of A and D is found",
          is_refused(A, space, points, stiffness));
  }

  /** Conjugate gradients need (Bx, y) = (x, By) and (x, Bx) > 0 for the
   * preconditioner B and all vectors that vanish where something is constrained
   * or held, up to single precision; here with half of the lip held, hanging
   * nodes and jumps. */
  void
  check_preconditioner()
  {
    const CrackedBlock<2> block(MPI_COMM_WORLD,
                                {2, 4, 3, 1e2, VolumetricStrain::full});
    StiffnessOperator<2>  A(block.space, block.points, block.stiffness);
    GmgCg<2>              gmg(std::make_shared<MultigridLevels<2>>(block.space,
                                                      block.points),
                 A,
                 block.stiffness,
                 block.bounds.dofs);
    std::vector<dealii::types::global_dof_index> held;
    for (std::size_t k = 0; k < block.bounds.dofs.size(); k += 2)
      if (!block.space.constraints.is_constrained(block.bounds.dofs[k]))
        held.push_back(block.bounds.dofs[k]);
    gmg.hold(held);

    std::vector<Vector> x, Bx;
    for (const double phase : {1., 2., 4.})
      {
        x.push_back(some_vector(block, phase));
        for (const auto dof : held)
          x.back()(dof) = 0.;
        Bx.push_back(x.back());
        gmg.precondition(Bx.back(), x.back());
      }
    double asymmetry = 0.;
    bool   positive  = true;
    for (unsigned int i = 0; i < x.size(); ++i)
      {
        positive = positive && x[i] * Bx[i] > 0.;
        for (unsigned int j = 0; j < i; ++j)
          asymmetry = std::max(asymmetry,
                               std::abs(Bx[i] * x[j] - x[i] * Bx[j]) /
                                 (Bx[i].l2_norm() * x[j].l2_norm()));
      }
    // Single precision ends at 1e38.
    constexpr double                  unit = 1e60;
    const PointValues<VoigtMatrix<2>> in_other_units =
      transform(block.stiffness,
                block.points.n_local_points,
                [&](const VoigtMatrix<2> &K) -> VoigtMatrix<2> {
                  return unit * K;
                });
    const StiffnessOperator<2> scaled_A(block.space,
                                        block.points,
                                        in_other_units);
    GmgCg<2>                   scaled_gmg(gmg.levels,
                        scaled_A,
                        in_other_units,
                        block.bounds.dofs);
    scaled_gmg.hold(held);
    Vector scaled(x[0]);
    scaled_gmg.precondition(scaled, x[0]);
    scaled *= unit;
    check_below("Preconditioner: other units",
                relative_difference(scaled, Bx[0]),
                1e-4);
    check_below("Preconditioner: asymmetry", asymmetry, 1e-6);
    check("Preconditioner: positive", positive);
  }

  /** No level may move as a rigid body, though the first points have one
   * nearest vertex on coarser meshes and the last is a hanging node there. */
  void
  check_supports_on_levels()
  {
    using Supports = std::vector<FixedPoint<2>>;
    for (const Supports &supports :
         {Supports{{{0., 0.}, {{true, true}}},
                   {{1. / 64., 0.}, {{false, true}}}},
          Supports{{{0.5, 1. / 32.}, {{true, true}}},
                   {{1., 0.}, {{false, true}}}}})
      {
        section(supports[0].point[0] == 0. ? "supports near one vertex"
                                           : "support on a hanging node");
        const Space<2>           space(half_refined_square(), 1, {}, supports);
        const QuadratureField<2> points(space);
        const MultigridLevels<2> levels(space, points);
        bool                     are_held = true;
        for (unsigned int level = 0; level < levels.n_levels(); ++level)
          are_held =
            are_held && find_free_rigid_motions(levels.space(level)).empty();
        check("there is a coarser level", levels.n_levels() > 1);
        check("all levels are held", are_held);
      }
  }

  /** How solutions differ from those by MUMPS, and what they take. */
  struct Comparison
  {
    double      difference, difference_with_contact, difference_of_forces;
    double      closed_part;       ///< of the lip
    std::size_t iterations;        ///< without contact
    std::size_t iterations_closed; ///< with the whole lip held
    double      iterations_of_set; ///< for each active set
  };

  template <int dim>
  Comparison
  solve(const BlockKind &kind)
  {
    const CrackedBlock<dim> block(MPI_COMM_WORLD, kind);
    const Vector            b = block.loads();
    StiffnessOperator<dim>  A(block.space, block.points, block.stiffness);
    GmgCg<dim>   gmg(std::make_shared<MultigridLevels<dim>>(block.space,
                                                          block.points),
                   A,
                   block.stiffness,
                   block.bounds.dofs);
    SparseMatrix matrix;
    assemble_stiffness(block.space, block.points, block.stiffness, matrix);
    Mumps mumps(matrix);

    Vector direct(b), iterative(b);
    iterative = 0.;
    mumps.solve(direct, b, 0.);
    gmg.solve(iterative, b, 1e-10 * b.l2_norm());
    Comparison result;
    result.difference = relative_difference(iterative, direct);
    result.iterations = gmg.n_iterations();

    constexpr double       tolerance = 1e-12;
    const SignoriniProblem of_matrix(matrix, block.bounds);
    const SignoriniProblem of_operator(A, block.bounds);
    ActiveSet              with_mumps(of_matrix, mumps, tolerance, 1e-3, 100);
    ActiveSet              with_gmg(of_operator, gmg, tolerance, 1e-3, 100);
    std::vector<double>    expected, forces;
    direct    = 0.;
    iterative = 0.;
    with_mumps.solve(b, direct, expected);
    with_gmg.solve(b, iterative, forces);
    result.difference_with_contact = relative_difference(iterative, direct);
    double difference = 0., largest = 0.;
    int    n_closed = 0;
    for (std::size_t k = 0; k < forces.size(); ++k)
      {
        difference = std::max(difference, std::abs(forces[k] - expected[k]));
        largest    = std::max(largest, expected[k]);
        n_closed += expected[k] > 0. ? 1 : 0;
      }
    result.difference_of_forces =
      dealii::Utilities::MPI::max(difference, MPI_COMM_WORLD) /
      dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD);
    result.closed_part = dealii::Utilities::MPI::sum(n_closed, MPI_COMM_WORLD) /
                         double(of_operator.n_bounds());
    result.iterations_of_set = double(with_gmg.statistics().linear_iterations) /
                               with_gmg.statistics().vi_iterations;

    SolverStatistics counts;
    FaceSolver       closed(of_operator, gmg, counts);
    iterative = 0.;
    closed.solve(std::vector<bool>(block.bounds.dofs.size(), true),
                 b,
                 1e-10 * b.l2_norm(),
                 iterative);
    result.iterations_closed = counts.linear_iterations;
    return result;
  }

  /** Iterations on a family of meshes are alike. */
  void
  check_alike(const std::vector<Comparison> &family,
              const unsigned int             most_allowed,
              const unsigned int             spread_allowed)
  {
    const auto largest = [&](const auto member) {
      double value = 0.;
      for (const Comparison &comparison : family)
        if (!(comparison.*member <= value)) // nan counts
          value = comparison.*member;
      return value;
    };
    check_below("solutions without contact",
                largest(&Comparison::difference),
                1e-8);
    check_below("solutions with contact",
                largest(&Comparison::difference_with_contact),
                1e-9);
    check_below("contact forces",
                largest(&Comparison::difference_of_forces),
                1e-8);
    bool   in_part = true;
    double fewest  = 1e300;
    for (const Comparison &comparison : family)
      {
        in_part = in_part && comparison.closed_part > 0.02 &&
                  comparison.closed_part < 0.98;
        fewest = std::min(fewest, double(comparison.iterations));
      }
    check("a part of the lip is closed", in_part);
    check_below("iterations beyond the fewest",
                largest(&Comparison::iterations) - fewest,
                spread_allowed);
    check_below("iterations", largest(&Comparison::iterations), most_allowed);
    check_below("more iterations on a closed lip",
                largest(&Comparison::iterations_closed) -
                  largest(&Comparison::iterations),
                spread_allowed);
    check_below("iterations for a set",
                largest(&Comparison::iterations_of_set),
                most_allowed);
  }

  /** @param coarsest number of refinements; in space one less by default. */
  template <int dim>
  void
  check_family(const unsigned int degree, const unsigned int coarsest)
  {
    // deal.II's assertions would take ten minutes on the finer meshes in space.
#ifdef DEBUG
    const bool finest = dim == 2;
#else
    const bool finest = dim == 2 || is_full();
#endif
    const unsigned int first = finest ? coarsest : coarsest - 1;
    const auto         check_kind =
      [&](const std::string &kind, const bool tip, const double jump) {
        section(std::to_string(dim) + "D, degree " + std::to_string(degree) +
                ", " + kind);
        std::vector<Comparison> family;
        for (unsigned int n = first; n < first + 4 - dim; ++n)
          family.push_back(solve<dim>(
            {degree, n, tip ? 3U : 0U, jump, VolumetricStrain::full}));
        // Where materials meet at edges, convergence is slower:
        // doc/scaling.md.
        check_alike(family, jump == 1. ? 14 : 34, jump == 1. ? 3 : 6);
      };
    check_kind("uniform", false, 1.);
    check_kind("refined at the tip", true, 1.);
    check_kind("jumps of 100", false, 1e2);
  }
} // namespace

void
multigrid()
{
  for (const unsigned int n_tip : {0, 2})
    {
      compare_with_matrix<2>({1, 2, n_tip, 1e2, VolumetricStrain::full});
      compare_with_matrix<2>({1, 2, n_tip, 1., VolumetricStrain::mean});
      compare_with_matrix<2>({2, 2, n_tip, 1e2, VolumetricStrain::full});
      compare_with_matrix<3>({1, 1, n_tip, 1., VolumetricStrain::full});
      compare_with_matrix<3>({1, 1, n_tip, 1., VolumetricStrain::mean});
      compare_with_matrix<3>({2, 1, n_tip, 1e2, VolumetricStrain::full});
    }
  check_that_errors_are_found();
  check_preconditioner();
  check_supports_on_levels();
  check_family<2>(1, 4);
  check_family<2>(2, 3);
  check_family<3>(1, 3);
  check_family<3>(2, 2);
}
