// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Properties of the material at crack tips.

#include <crevasse/base/problems.h>
#include <crevasse/model/body.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/mapping_q1.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Side of the line or circle of a crack on which a cell is, as the sign
     * of Y there; 0 if it is on both. */
    double
    side_of(const TriaAccessor<2, 2, 2> &cell, const CrackTip &tip)
    {
      bool above = false, below = false;
      for (const unsigned int v : cell.vertex_indices())
        if (const Point<2> local = tip.local(cell.vertex(v));
            !tip.is_on_curve(local))
          (tip.height(local) > 0. ? above : below) = true;
      return above && below ? 0. : (above ? 1. : -1.);
    }
  } // namespace



  std::optional<VoigtMatrix<2>>
  limit_at(const CrackTip                 &tip,
           const Triangulation<2>         &mesh,
           const Property<VoigtMatrix<2>> &property,
           const Temperature<2>           &temperature,
           const double                    t,
           const double                    side)
  {
    // So close to the tip a smooth formula changes by less than a jump.
    constexpr double              close = 1e-6, jump = 1e-3;
    const QGauss<2>               rule(4);
    const MappingQ1<2>            mapping;
    std::optional<VoigtMatrix<2>> limit;
    for (const auto &cell : mesh.cell_iterators_on_level(0))
      for (const unsigned int v : cell->vertex_indices())
        if (cell->vertex(v).distance(tip.position) <= 1e-8 * cell->diameter())
          {
            const auto at = [&](const Point<2> &point) {
              return property.at(Place<2>{
                point, t, temperature.value(point, t), cell->material_id()});
            };
            if (!limit && side == 0.)
              limit = at(tip.position);
            const double of_cell = side_of(*cell, tip);
            if (side != 0. && of_cell == 0.)
              return {};
            if (side * of_cell < 0.)
              break;
            for (const Point<2> &unit : rule.get_points())
              {
                const Point<2> place =
                  tip.position +
                  close * (mapping.transform_unit_to_real_cell(cell, unit) -
                           tip.position);
                // The cell's edges may be curved.
                if (side * tip.height(tip.local(place)) < 0.)
                  continue;
                const VoigtMatrix<2> here = at(place);
                if (!limit)
                  limit = here;
                if ((here - *limit).norm() > jump * here.norm())
                  return {};
              }
          }
    AssertThrow(limit, ExcInternalError());
    return limit;
  }



  VoigtMatrix<2>
  stiffness_at(const CrackTip         &tip,
               const Triangulation<2> &mesh,
               const MaxwellLaw<2>    &law,
               const Temperature<2>   &temperature,
               const double            t,
               const std::string      &wanted_by)
  {
    const auto stiffness = limit_at(tip, mesh, law.stiffness, temperature, t);
    if (!stiffness)
      throw SceneError(wanted_by + ": the stiffness at the crack tip " +
                       Text::from_point(tip.position) +
                       " is not the same on all sides of it: a crack between "
                       "two materials has other fields. K is known of a "
                       "[Boundary] Crack or Open crack if two isotropic "
                       "materials meet on its continuation, which is straight "
                       "or the same arc of a circle, along edges of cells; "
                       "singular functions are not.");
    return *stiffness;
  }
} // namespace Crevasse
