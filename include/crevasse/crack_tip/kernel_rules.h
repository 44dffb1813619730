// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_kernel_rules_h
#define crevasse_crack_tip_kernel_rules_h

#include <crevasse/discretisation/space.h>

#include <deal.II/fe/fe_dgq.h>

namespace Crevasse
{
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

    /** Evaluates a cell. @param is_at_tip whether the kernel is ~ r^(−3/2). */
    const dealii::FEValues<dim> &
    reinit(
      const typename dealii::Triangulation<dim>::active_cell_iterator &cell,
      const bool is_at_tip)
    {
      dealii::FEValues<dim> &values = is_at_tip ? fine : usual;
      values.reinit(cell);
      return values;
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
