// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/cell_values.h>
#include <crevasse/discretisation/stress_estimator.h>
#include <crevasse/material/voigt_matrix.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    using Components = std::vector<dealii::Vector<double>>;

    template <int dim>
    Tensor<1, dim>
    value_of(const std::vector<Expression> &components,
             const Point<dim>              &point,
             const double                   t)
    {
      Tensor<1, dim> value;
      for (unsigned int d = 0; d < components.size(); ++d)
        if (!components[d].is_zero())
          value[d] = components[d].value(point, t);
      return value;
    }



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
      : fe(polynomials.dof_handler().get_fe())
      , cell(space.mapping(),
             fe,
             QGauss<dim>(fe.degree + 1),
             update_gradients | update_quadrature_points | update_JxW_values)
      , face(space.mapping(), fe, space.face_quadrature(), flags())
      , subface(space.mapping(), fe, space.face_quadrature(), flags())
      , face_of_other(space.mapping(),
                      fe,
                      space.face_quadrature(),
                      update_values)
      , subface_of_other(space.mapping(),
                         fe,
                         space.face_quadrature(),
                         update_values)
      , stress(polynomials.coefficients())
      , gradients(cell.n_quadrature_points,
                  std::vector<Tensor<1, dim>>(n_stress_components<dim>))
      , here(face.n_quadrature_points,
             dealii::Vector<double>(n_stress_components<dim>))
      , there(here)
    {
    }

    static UpdateFlags
    flags()
    {
      return update_values | update_normal_vectors | update_JxW_values |
             update_quadrature_points;
    }

    const FiniteElement<dim>                &fe;
    FEValues<dim>                            cell;
    FEFaceValues<dim>                        face;
    FESubfaceValues<dim>                     subface;
    FEFaceValues<dim>                        face_of_other;
    FESubfaceValues<dim>                     subface_of_other;
    Crevasse::Vector                         stress;
    std::vector<std::vector<Tensor<1, dim>>> gradients;
    Components                               here, there;
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
    const double              degree     = space.finite_element().degree;
    Workspace                 workspace(space, polynomials);
    const SingularStress<dim> singular(space, elastic_displacement);
    polynomials.fit(space,
                    points,
                    singular.is_zero()
                      ? stress
                      : regular_part(stress, singular, material),
                    workspace.stress);
    traction_residual.set_instant(t, contact_forces);
    collectively(space.communicator(), [&]() {
      for (const auto &cell : polynomials.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          {
            const double           c = compliance[cell->active_cell_index()];
            const double           h = cell->diameter() / std::sqrt(dim);
            const VoigtMatrix<dim> stiffness =
              material.stiffness_factor *
              (*material
                  .stiffness)[points.offset(cell) / n_stress_components<dim>];
            double faces = 0.;
            for (const unsigned int f : cell->face_indices())
              faces +=
                cell->at_boundary(f)
                  ? c *
                      boundary_residual(cell, f, singular, stiffness, workspace)
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
  Vector
  StressEstimator<dim>::regular_part(const Vector              &stress,
                                     const SingularStress<dim> &singular,
                                     const MaterialState<dim>  &material) const
  {
    Vector          regular = stress;
    CellValues<dim> cell_values(space, update_quadrature_points);
    for (const auto &cell : space.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          std::size_t offset = points.offset(cell);
          for (const Point<dim> &point :
               cell_values.reinit(cell).get_quadrature_points())
            {
              const VoigtMatrix<dim> K =
                material.stiffness_factor *
                (*material.stiffness)[offset / n_stress_components<dim>];
              QuadratureField<dim>::set(regular,
                                        offset,
                                        QuadratureField<dim>::get(stress,
                                                                  offset) -
                                          singular.at(point, K));
              offset += n_stress_components<dim>;
            }
        }
    return regular;
  }



  template <int dim>
  std::vector<double>
  StressEstimator<dim>::compliances(const MaterialState<dim> &material) const
  {
    std::vector<double> values(space.mesh().n_active_cells());
    collectively(space.communicator(), [&]() {
      const auto norms = transform(*material.stiffness,
                                   points.n_local_points(),
                                   [](const VoigtMatrix<dim> &K) {
                                     return inverse<dim>(K).norm();
                                   });
      for (const auto &cell : space.mesh().active_cell_iterators())
        if (cell->is_locally_owned())
          {
            const std::size_t first =
              points.offset(cell) / n_stress_components<dim>;
            const unsigned int n = space.quadrature(cell).size();
            double            &c = values[cell->active_cell_index()];
            for (unsigned int q = 0; q < n; ++q)
              c += norms[first + q] / (n * material.stiffness_factor);
          }
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
    CellValues<dim> cell_values(space, update_JxW_values);
    double          sum = 0.;
    for (const auto &cell : space.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const FEValues<dim> &values = cell_values.reinit(cell);
          std::size_t          offset = points.offset(cell);
          for (const unsigned int q : values.quadrature_point_indices())
            {
              const VoigtVector<dim> s =
                QuadratureField<dim>::get(stress, offset);
              const std::size_t point = offset / n_stress_components<dim>;
              sum += s * (compliance[point] * s) * values.JxW(q);
              offset += n_stress_components<dim>;
            }
        }
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
        Tensor<1, dim> residual =
          value_of<dim>(body_force, values.quadrature_point(q), t);
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            residual[i] += workspace.gradients[q][voigt_index<dim>(i, j)][j];
        integral += residual.norm_square() * values.JxW(q);
      }
    return integral;
  }



  template <int dim>
  double
  StressEstimator<dim>::boundary_residual(const Cell                &cell,
                                          const unsigned int         face,
                                          const SingularStress<dim> &singular,
                                          const VoigtMatrix<dim>    &stiffness,
                                          Workspace                 &workspace)
  {
    workspace.face.reinit(cell, face);
    workspace.face.get_function_values(workspace.stress, workspace.here);
    if (!singular.is_zero())
      for (const unsigned int q : workspace.face.quadrature_point_indices())
        {
          const VoigtVector<dim> stress =
            singular.at(workspace.face.quadrature_point(q), stiffness);
          for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
            workspace.here[q][c] += stress[c];
        }
    return size_of_face<dim>(workspace.face) *
           traction_residual.square(cell, face, workspace.face, workspace.here);
  }



  template <int dim>
  double
  StressEstimator<dim>::jump(const Cell                &cell,
                             const unsigned int         face,
                             const std::vector<double> &compliance,
                             Workspace                 &workspace) const
  {
    const auto between = [&](const FEFaceValuesBase<dim> &mine,
                             const FEFaceValuesBase<dim> &theirs,
                             const Cell                  &neighbor) {
      mine.get_function_values(workspace.stress, workspace.here);
      theirs.get_function_values(workspace.stress, workspace.there);
      double integral = 0.;
      for (const unsigned int q : mine.quadrature_point_indices())
        {
          dealii::Vector<double> difference = workspace.here[q];
          difference -= workspace.there[q];
          integral +=
            traction_of<dim>(difference, mine.normal_vector(q)).norm_square() *
            mine.JxW(q);
        }
      return size_of_face<dim>(mine) * integral *
             std::min(compliance[cell->active_cell_index()],
                      compliance[neighbor->active_cell_index()]);
    };

    const auto neighbor = cell->neighbor(face);
    if (neighbor->has_children())
      {
        double     sum   = 0.;
        const auto other = cell->neighbor_of_neighbor(face);
        for (unsigned int s = 0; s < cell->face(face)->n_children(); ++s)
          {
            const auto child = cell->neighbor_child_on_subface(face, s);
            workspace.subface.reinit(cell, face, s);
            workspace.face_of_other.reinit(child, other);
            sum += between(workspace.subface, workspace.face_of_other, child);
          }
        return sum;
      }
    workspace.face.reinit(cell, face);
    if (cell->neighbor_is_coarser(face))
      {
        const auto place = cell->neighbor_of_coarser_neighbor(face);
        workspace.subface_of_other.reinit(neighbor, place.first, place.second);
        return between(workspace.face, workspace.subface_of_other, neighbor);
      }
    workspace.face_of_other.reinit(neighbor, cell->neighbor_of_neighbor(face));
    return between(workspace.face, workspace.face_of_other, neighbor);
  }



  template class StressEstimator<2>;
  template class StressEstimator<3>;
} // namespace Crevasse
