// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_reactions_h
#define crevasse_postprocess_reactions_h

#include <crevasse/model/body.h>
#include <crevasse/time/observer.h>

namespace Crevasse
{
  /** Forces that displaced and clamped boundaries exert on the body: sums of
   * the nodal forces of the stress, less those of the loads. A node of several
   * such boundaries counts for the first, displaced ones before clamped ones.
   */
  template <int dim>
  class Reactions
  {
  public:
    /** Arguments must outlive this object. Collective. */
    Reactions(const Body<dim> &body, const LoadParameters &loads);

    /** Names "F_x_3" of the components of each boundary, by its id. */
    std::vector<std::string>
    columns() const;

    /** Forces in the order of the columns; in a body of revolution per radian.
     * Collective.
     * @param stress at the quadrature points.
     * @param t within the period. */
    std::vector<double>
    forces(const Vector &stress, const double t) const;

  private:
    void
    find_loads(const NodalFunctions<dim> &functions);

    /** Factor of the stress at a point. */
    struct StressFactor
    {
      std::size_t      offset;
      unsigned int     column;
      VoigtVector<dim> factor;
    };

    /** Share of a component of a load. */
    struct Share
    {
      unsigned int column;
      unsigned int component;
      double       part;
    };

    /** A point with a load: in the volume, or on a boundary. */
    struct LoadedPoint
    {
      dealii::types::boundary_id id;
      dealii::Point<dim>         point;
      dealii::Tensor<1, dim>     normal;
      std::vector<Share>         shares;
    };

    const Body<dim>                                       &body;
    const LoadParameters                                  &loads;
    const std::vector<std::pair<unsigned int, Expression>> volume_forces;
    std::vector<dealii::types::boundary_id>                ids;
    std::vector<StressFactor>                              of_stress;
    std::vector<LoadedPoint>                               loaded;
  };
} // namespace Crevasse

#endif
