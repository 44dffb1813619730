// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/lip/friction.h>

#include <deal.II/dofs/dof_tools.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  Friction<dim>::Friction(const ContactBoundary<dim> &lip,
                          const DoFHandler<dim>      &dof_handler,
                          const Temperature<dim>     &temperature,
                          const LoadFormulas         &coefficients)
    : lip(lip)
    , temperature(temperature)
    , formulas{Expression("0")}
    , formula(lip.nodes.size())
  {
    const auto &all = lip.basis.nodes;
    for (const PlacedFormulas &placed : *coefficients)
      {
        const auto               &where = placed.boundaries;
        std::vector<unsigned int> acts(all.size(), where.is_automatic ? 1 : 0);
        if (!where.ids.empty())
          {
            const IndexSet dofs =
              DoFTools::extract_boundary_dofs(dof_handler,
                                              ComponentMask(),
                                              where.ids);
            for (unsigned int i = 0; i < all.size(); ++i)
              for (const types::global_dof_index side : all[i].sides)
                if (side != numbers::invalid_dof_index && dofs.is_element(side))
                  acts[i] = 1;
          }
        Utilities::MPI::max(acts, lip.communicator(), acts);
        for (unsigned int k = 0; k < lip.nodes.size(); ++k)
          if (formula[k] == 0 && acts[lip.nodes[k].number] != 0)
            formula[k] = formulas.size();
        const Expression &mu = placed.components.front();
        formulas.push_back(mu);
        varies = varies || mu.depends_on("t") ||
                 (mu.depends_on("theta") && temperature.depends_on_time());
      }
    if (!varies)
      set(0., constant);
  }



  template <int dim>
  double
  Friction<dim>::coefficient(const unsigned int node, const double t) const
  {
    const Expression &mu    = formulas[formula[node]];
    const Point<dim> &point = lip.nodes[node].point;
    const double      value = mu.value(Place<dim>{
           point, t, mu.depends_on("theta") ? temperature.value(point, t) : 0.});
    if (value < 0.)
      throw SceneError(
        "[Boundary] Friction coefficient = " + mu.formula() + ": is " +
        Text::from_number(value, 6) + " at " + Text::from_point(point) +
        " and t = " + Text::from_number(t, 6) + "; it must be at least 0.");
    return value;
  }



  template <int dim>
  void
  Friction<dim>::set(const double t, std::vector<double> &coefficients) const
  {
    coefficients.resize(lip.nodes.size());
    collectively(lip.communicator(), [&]() {
      for (unsigned int k = 0; k < coefficients.size(); ++k)
        coefficients[k] = coefficient(k, t);
    });
  }



  template <int dim>
  void
  Friction<dim>::evaluate(const double t, FrictionState &state) const
  {
    if (varies)
      set(t, state.coefficients);
    else if (state.coefficients.empty())
      state.coefficients = constant;
  }



  template <int dim>
  void
  Friction<dim>::commit(const Vector &displacement, FrictionState &state) const
  {
    for (unsigned int c = 0; c < dim - 1; ++c)
      for (unsigned int k = 0; k < lip.nodes.size(); ++k)
        if (const auto unknown = lip.nodes[k].sliding[c];
            unknown != numbers::invalid_dof_index)
          state.reference[c][k] = displacement(unknown);
  }



  template <int dim>
  FrictionState
  Friction<dim>::at_rest() const
  {
    FrictionState state;
    state.reference.assign(dim - 1, std::vector<double>(lip.nodes.size()));
    return state;
  }



  template class Friction<2>;
  template class Friction<3>;
} // namespace Crevasse
