// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_front_region_h
#define crevasse_crack_tip_front_region_h

#include <crevasse/crack_tip/square_region.h>
#include <crevasse/discretisation/space.h>
#include <crevasse/grid/front_curve.h>

#include <array>

namespace Crevasse
{
  /** The vertices of a mesh on the crack front, and the tube around it, in
   * which the body has no boundary but the lips, the plane of symmetry and the
   * planes across the ends of the front. Distances are max(|X|, |Y|). */
  class FrontRegion : public SquareRegion
  {
  public:
    /** Collective. @throw SceneError as FrontCurve does, or if the front of the
     * refined mesh is not smooth, or another boundary too close. */
    FrontRegion(const Space<3> &space, const std::string &wanted_by);

    const FrontCurve curve;

    /** Vertex of the active mesh on the front, hanging or not. */
    struct Vertex
    {
      dealii::Point<3> point;
      unsigned int     chain;
      double           s; ///< arc length
      /** Distances to the neighbours on the front; 0: no neighbour. */
      double before, after;
      bool   on_symmetry; ///< whether it is on a plane of symmetry

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &point &chain &s &before &after &on_symmetry;
      }

      bool
      is_end() const
      {
        return before == 0. || after == 0.;
      }

      /** Integral of the vertex' hat function. */
      double
      integral() const
      {
        return 0.5 * (before + after);
      }
    };

    std::vector<Vertex> vertices; ///< vertices of all ranks, by chain and s

    /** Value of a vertex' hat function at a point, and its derivative. */
    struct Hat
    {
      unsigned int vertex;
      double       value, slope;
    };

    /** The two hat functions that do not vanish at a point. */
    std::array<Hat, 2>
    hats(const FrontFrame &frame) const;

    using Cell = dealii::Triangulation<3>::active_cell_iterator;

    /** Whether a cell may overlap the tube of this size. */
    bool
    is_near(const Cell &cell, const double size) const
    {
      return distances[cell->active_cell_index()] - 0.6 * cell->diameter() <
             std::sqrt(2.) * size;
    }

    /** Whether a vertex of the cell is on the front. */
    bool
    is_at_front(const Cell &cell) const
    {
      return reach(cell->active_cell_index()).first == 0.;
    }

    /** Size of the tube of K.
     * @param wish [Crack tip] Radius of the scene.
     * @param most largest size allowed.
     * @throw SceneError if the wish is larger or in the cells at the front. */
    double
    tube(const double wish, const double most) const;

    /** Size of the larger tube of C(t), likewise. If the scene leaves the
     * choice, the smaller one, of half its size, is the tube of K. */
    double
    square(const double wish, const double most) const
    {
      return aligned_radius(
        std::min(most, (wish > 0. ? 1. : 2.) * tube(wish, most)));
    }

    /** Values at the vertices of a function along the fronts of which the means
     * with the hat functions as weights are given. */
    std::vector<double>
    values_of_means(const std::vector<double> &means) const;

    double largest_edge = 0.; ///< longest edge of the front

  private:
    const std::string   wanted_by;
    std::vector<double> distances; ///< distance of cell centres, by index

    void
    find_vertices(const Space<3> &space);
    void
    number_vertices(std::vector<Vertex> &found);
    void
    measure_cells(const Space<3> &space);
    bool
    is_own_face(const Space<3>                                &space,
                const dealii::Triangulation<3>::face_iterator &face,
                const std::vector<FrontFrame>                 &frames) const;
  };
} // namespace Crevasse

#endif
