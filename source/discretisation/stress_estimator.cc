// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/discretisation/cell_values.h>
#include <crevasse/discretisation/coarser_meshes.h>
#include <crevasse/discretisation/material_field.h>
#include <crevasse/discretisation/stress_estimator.h>
#include <crevasse/discretisation/stress_residual.h>

#include <deal.II/grid/grid_tools.h>

namespace Crevasse
{
  namespace
  {
    /** Voigt's norm of a compliance; that of an anisotropic one is made the
     * same in all directions of the body: it has its tensor's norm, and its
     * mean shear counts for what Voigt's norm adds. */
    template <int dim>
    double
    norm_of_compliance(const VoigtMatrix<dim> &S)
    {
      constexpr unsigned int n   = n_stress_components<dim>;
      double                 sum = 0., mean = 0., trace = 0.;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          {
            const double share = (i < 3 ? 1. : 0.5) * (j < 3 ? 1. : 0.5);
            sum += share * S[i][j] * S[i][j];
            if (i < dim && j < dim)
              mean += S[i][j];
            if (i == j && (i < dim || i >= 3))
              trace += (i < 3 ? 1. : 0.5) * S[i][i];
          }
      const double shear =
        2. * (trace - mean / dim) / (0.5 * dim * (dim + 1) - 1.);
      return std::sqrt(sum + 0.75 * (n - 3) * shear * shear);
    }



    /** Whether a stiffness is isotropic, not merely cubic. */
    template <int dim>
    bool
    is_alike_in_all_directions(const VoigtMatrix<dim> &K)
    {
      return is_isotropic<dim>(K) &&
             std::abs(K[0][0] - K[0][1] - 2. * K[3][3]) <= 1e-12 * K[0][0];
    }



    /** Sends values of cells to the ranks that see them. */
    template <int dim, typename Value>
    void
    send_to_ghosts(const dealii::Triangulation<dim> &mesh,
                   std::vector<Value>               &values)
    {
      dealii::GridTools::
        exchange_cell_data_to_ghosts<Value, dealii::Triangulation<dim>>(
          mesh,
          [&values](const auto &cell) {
            return values[cell->active_cell_index()];
          },
          [&values](const auto &cell, const Value &value) {
            values[cell->active_cell_index()] = value;
          });
    }
  } // namespace



  template <int dim>
  StressEstimator<dim>::StressEstimator(const Space<dim>           &space,
                                        const QuadratureField<dim> &points,
                                        const ContactBoundary<dim> &lip,
                                        const LoadParameters       &loads)
    : space(space)
    , points(points)
    , lip(lip)
    , loads(loads)
    , polynomials(space.mesh(), space.finite_element.degree)
    , largest(space.mesh().n_active_cells())
  {
  }



