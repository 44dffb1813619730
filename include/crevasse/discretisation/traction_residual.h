// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_traction_residual_h
#define crevasse_discretisation_traction_residual_h

#include <crevasse/base/expression.h>
#include <crevasse/discretisation/contact_boundary.h>
#include <crevasse/discretisation/space.h>
#include <crevasse/parameters/parameters.h>

#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/vector.h>

#include <vector>

namespace Crevasse
{
  /** s n, for the stress components at a point. */
  template <int dim>
  dealii::Tensor<1, dim>
  traction_of(const dealii::Vector<double> &stress,
              const dealii::Tensor<1, dim> &normal);

  /**
   * What of the traction s n of a stress the boundary does not bear: on loaded
   * faces the difference to the load, on planes of symmetry and lips what is
   * tangential, on lips also the normal traction plus the contact pressure,
   * and nothing where the body is clamped.
   */
  template <int dim>
  class TractionResidual
  {
  public:
    /** All arguments must outlive this object. */
    TractionResidual(const Space<dim>           &space,
                     const ContactBoundary<dim> &lip,
                     const LoadParameters       &loads);

    /** For the time to come. Collective.
     *
     * @param contact_forces of the nodes of the lip on this rank. */
    void
    set_instant(const double t, const std::vector<double> &contact_forces);

    /** ∫ ‖residual‖² over the face @p face of @p cell.
     *
     * @param values of that face, with its points, normals and weights.
     * @param stress at its points. */
    double
    square(
      const typename dealii::Triangulation<dim>::active_cell_iterator &cell,
      const unsigned int                                               face,
      const dealii::FEFaceValuesBase<dim>                             &values,
      const std::vector<dealii::Vector<double>>                       &stress);

  private:
    const Space<dim>             &space;
    const ContactBoundary<dim>   &lip;
    const std::vector<Expression> loads;
    double                        instant = 0.;
    Vector                        pressure; ///< at the dofs of the lip

    dealii::FEFaceValues<dim>           displacement;
    std::vector<dealii::Vector<double>> pressures; ///< at the points
  };
} // namespace Crevasse

#endif
