// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_stress_estimator_h
#define crevasse_discretisation_stress_estimator_h

#include <crevasse/base/collectively.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/discretisation/cell_polynomials.h>
#include <crevasse/discretisation/cell_values.h>
#include <crevasse/discretisation/coarser_meshes.h>
#include <crevasse/discretisation/contact_boundary.h>
#include <crevasse/discretisation/material_field.h>
#include <crevasse/discretisation/quadrature_field.h>
#include <crevasse/discretisation/space.h>
#include <crevasse/discretisation/stress_residual.h>
#include <crevasse/material/voigt_matrix.h>
#include <crevasse/parameters/parameters.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace Crevasse
{
  /**
   * How far stresses are from equilibrium, cell by cell, in the norm of their
   * elastic energy: with the compliance c (1/stress) of the cell
   *
   *     16 η² = c h²/p² ‖div s + φ₁‖² + c h/p (½ ‖[s n]‖² + ‖s n − φ₂‖² + …)
   *
   * over the cell, its inner faces and its faces at the boundary, where "…"
   * stands for tangential tractions on planes of symmetry and lips, and for
   * the normal one of the lip plus the contact pressure: that must vanish
   * where the lip is open, and bear the contact force where it is closed. The
   * stress is what the points have, not what the displacement alone would
   * cause, so that it contains the viscous strain.
   *
   * Looks at as many states as wanted; what counts for a cell is the largest
   * of its estimates.
   */
  template <int dim>
  class StressEstimator
  {
  public:
    /** All arguments must outlive this object. */
    StressEstimator(const Space<dim>           &space,
                    const QuadratureField<dim> &points,
                    const ContactBoundary<dim> &lip,
                    const LoadParameters       &loads)
      : space(space)
      , points(points)
      , lip(lip)
      , loads(loads)
      , polynomials(space.mesh(), space.finite_element().degree)
      , largest(space.mesh().n_active_cells())
    {
    }

    /** Collective.
     *
     * @param t Instant within the period.
     * @param contact_forces of the nodes of the lip on this rank.
     * @param elastic_displacement whose stress it is, where nothing creeps: the
     * stress of singular functions then counts as what it is, and is not
     * approximated by polynomials. */
    void
    look_at(const double               t,
            const Vector              &stress,
            const std::vector<double> &contact_forces,
            const MaterialState<dim>  &material,
            const Vector              *elastic_displacement = nullptr)
    {
      // Each at what a face (a cell) of the size h adds to the energy norm of
      // the error, by comparison with errors that are known.
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
                                             stiffness_at(point)));
                       });
      const double        degree = space.finite_element().degree;
      StressResidual<dim> residual(
        space, polynomials, lip, loads, t, contact_forces);
      polynomials.fit(space, points, regular, residual.stress);
      collectively(space.communicator(), [&]() {
        for (const auto &cell : owned_cells(polynomials.dof_handler()))
          {
            const double c     = compliance[cell->active_cell_index()];
            const double h     = cell->diameter() / std::sqrt(dim);
            double       faces = 0.;
            for (const unsigned int f : cell->face_indices())
              faces +=
                cell->at_boundary(f)
                  ? c * residual.at_boundary(cell,
                                             f,
                                             [&](const auto &point) {
                                               return singular_stress(
                                                 singular,
                                                 point,
                                                 stiffness_at(
                                                   points.first_point(cell)));
                                             })
                  : 0.5 * residual.jump(cell, f, compliance);
            const double square = of_faces / degree * faces +
                                  of_cells * c * h * h / (degree * degree) *
                                    residual.in_volume(cell);
            double &entry = largest(cell->active_cell_index());
            entry         = std::max(entry, square);
          }
      });
      most_energy = std::max(most_energy, energy(stress, material));
    }

    /** The squares of the largest estimates so far over the largest energy, by
     * active cell index. */
    dealii::Vector<float>
    squares() const
    {
      dealii::Vector<float> relative(largest.size());
      if (most_energy > 0.)
        for (unsigned int i = 0; i < largest.size(); ++i)
          relative(i) = largest(i) / most_energy;
      return relative;
    }

    /** ∫ s·K⁻¹s of the state where it is largest; 0 without stress. */
    double
    largest_energy() const
    {
      return most_energy;
    }

    /** The root of their sum over that of the largest energy norm of the
     * stress so far; 0 without stress. Collective. */
    double
    relative_error() const
    {
      const double sum = dealii::Utilities::MPI::sum(double(largest.l1_norm()),
                                                     space.communicator());
      return most_energy > 0. ? std::sqrt(sum / most_energy) : 0.;
    }

    void
    serialize(StateArchive &archive)
    {
      archive.on_cells(largest);
      archive.common(most_energy);
    }

  private:
    /** The compliance of the cells that this rank sees. */
    std::vector<double>
    compliances(const MaterialState<dim> &material) const
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
      dealii::GridTools::
        exchange_cell_data_to_ghosts<double, dealii::Triangulation<dim>>(
          space.mesh(),
          [&values](const auto &cell) {
            return values[cell->active_cell_index()];
          },
          [&values](const auto &cell, const double value) {
            values[cell->active_cell_index()] = value;
          });
      return values;
    }

    /** ∫ s·K⁻¹s over all ranks. */
    double
    energy(const Vector &stress, const MaterialState<dim> &material) const
    {
      const auto compliance =
        transform(*material.stiffness,
                  points.n_local_points(),
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

    /** The coefficients c_k of singular functions; none if there is no
     * displacement, as without such functions. */
    std::vector<double>
    singular_coefficients(const Vector *displacement) const
    {
      std::vector<double> coefficients;
      if (displacement != nullptr)
        for (auto k = space.dof_handler().n_dofs(); k < space.n_unknowns(); ++k)
          coefficients.push_back(dealii::Utilities::MPI::sum(
            displacement->in_local_range(k) ? (*displacement)(k) : 0.,
            space.communicator()));
      return coefficients;
    }

    /** K Σ c_k Dψ_k, not shifted: what is left without it is the stress of
     * polynomials. w₁ and w₃ are in equilibrium and leave the lip free; what D
     * lacks is left out of account, for an elastic body has hardly any of it.
     */
    VoigtVector<dim>
    singular_stress(const std::vector<double> &coefficients,
                    const dealii::Point<dim>  &point,
                    const VoigtMatrix<dim>    &stiffness) const
    {
      dealii::Tensor<2, dim> gradient;
      if constexpr (dim == 2)
        for (unsigned int k = 0; k < coefficients.size(); ++k)
          gradient += coefficients[k] *
                      space.singular_shapes()->functions().gradient(k, point);
      return stiffness * voigt_strain<dim>(gradient);
    }

    const Space<dim>           &space;
    const QuadratureField<dim> &points;
    const ContactBoundary<dim> &lip;
    const LoadParameters       &loads;
    const CellPolynomials<dim>  polynomials;
    dealii::Vector<double>      largest; ///< of the squares
    double                      most_energy = 0.;
  };
} // namespace Crevasse

#endif