  template <int dim>
  void
  StressEstimator<dim>::look_at(const double              t,
                                const Vector             &stress,
                                const ContactForces      &contact_forces,
                                const MaterialState<dim> &material,
                                const Vector             *elastic_displacement)
  {
    // Factors of faces and cells of size h in the squared energy norm of the
    // error, from comparison with known errors.
    constexpr double of_faces = 1. / 16., of_cells = 1. / 16.;

    const std::vector<ResidualWeight<dim>> of_cells_seen = weights(material);
    const std::vector<double>              singular =
      singular_coefficients(elastic_displacement);
    const auto stiffness_at = [&](const std::size_t point) {
      return material.stiffness_factor * (*material.stiffness)[point];
    };
    Vector regular = stress;
    if (!singular.empty())
      for_each_point(space,
                     dealii::update_quadrature_points,
                     [&](const dealii::FEValues<dim> &values,
                         const unsigned int           q,
                         const std::size_t            point) {
                       const std::size_t offset =
                         point * n_stress_components<dim>;
                       QuadratureField<dim>::set(
                         regular,
                         offset,
                         QuadratureField<dim>::get(stress, offset) -
                           singular_stress(singular,
                                           values.quadrature_point(q),
                                           values.get_cell()->center(),
                                           stiffness_at(point)));
                     });
    const double        degree = space.finite_element.degree;
    StressResidual<dim> residual(
      space, polynomials, lip, loads, t, contact_forces);
    polynomials.fit(space, points, regular, residual.stress);
    dealii::Vector<double> squares(largest.size());
    // A face counts for both cells, and is integrated from the finer one.
    const auto add_jump = [&](const auto &cell, const unsigned int f) {
      const double half =
        0.5 * of_faces / degree * residual.jump(cell, f, of_cells_seen);
      squares(cell->active_cell_index()) += half;
      squares(cell->neighbor(f)->active_cell_index()) += half;
    };
    collectively(space.communicator(), [&]() {
      for (const auto &cell : owned_cells(polynomials.dof_handler))
        {
          const auto  &weight = of_cells_seen[cell->active_cell_index()];
          const double h      = cell->diameter() / std::sqrt(dim);
          double       whole =
            of_cells * h * h / (degree * degree) *
            residual.in_volume(cell, weight, [&](const auto &point) {
              return cut_off_force(singular,
                                   point,
                                   *cell,
                                   stiffness_at(points.first_point(cell)));
            });
          for (const unsigned int f : cell->face_indices())
            if (cell->at_boundary(f))
              whole +=
                of_faces / degree *
                residual.at_boundary(cell, f, weight, [&](const auto &point) {
                  return singular_stress(singular,
                                         point,
                                         cell->center(),
                                         stiffness_at(
                                           points.first_point(cell)));
                });
            else if (const auto other = cell->neighbor(f);
                     other->has_children())
              {
                for (unsigned int s = 0; s < cell->face(f)->n_children(); ++s)
                  if (const auto child = cell->neighbor_child_on_subface(f, s);
                      child->is_ghost())
                    add_jump(child, cell->neighbor_of_neighbor(f));
              }
            else if (other->is_ghost() || cell->neighbor_is_coarser(f) ||
                     cell->index() < other->index())
              add_jump(cell, f);
          squares(cell->active_cell_index()) += whole;
        }
    });
    for (const auto &cell : owned_cells(space.mesh()))
      {
        double &entry = largest(cell->active_cell_index());
        entry         = std::max(entry, squares(cell->active_cell_index()));
      }
    most_energy = std::max(most_energy, energy(stress, material));
  }



  template <int dim>
  dealii::Vector<float>
  StressEstimator<dim>::squares() const
  {
    dealii::Vector<float> relative(largest.size());
    if (most_energy > 0.)
      for (unsigned int i = 0; i < largest.size(); ++i)
        relative(i) = largest(i) / most_energy;
    return relative;
  }



  template <int dim>
  double
  StressEstimator<dim>::relative_error() const
  {
    const double sum = dealii::Utilities::MPI::sum(double(largest.l1_norm()),
                                                   space.communicator());
    return most_energy > 0. ? std::sqrt(sum / most_energy) : 0.;
  }



  template <int dim>
  std::vector<ResidualWeight<dim>>
  StressEstimator<dim>::weights(const MaterialState<dim> &material) const
  {
    std::vector<double> compliance;
    collectively(space.communicator(), [&]() {
      const auto norms =
        transform(*material.stiffness,
                  points.n_local_points,
                  [&](const VoigtMatrix<dim> &K) {
                    return norm_of_compliance<dim>(inverse<dim>(K)) /
                           material.stiffness_factor;
                  });
      compliance = cell_means(space, points, norms);
    });
    send_to_ghosts(space.mesh(), compliance);
    std::vector<ResidualWeight<dim>> all(compliance.begin(), compliance.end());
    const auto                      &distinct = material.stiffness->distinct();
    if (dealii::Utilities::MPI::min(std::all_of(distinct.begin(),
                                                distinct.end(),
                                                is_alike_in_all_directions<dim>)
                                      ? 1
                                      : 0,
                                    space.communicator()) == 1)
      return all;
    auto stiffness = cell_means(space, points, *material.stiffness);
    send_to_ghosts(space.mesh(), stiffness);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (compliance[i] > 0. && !is_alike_in_all_directions<dim>(stiffness[i]))
        all[i] = ResidualWeight<dim>(compliance[i], stiffness[i]);
    return all;
  }



