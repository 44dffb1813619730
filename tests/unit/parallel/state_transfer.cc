// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// What goes over from a mesh to the one that it becomes: polynomials exactly,
// whatever else with the same integral.

#include <crevasse/discretisation/strain_operator.h>
#include <crevasse/model/state_transfer.h>

#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/numerics/vector_tools.h>

#include <crevasse_tests/tests.h>
#include <random>

using namespace Crevasse;

namespace
{
  constexpr unsigned int n_branches = 2;

  template <int dim>
  double
  polynomial(const dealii::Point<dim> &point,
             const unsigned int        degree,
             const unsigned int        number)
  {
    double value = 1. + number;
    for (unsigned int d = 0; d < dim; ++d)
      value += (1. + d + 0.5 * number) * std::pow(point[d], degree);
    return value + std::pow(point[0] * point[1], degree);
  }



  template <int dim>
  struct Displacement : dealii::Function<dim>
  {
    explicit Displacement(const unsigned int degree)
      : dealii::Function<dim>(dim)
      , degree(degree)
    {
    }

    double
    value(const dealii::Point<dim> &point,
          const unsigned int        component) const override
    {
      double value = component;
      for (unsigned int d = 0; d < dim; ++d)
        value += (d + 1. + component) * std::pow(point[d], degree);
      return value;
    }

    const unsigned int degree;
  };



  /** A space and a field on its points; the mesh is someone else's. */
  template <int dim>
  struct Fields
  {
    Fields(const std::shared_ptr<Mesh<dim>> &mesh, const unsigned int degree)
      : space(mesh, degree, BoundaryRoles(), {})
      , points(space)
      , strain_operator(space, points)
    {
      strain_operator.initialize(displacement);
      points.initialize(strain, n_branches);
    }

    /** f(place, point, number of the value at this point) */
    template <typename Function>
    void
    for_each_value(const Function &f)
    {
      dealii::FEValues<dim> values(space.mapping,
                                   space.finite_element,
                                   space.quadratures[0],
                                   dealii::update_quadrature_points);
      for (const auto &cell : space.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            values.reinit(cell);
            std::size_t place = n_branches * points.offset(cell);
            for (const unsigned int q : values.quadrature_point_indices())
              for (unsigned int k = 0;
                   k < n_branches * n_stress_components<dim>;
                   ++k)
                f(place++, values.quadrature_point(q), k);
          }
    }

    const Space<dim>           space;
    const QuadratureField<dim> points;
    const StrainOperator<dim>  strain_operator;
    Vector                     displacement, strain;
  };



  /** Cells that are no parallelograms, and hanging nodes. */
  template <int dim>
  std::shared_ptr<Mesh<dim>>
  make_mesh(const double distortion)
  {
    constexpr unsigned int n_cells = (dim == 2 ? 5 : 3);
    auto                   mesh = std::make_shared<Mesh<dim>>(MPI_COMM_WORLD);
    dealii::GridGenerator::subdivided_hyper_cube(*mesh, n_cells);
    // The same on all ranks, which all know the whole coarse mesh.
    dealii::GridTools::transform(
      [distortion](const dealii::Point<dim> &point) {
        dealii::Point<dim> moved = point;
        for (unsigned int d = 0; d < dim; ++d)
          moved[d] += distortion / n_cells *
                      std::sin(40. * point[0] + 70. * point[dim - 1] + 2. * d);
        return moved;
      },
      *mesh);
    for (const auto &cell : mesh->active_cell_iterators())
      if (cell->is_locally_owned() &&
          (cell->center()[0] < 0.3 || cell->center()[1] > 0.6))
        cell->set_refine_flag();
    mesh->execute_coarsening_and_refinement();
    return mesh;
  }



  /** One half of the cells is divided, what can be joined of the other is. */
  template <int dim>
  void
  flag(Mesh<dim> &mesh)
  {
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          if (cell->center()[0] < 0.4)
            cell->set_refine_flag();
          else
            cell->set_coarsen_flag();
        }
  }



  template <int dim>
  void
  transfer(const unsigned int degree, const double distortion)
  {
    const std::shared_ptr<Mesh<dim>>       mesh = make_mesh<dim>(distortion);
    const bool                             is_polynomial = distortion == 0.;
    std::mt19937                           generator(1980);
    std::uniform_real_distribution<double> uniform(-1., 1.);

    auto before = std::make_unique<Fields<dim>>(mesh, degree);
    before->for_each_value([&](const std::size_t         place,
                               const dealii::Point<dim> &point,
                               const unsigned int        k) {
      before->strain.local_element(place) =
        is_polynomial ? polynomial<dim>(point, degree, k) : uniform(generator);
    });
    dealii::VectorTools::interpolate(before->space.mapping,
                                     before->space.dof_handler,
                                     Displacement<dim>(degree),
                                     before->displacement);
    before->space.constraints.set_zero(before->displacement);
    const FieldNorms<dim> norms_before =
      field_norms(before->space, before->strain, n_branches);
    const auto cells_before = mesh->n_global_active_cells();

    flag<dim>(*mesh);
    StateTransfer<dim> state(*mesh,
                             before->space,
                             before->points,
                             before->displacement,
                             before->strain,
                             n_branches);
    before.reset();
    state.adapt();
    Fields<dim> after(mesh, degree);
    state.take(after.space, after.points, after.displacement, after.strain);

    const std::string name = std::to_string(dim) + "D, Q" +
                             std::to_string(degree) +
                             (is_polynomial ? "" : ", distorted cells");
    check(name + ": another mesh, with joined cells",
          mesh->n_global_active_cells() != cells_before);
    const FieldNorms<dim> norms =
      field_norms(after.space, after.strain, n_branches);
    check_below(name + ": change of the integral",
                (norms.integral - norms_before.integral).norm() /
                  norms_before.l2,
                1e-13);
    if (!is_polynomial)
      {
        check(name + ": joining cells takes from the norm",
              norms.l2 < (1. - 1e-3) * norms_before.l2);
        return;
      }
    double worst = 0.;
    after.for_each_value([&](const std::size_t         place,
                             const dealii::Point<dim> &point,
                             const unsigned int        k) {
      worst = std::max(worst,
                       std::abs(after.strain.local_element(place) -
                                polynomial<dim>(point, degree, k)));
    });
    check_below(name + ": error of a polynomial",
                dealii::Utilities::MPI::max(worst, MPI_COMM_WORLD),
                1e-12);
    Vector expected;
    after.strain_operator.initialize(expected);
    dealii::VectorTools::interpolate(after.space.mapping,
                                     after.space.dof_handler,
                                     Displacement<dim>(degree),
                                     expected);
    after.space.constraints.set_zero(expected);
    expected -= after.displacement;
    check_below(name + ": error of a polynomial displacement",
                expected.linfty_norm(),
                1e-12);
  }
} // namespace

void
state_transfer()
{
  for (const unsigned int degree : {1, 2})
    {
      transfer<2>(degree, 0.);
      transfer<2>(degree, 0.2);
      transfer<3>(degree, 0.);
    }
  transfer<3>(2, 0.2);
}
