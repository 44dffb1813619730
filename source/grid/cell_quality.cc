// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/grid/cell_quality.h>
#include <crevasse/grid/curved_edges.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  std::vector<double>
  scaled_jacobians(const Triangulation<dim> &mesh)
  {
    const unsigned int    most = has_curved_edges(mesh) ? 2 : 1;
    const FE_Nothing<dim> no_unknowns;
    std::vector<double>   all(mesh.n_active_cells(), 1.);
    for (unsigned int degree = 1; degree <= most; ++degree)
      {
        const MappingQ<dim> mapping(degree);
        FEValues<dim>       values(mapping,
                             no_unknowns,
                             QGaussLobatto<dim>(degree + 1),
                             update_jacobians);
        for (const auto &cell : mesh.active_cell_iterators())
          {
            values.reinit(cell);
            double &worst = all[cell->active_cell_index()];
            for (const auto &jacobian : values.get_jacobians())
              {
                const auto columns = jacobian.transpose();
                double     edges   = 1.;
                for (unsigned int d = 0; d < dim; ++d)
                  edges *= columns[d].norm();
                worst =
                  std::min(worst,
                           edges > 0. ? jacobian.determinant() / edges : 0.);
              }
          }
      }
    return all;
  }



  template decltype(scaled_jacobians<2>) scaled_jacobians<2>;
  template decltype(scaled_jacobians<3>) scaled_jacobians<3>;
} // namespace Crevasse
