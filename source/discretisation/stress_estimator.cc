// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/discretisation/cell_values.h>
#include <crevasse/discretisation/coarser_meshes.h>
#include <crevasse/discretisation/stress_estimator.h>
#include <crevasse/material/voigt_matrix.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_interface_values.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    double
    size_of_face(const FEFaceValuesBase<dim> &face)
    {
      double measure = 0.;
      for (const unsigned int q : face.quadrature_point_indices())
        measure += face.JxW(q);
      return std::pow(measure, 1. / (dim - 1));
    }
  } // namespace



  /** What evaluates the polynomials of the stress, and those themselves. */
  template <int dim>
  struct StressEstimator<dim>::Workspace
  {
    Workspace(const Space<dim> &space, const CellPolynomials<dim> &polynomials)
      : cell(space.mapping(),
             polynomials.dof_handler().get_fe(),
             QGauss<dim>(space.finite_element().degree + 1),
             update_gradients | update_quadrature_points | update_JxW_values)
      , faces(space.mapping(),
              polynomials.dof_handler().get_fe(),
              space.face_quadrature(),
              update_values | update_normal_vectors | update_JxW_values |
                update_quadrature_points)
      , stress(polynomials.coefficients())
      , gradients(cell.n_quadrature_points,
                  std::vector<Tensor<1, dim>>(n_stress_components<dim>))
      , here(space.face_quadrature().size(),
             dealii::Vector<double>(n_stress_components<dim>))
      , there(here)
    {
    }

    FEValues<dim>                            cell;
    FEInterfaceValues<dim>                   faces;
    Crevasse::Vector                         stress;
    std::vector<std::vector<Tensor<1, dim>>> gradients;
    std::vector<dealii::Vector<double>>      here, there;
  };



  template <int dim>
  StressEstimator<dim>::StressEstimator(const Space<dim>           &space,
                                        const QuadratureField<dim> &points,
                                        const ContactBoundary<dim> &lip,
                                        const LoadParameters       &loads)
    : space(space)
    , points(points)
    , body_force(*loads.body_force)
    , traction_residual(space, lip, loads)
    , polynomials(space.mesh(), space.finite_element().degree)
    , largest(space.mesh().n_active_cells())
  {
  }



  template <int dim>
  void
  StressEstimator<dim>::look_at(const double               t,
                                const Vector              &stress,
                                const std::vector<double> &contact_forces,
                                const MaterialState<dim>  &material,
                                const Vector              *elastic_displacement)
  {
    // Each at what a face (a cell) of the size h adds to the energy norm of the
    // error, by comparison with errors that are known.
    constexpr double of_faces = 1. / 16., of_cells = 1. / 16.;

    const std::vector<double> compliance = compliances(material);
    const std::vector<double> singular =
      singular_coefficients(elastic_displacement);
    const auto stiffness_at = [&](const std::size_t point) {
      return material.stiffness_factor * (*material.stiffness)[point];
    };
    Vector regular = stress;
    if (!singular.empty())
      for_each_point(space,
                     update_quadrature_points,
                     [&](const FEValues<dim> &values,
                         const unsigned int   q,
                         const std::size_t    point) {
                       const std::size_t offset =
                         point * n_stress_components<dim>;
                       QuadratureField<dim>::set(
                         regular,
                         offset,
                         QuadratureField<dim>::get(stress, offset) -
                           singular_stress(singular,
                                           values.quadrature_point(q),
                                           stiffness_at(point)));
                     });
    const double degree = space.finite_element().degree;
    Workspace    workspace(space, polynomials);
    polynomials.fit(space, points, regular, workspace.stress);
    traction_residual.set_instant(t, contact_forces);

    // h ∫ ‖what is left of the traction‖²
    const auto boundary_residual = [&](const Cell &cell, const unsigned int f) {
      workspace.faces.reinit(cell, f);
      const auto &face = workspace.faces.get_fe_face_values(0);
      face.get_function_values(workspace.stress, workspace.here);
      if (!singular.empty())
        for (const unsigned int q : face.quadrature_point_indices())
          {
            const VoigtVector<dim> added =
              singular_stress(singular,
                              face.quadrature_point(q),
                              stiffness_at(points.first_point(cell)));
            for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
              workspace.here[q][c] += added[c];
          }
      return size_of_face<dim>(face) *
             traction_residual.square(cell, f, face, workspace.here);
    };
    collectively(space.communicator(), [&]() {
      for (const auto &cell : polynomials.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          {
            const double c     = compliance[cell->active_cell_index()];
            const double h     = cell->diameter() / std::sqrt(dim);
            double       faces = 0.;
            for (const unsigned int f : cell->face_indices())
              faces += cell->at_boundary(f)
                         ? c * boundary_residual(cell, f)
                         : 0.5 * jump(cell, f, compliance, workspace);
            const double square = of_faces / degree * faces +
                                  of_cells * c * h * h / (degree * degree) *
                                    volume_residual(cell, t, workspace);
            double &entry = largest(cell->active_cell_index());
            entry         = std::max(entry, square);
          }
    });
    most_energy = std::max(most_energy, energy(stress, material));
  }



  template <int dim>
  std::vector<double>
  StressEstimator<dim>::singular_coefficients(const Vector *displacement) const
  {
    std::vector<double> coefficients;
    if (displacement != nullptr)
      for (auto k = space.dof_handler().n_dofs(); k < space.n_unknowns(); ++k)
        coefficients.push_back(Utilities::MPI::sum(
          displacement->in_local_range(k) ? (*displacement)(k) : 0.,
          space.communicator()));
    return coefficients;
  }



  template <int dim>
  VoigtVector<dim>
  StressEstimator<dim>::singular_stress(const std::vector<double> &coefficients,
                                        const Point<dim>          &point,
                                        const VoigtMatrix<dim> &stiffness) const
  {
    Tensor<2, dim> gradient;
    if constexpr (dim == 2)
      for (unsigned int k = 0; k < coefficients.size(); ++k)
        gradient += coefficients[k] *
                    space.singular_shapes()->functions().gradient(k, point);
    return stiffness * voigt_strain<dim>(gradient);
  }



  template <int dim>
  std::vector<double>
  StressEstimator<dim>::compliances(const MaterialState<dim> &material) const
  {
    std::vector<double> values;
    collectively(space.communicator(), [&]() {
      const auto norms =
        transform(*material.stiffness,
                  points.n_local_points(),
                  [&](const VoigtMatrix<dim> &K) {
                    return inverse<dim>(K).norm() / material.stiffness_factor;
                  });
      values = cell_means(space, points, norms);
    });
    GridTools::exchange_cell_data_to_ghosts<double, Triangulation<dim>>(
      space.mesh(),
      [&values](const auto &cell) { return values[cell->active_cell_index()]; },
      [&values](const auto &cell, const double value) {
        values[cell->active_cell_index()] = value;
      });
    return values;
  }



  template <int dim>
  double
  StressEstimator<dim>::energy(const Vector             &stress,
                               const MaterialState<dim> &material) const
  {
    const auto compliance =
      transform(*material.stiffness,
                points.n_local_points(),
                [](const VoigtMatrix<dim> &K) { return inverse<dim>(K); });
    double sum = 0.;
    for_each_point(space,
                   update_JxW_values,
                   [&](const FEValues<dim> &values,
                       const unsigned int   q,
                       const std::size_t    point) {
                     const VoigtVector<dim> s = QuadratureField<dim>::get(
                       stress, point * n_stress_components<dim>);
                     sum += s * (compliance[point] * s) * values.JxW(q);
                   });
    return Utilities::MPI::sum(sum, space.communicator()) /
           material.stiffness_factor;
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
  void
  StressEstimator<dim>::serialize(StateArchive &archive)
  {
    archive.on_cells(largest);
    archive.common(most_energy);
  }



  template <int dim>
  double
  StressEstimator<dim>::relative_error() const
  {
    const double sum =
      Utilities::MPI::sum(double(largest.l1_norm()), space.communicator());
    return most_energy > 0. ? std::sqrt(sum / most_energy) : 0.;
  }



  template <int dim>
  double
  StressEstimator<dim>::volume_residual(const Cell  &cell,
                                        const double t,
                                        Workspace   &workspace) const
  {
    FEValues<dim> &values = workspace.cell;
    values.reinit(cell);
    values.get_function_gradients(workspace.stress, workspace.gradients);
    double integral = 0.;
    for (const unsigned int q : values.quadrature_point_indices())
      {
        Tensor<1, dim> residual;
        for (unsigned int i = 0; i < body_force.size(); ++i)
          residual[i] = body_force[i].value(values.quadrature_point(q), t);
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            residual[i] += workspace.gradients[q][voigt_index<dim>(i, j)][j];
        integral += residual.norm_square() * values.JxW(q);
      }
    return integral;
  }



  template <int dim>
  double
  StressEstimator<dim>::jump(const Cell                &cell,
                             const unsigned int         face,
                             const std::vector<double> &compliance,
                             Workspace                 &workspace) const
  {
    constexpr auto whole = numbers::invalid_unsigned_int;
    double         sum   = 0.;
    const auto     add   = [&](const unsigned int subface,
                         const Cell        &other,
                         const unsigned int other_face,
                         const unsigned int other_subface) {
      workspace.faces.reinit(
        cell, face, subface, other, other_face, other_subface);
      const auto &mine = workspace.faces.get_fe_face_values(0);
      mine.get_function_values(workspace.stress, workspace.here);
      workspace.faces.get_fe_face_values(1).get_function_values(
        workspace.stress, workspace.there);
      double integral = 0.;
      for (const unsigned int q : mine.quadrature_point_indices())
        {
          workspace.here[q] -= workspace.there[q];
          integral += traction_of<dim>(workspace.here[q], mine.normal_vector(q))
                        .norm_square() *
                      mine.JxW(q);
        }
      sum += size_of_face<dim>(mine) * integral *
             std::min(compliance[cell->active_cell_index()],
                      compliance[other->active_cell_index()]);
    };

    const auto neighbor = cell->neighbor(face);
    if (neighbor->has_children())
      for (unsigned int s = 0; s < cell->face(face)->n_children(); ++s)
        add(s,
            cell->neighbor_child_on_subface(face, s),
            cell->neighbor_of_neighbor(face),
            whole);
    else if (cell->neighbor_is_coarser(face))
      {
        const auto place = cell->neighbor_of_coarser_neighbor(face);
        add(whole, neighbor, place.first, place.second);
      }
    else
      add(whole, neighbor, cell->neighbor_of_neighbor(face), whole);
    return sum;
  }



  template class StressEstimator<2>;
  template class StressEstimator<3>;
} // namespace Crevasse