  template <int dim>
  double
  StressEstimator<dim>::energy(const Vector             &stress,
                               const MaterialState<dim> &material) const
  {
    const auto compliance =
      transform(*material.stiffness,
                points.n_local_points,
                [](const VoigtMatrix<dim> &K) { return inverse<dim>(K); });
    double sum = 0.;
    for_each_point(space,
                   dealii::update_JxW_values,
                   [&](const dealii::FEValues<dim> &values,
                       const unsigned int           q,
                       const std::size_t            point) {
                     const VoigtVector<dim> s = QuadratureField<dim>::get(
                       stress, point * n_stress_components<dim>);
                     sum += s * (compliance[point] * s) * values.JxW(q);
                   });
    return dealii::Utilities::MPI::sum(sum, space.communicator()) /
           material.stiffness_factor;
  }



  template <int dim>
  std::vector<double>
  StressEstimator<dim>::singular_coefficients(const Vector *displacement) const
  {
    std::vector<double> coefficients;
    if (displacement != nullptr)
      for (auto k = space.singular_unknown(0); k < space.n_unknowns(); ++k)
        coefficients.push_back(dealii::Utilities::MPI::sum(
          displacement->in_local_range(k) ? (*displacement)(k) : 0.,
          space.communicator()));
    return coefficients;
  }



  template <int dim>
  VoigtVector<dim>
  StressEstimator<dim>::singular_stress(const std::vector<double> &coefficients,
                                        const dealii::Point<dim>  &point,
                                        const dealii::Point<dim>  &cell_center,
                                        const VoigtMatrix<dim> &stiffness) const
  {
    dealii::Tensor<2, dim> gradient;
    if constexpr (dim == 2)
      for (unsigned int k = 0; k < coefficients.size(); ++k)
        gradient +=
          coefficients[k] *
          space.singular_shapes()->functions[k].gradient(point, cell_center);
    return stiffness * voigt_strain<dim>(gradient);
  }



  template <int dim>
  dealii::Tensor<1, dim>
  StressEstimator<dim>::cut_off_force(
    const std::vector<double>            &coefficients,
    const dealii::Point<dim>             &point,
    const dealii::CellAccessor<dim, dim> &cell,
    const VoigtMatrix<dim>               &stiffness) const
  {
    dealii::Tensor<1, dim> force;
    if constexpr (dim == 2)
      for (unsigned int k = 0; k < coefficients.size(); ++k)
        {
          const SingularFunction &function =
            space.singular_shapes()->functions[k];
          const double r = point.distance(function.tip.position);
          if (r >= function.radius || std::isinf(function.radius))
            continue;
          SingularFunction whole(function);
          whole.radius = std::numeric_limits<double>::infinity();
          const double cut_off =
            std::pow(1. - std::pow(r / function.radius, 2), 3);
          const dealii::Point<2> center = cell.center();
          const double           step   = 1e-4 * cell.diameter();
          for (unsigned int j = 0; j < 2; ++j)
            for (const double side : {step, -step})
              {
                dealii::Point<2> there = point;
                there[j] += side;
                const VoigtVector<2> stress =
                  stiffness *
                  voigt_strain<2>(function.gradient(there, center) -
                                  cut_off * whole.gradient(there, center));
                for (unsigned int i = 0; i < 2; ++i)
                  force[i] += coefficients[k] * stress[voigt_index<2>(i, j)] /
                              (2. * side);
              }
        }
    return force;
  }



  template class StressEstimator<2>;
  template class StressEstimator<3>;
} // namespace Crevasse
