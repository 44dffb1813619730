// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_kernel_rules_h
#define crevasse_crack_tip_kernel_rules_h

#include <crevasse/discretisation/space.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/grid/grid_tools.h>

namespace Crevasse
{
  /** Gauss points clustered at both ends, x = u³(10 − 15u + 6u²): for products
   * with powers of r to −2 at a vertex or an edge of cells at the tip or front,
   * and with r^(−1/2) on the lip. */
  inline dealii::Quadrature<1>
  crowded_rule(const unsigned int n)
  {
    const dealii::QGauss<1>       gauss(n);
    std::vector<dealii::Point<1>> points;
    std::vector<double>           weights;
    for (unsigned int k = 0; k < n; ++k)
      {
        const double u = gauss.point(k)[0], v = 1. - u;
        points.emplace_back(u * u * u * (10. - 15. * u + 6. * u * u));
        weights.push_back(gauss.weight(k) * 30. * u * u * v * v);
      }
    return {points, weights};
  }



  /** For cells with quadrature rule 0: evaluates the polynomials through its
   * points at the points of a rule fine enough for the product of polynomials
   * with the kernel of an interaction integral. */
  template <int dim>
  class KernelRules
  {
  public:
    /** @param usual rule for most cells. @param fine at the tip or front. */
    KernelRules(const Space<dim>              &space,
                const dealii::Quadrature<dim> &usual,
                const dealii::Quadrature<dim> &fine)
      : polynomials(dealii::QGauss<1>(points_per_direction(space)))
      , usual(space.mapping, polynomials, usual, flags)
      , fine(space.mapping, polynomials, fine, flags)
    {
    }

    /** Number of points per direction of quadrature rule 0. */
    static unsigned int
    points_per_direction(const Space<dim> &space)
    {
      return std::lround(std::pow(space.quadratures[0].size(), 1. / dim));
    }

    /** Evaluates a cell. @param is_at_tip whether the kernel is singular. */
    const dealii::FEValues<dim> &
    reinit(
      const typename dealii::Triangulation<dim>::active_cell_iterator &cell,
      const bool is_at_tip)
    {
      dealii::FEValues<dim> &values = is_at_tip ? fine : usual;
      values.reinit(cell);
      return values;
    }

    /** Value of polynomial @p p of a cell at its vertex next to @p tip. */
    double
    limit(const typename dealii::Triangulation<dim>::active_cell_iterator &cell,
          const unsigned int                                               p,
          const dealii::Point<dim> &tip) const
    {
      const unsigned int vertex =
        dealii::GridTools::find_closest_vertex_of_cell<dim, dim>(cell, tip);
      return polynomials.shape_value(
        p, dealii::GeometryInfo<dim>::unit_cell_vertex(vertex));
    }

  private:
    const dealii::UpdateFlags flags = dealii::update_values |
                                      dealii::update_quadrature_points |
                                      dealii::update_JxW_values;
    const dealii::FE_DGQArbitraryNodes<dim> polynomials;
    dealii::FEValues<dim>                   usual, fine;
  };
} // namespace Crevasse

#endif
