// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/grid/curved_edges.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Centre of the circle through three points; no value if the last point is
     * on the straight line, to 1e-7 of its length. */
    template <int dim>
    std::optional<Point<dim>>
    centre_of_arc(const Point<dim> &begin,
                  const Point<dim> &end,
                  const Point<dim> &middle)
    {
      constexpr double  straight = 1e-7, off_middle = 0.2;
      const std::string edge = "the edge from " + Text::from_point(begin) +
                               " to " + Text::from_point(end);
      // Deviation of the middle along the chord and across, in chord lengths.
      const Tensor<1, dim> chord  = end - begin;
      const Tensor<1, dim> shift  = middle - (begin + 0.5 * chord);
      const double         along  = shift * chord / chord.norm_square();
      const Tensor<1, dim> across = shift - along * chord;
      const double         height = across.norm() / chord.norm();
      if (!(std::abs(along) < off_middle))
        throw SceneError(
          "the node at " + Text::from_point(middle) +
          " is not near the middle of " + edge +
          ", as in quarter-point elements, which are not implemented; for "
          "crack tips use [Discretisation] Singular functions.");
      if (height < straight)
        return {};
      const double square = along * along + height * height;
      if (square > 0.249)
        throw SceneError(edge + " turns by 180 degrees or more.");
      return begin + 0.5 * chord +
             (square - 0.25) / (2. * height * height) * across;
    }



    /** Parabola through the ends of an edge and its middle. */
    class Parabola : public Manifold<3>
    {
    public:
      Parabola(const Point<3> &begin,
               const Point<3> &middle,
               const Point<3> &end)
        : begin(begin)
        , middle(middle)
        , end(end)
      {
      }

      std::unique_ptr<Manifold<3>>
      clone() const override
      {
        return std::make_unique<Parabola>(*this);
      }

      /** Point with the parameter that the mean of points has on the chord. */
      Point<3>
      get_new_point(const ArrayView<const Point<3>> &points,
                    const ArrayView<const double>   &weights) const override
      {
        const Tensor<1, 3> chord = end - begin;
        double             u     = 0.;
        for (std::size_t i = 0; i < points.size(); ++i)
          u += weights[i] * ((points[i] - begin) * chord);
        u /= chord.norm_square();
        return begin + u * chord +
               4. * u * (1. - u) * (middle - begin - 0.5 * chord);
      }

    private:
      const Point<3> begin, middle, end;
    };
  } // namespace



  Point<3>
  project_to_arc(const Point<3> &begin,
                 const Point<3> &end,
                 const Point<3> &middle,
                 const Point<3> &point)
  {
    const auto centre = centre_of_arc<3>(begin, end, middle);
    if (!centre)
      return point;
    const Tensor<1, 3> arm = point - *centre;
    return *centre + begin.distance(*centre) / arm.norm() * arm;
  }



  template <int dim>
  void
  set_curved_edges(const EdgeMiddles<dim> &middles, Triangulation<dim> &mesh)
  {
    types::manifold_id next = 0;
    for (const auto &cell : mesh.active_cell_iterators())
      for (const unsigned int l : cell->line_indices())
        {
          const auto line   = cell->line(l);
          const auto middle = middles.find(
            std::minmax({line->vertex_index(0), line->vertex_index(1)}));
          if (middle == middles.end() ||
              line->manifold_id() != numbers::flat_manifold_id)
            continue;
          const auto centre = centre_of_arc<dim>(line->vertex(0),
                                                 line->vertex(1),
                                                 middle->second);
          if (!centre)
            continue;
          line->set_manifold_id(next);
          mesh.set_manifold(next++, SphericalManifold<dim>(*centre));
        }
  }



  void
  set_parabola(const Triangulation<3>::line_iterator &line,
               const Point<3>                        &middle,
               Triangulation<3>                      &mesh)
  {
    mesh.set_manifold(line->manifold_id(),
                      Parabola(line->vertex(0), middle, line->vertex(1)));
  }



  template <int dim>
  bool
  has_curved_edges(const Triangulation<dim> &mesh)
  {
    // All ranks know the coarse mesh.
    for (const auto &cell : mesh.cell_iterators_on_level(0))
      for (const unsigned int l : cell->line_indices())
        if (cell->line(l)->manifold_id() != numbers::flat_manifold_id)
          return true;
    return false;
  }



  template <int dim>
  void
  require_flat_faces(const Triangulation<dim>           &mesh,
                     const char                         *role,
                     const std::set<types::boundary_id> &ids)
  {
    if (!has_curved_edges(mesh))
      return;
    const MappingQ<dim>   mapping(2);
    const FE_Nothing<dim> no_unknowns;
    FEFaceValues<dim>     values(mapping,
                             no_unknowns,
                             QGaussLobatto<dim - 1>(3),
                             update_normal_vectors);
    for (const auto &cell : mesh.cell_iterators_on_level(0))
      for (const unsigned int f : cell->face_indices())
        if (cell->at_boundary(f) && ids.count(cell->face(f)->boundary_id()) > 0)
          {
            values.reinit(cell, f);
            for (const Tensor<1, dim> &normal : values.get_normal_vectors())
              if (normal * values.normal_vector(0) < 1. - 1e-10)
                throw SceneError(
                  std::string("[Boundary] ") + role + ": the face at " +
                  Text::from_point<dim>(cell->face(f)->center()) +
                  " is curved; lips and planes of symmetry must be flat. Make "
                  "its edges straight, or give it another role.");
          }
  }



  template decltype(set_curved_edges<2>)   set_curved_edges<2>;
  template decltype(set_curved_edges<3>)   set_curved_edges<3>;
  template decltype(has_curved_edges<2>)   has_curved_edges<2>;
  template decltype(has_curved_edges<3>)   has_curved_edges<3>;
  template decltype(require_flat_faces<2>) require_flat_faces<2>;
  template decltype(require_flat_faces<3>) require_flat_faces<3>;
} // namespace Crevasse
