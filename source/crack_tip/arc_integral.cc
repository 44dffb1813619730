// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/crack_tip/arc_integral.h>
#include <crevasse/discretisation/cell_values.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  ArcIntegral::ArcIntegral(const Body<2>               &body,
                           const PointGeometry         &points,
                           const TipRegion             &region,
                           const InterfaceTip          &interface,
                           const LoadParameters        &loads,
                           const std::array<double, 2> &sizes)
    : body(body)
    , points(points)
    , region(region)
    , interface(interface)
    , units{{ArcField(region.tip, interface, CrackMode::opening),
             ArcField(region.tip, interface, CrackMode::sliding)}}
    , body_force(components_in_volume(loads))
  {
    const std::array<SquareWeight, 2> weights{
      {region.weight(sizes[0]), region.weight(sizes[1])}};
    collectively(body.space.communicator(), [&] { require_arc(sizes[0]); });
    find_places(weights);
    find_contact(weights);
  }



  void
  ArcIntegral::require_arc(const double size) const
  {
    // The bodies are uniform on either side of the circle, as points in cells
    // see it: their faces on the interface must be on it, too.
    const CrackTip &tip = region.tip;
    for (const auto &cell : owned_cells(body.space.dof_handler))
      if (region.overlaps(cell->active_cell_index(), size))
        {
          const Point<2> inside =
            tip.local(points.location[body.points.first_point(cell)]);
          const double side = tip.height(inside) > 0. ? 1. : -1.;
          for (const unsigned int f : cell->face_indices())
            for (const Point<2> &point :
                 {cell->face(f)->vertex(0), cell->face(f)->center(true)})
              if (const Point<2> local = tip.local(point);
                  side * tip.height(local) < 0. && !tip.is_on_curve(local))
                throw SceneError(Text::format(
                  "[Crack tip] Stress intensity: the interface ahead of the "
                  "crack tip %s, or a lip, is not on the circle with the "
                  "radius %g that the lip has at the tip, but at %s off it. K "
                  "is known along arcs: set [Crack tip] Radius < %g, or Stress "
                  "intensity = false.",
                  Text::from_point(tip.position).c_str(),
                  1. / std::abs(tip.curvature),
                  Text::from_point(point).c_str(),
                  std::max(std::abs(local[0]), std::abs(local[1]))));
        }
  }



  void
  ArcIntegral::require_uniform(const MaterialState<2> &material) const
  {
    if (material.thermal_strain == nullptr)
      return;
    constexpr unsigned int n       = QuadratureField<2>::n_components;
    constexpr double       highest = std::numeric_limits<double>::max();
    // Least values of the components of both sides and of their opposites.
    std::vector<double> least(4 * n, highest);
    for (const Place &place : places)
      for (unsigned int c = 0; c < n; ++c)
        {
          const double value   = (*material.thermal_strain)[place.point][c];
          double      *of_side = &least[place.is_below ? 2 * n : 0];
          of_side[c]           = std::min(of_side[c], value);
          of_side[n + c]       = std::min(of_side[n + c], -value);
        }
    Utilities::MPI::min(least, body.space.communicator(), least);
    for (const unsigned int side : {0, 1})
      for (unsigned int c = 0; c < n; ++c)
        {
          const double low  = least[2 * side * n + c],
                       high = -least[(2 * side + 1) * n + c];
          if (high - low > 1e-8 * std::max(std::abs(low), std::abs(high)))
            throw SceneError(Text::format(
              "[Crack tip] Stress intensity: the crack tip %s is on an arc "
              "between two materials, where K is known if the thermal strain "
              "of each is uniform, but that of one of them goes from %g to %g "
              "in the square of the integral. Choose a smaller [Crack tip] "
              "Radius, or set Stress intensity = false.",
              Text::from_point(region.tip.position).c_str(),
              low,
              high));
        }
  }



  void
  ArcIntegral::find_places(const std::array<SquareWeight, 2> &weights)
  {
    const CrackTip &tip = region.tip;
    Tensor<2, 2>    spin;
    spin[0][1] = -tip.curvature;
    spin[1][0] = tip.curvature;
    for (std::size_t p = 0; p < points.location.size(); ++p)
      {
        const Point<2> local = tip.local(points.location[p]);
        if (std::max(std::abs(local[0]), std::abs(local[1])) >=
            weights[0].radius)
          continue;
        const bool         is_below = tip.height(local) < 0.;
        const Tensor<1, 2> motion   = turn(local);
        Place              place{p,
                    is_below,
                    {},
                    {},
                    {{units[0].at(local, is_below),
                                   units[1].at(local, is_below)}}};
        for (const unsigned int w : {0, 1})
          {
            const auto         f = weights[w].factor(local[0]);
            const auto         g = weights[w].factor(local[1]);
            const double       q = f[0] * g[0];
            const Tensor<1, 2> slope({f[1] * g[0], f[0] * g[1]});
            const Tensor<2, 2> in_frame =
              outer_product(motion, slope) + q * spin;
            place.shift[w]    = points.weight[p] * q * tip.global(motion);
            place.gradient[w] = points.weight[p] * (transpose(tip.to_local()) *
                                                    in_frame * tip.to_local());
          }
        places.push_back(place);
      }
  }



  std::vector<Tensor<2, 2>>
  ArcIntegral::slopes_at_places(const Vector &nodal) const
  {
    const Space<2>           &space = body.space;
    std::vector<Tensor<2, 2>> slopes;
    slopes.reserve(places.size());
    double                    spin = 0., area = 0.;
    CellValues<2>             cell_values(space, update_gradients);
    std::vector<Tensor<2, 2>> gradients(space.quadratures[0].size());
    auto                      place = places.begin();
    for (const auto &cell : owned_cells(space.dof_handler))
      {
        const std::size_t first = body.points.first_point(cell);
        const std::size_t end   = first + gradients.size();
        if (place == places.end() || place->point >= end)
          continue;
        cell_values.reinit(cell)[FEValuesExtractors::Vector(0)]
          .get_function_gradients(nodal, gradients);
        for (; place != places.end() && place->point < end; ++place)
          {
            const Tensor<2, 2> &here   = gradients[place->point - first];
            const double        weight = points.weight[place->point];
            slopes.push_back(here);
            spin += weight * 0.5 * (here[1][0] - here[0][1]);
            area += weight;
          }
      }
    const MPI_Comm communicator = space.communicator();
    spin                        = Utilities::MPI::sum(spin, communicator) /
           Utilities::MPI::sum(area, communicator);
    for (Tensor<2, 2> &here : slopes)
      {
        here[1][0] -= spin;
        here[0][1] += spin;
      }
    return slopes;
  }



  void
  ArcIntegral::add_area(const double            t,
                        const Vector           &nodal,
                        const Vector           &stress,
                        const MaterialState<2> &material,
                        Sums                   &sums) const
  {
    using Field             = QuadratureField<2>;
    const double       k    = material.stiffness_factor;
    const Tensor<2, 2> unit = Tensor<2, 2>(unit_symmetric_tensor<2>());
    const auto         all  = slopes_at_places(nodal);
    for (std::size_t i = 0; i < places.size(); ++i)
      {
        const Place         &place  = places[i];
        const Tensor<2, 2>  &slopes = all[i];
        const VoigtVector<2> s =
          Field::get(stress, place.point * Field::n_components);
        const Tensor<2, 2> sigma({{s[0], s[3]}, {s[3], s[1]}});
        const double W = s * interface.strain(s, place.is_below) / (2. * k);
        // P and ∂u/∂V of the body, then of it with unit fields.
        std::array<Tensor<2, 2>, 3> P, of_V;
        P[0]    = transpose(slopes) * sigma - W * unit;
        of_V[0] = slopes;
        for (const unsigned int mode : {0, 1})
          {
            const ArcField::Gradients &field = place.units[mode];
            P[1 + mode]                      = transpose(field.slopes) * sigma +
                          k * transpose(slopes) * field.stress -
                          scalar_product(sigma, field.slopes) * unit;
            of_V[1 + mode] = field.slopes;
          }
        for (const unsigned int w : {0, 1})
          for (const unsigned int n : {0, 1, 2})
            {
              sums[w][n] += scalar_product(P[n], place.gradient[w]);
              for (const auto &[d, force] : body_force)
                sums[w][n] -= force.value(points.location[place.point], t) *
                              (of_V[n] * place.shift[w])[d];
            }
      }
  }



  ArcIntegral::Estimate
  ArcIntegral::evaluate(const double            t,
                        const Sample           &sample,
                        const MaterialState<2> &material,
                        const double            zone,
                        const bool              is_wide) const
  {
    const Vector nodal = body.nodal_displacement(sample.state.displacement,
                                                 sample.state.instant,
                                                 sample.time);
    Sums         sums{};
    add_area(t, nodal, sample.state.stress, material, sums);
    const MPI_Comm communicator = body.space.communicator();
    const double   slip         = Utilities::MPI::sum(
      add_contact(nodal, sample.state.contact_forces, zone, sums),
      communicator);
    const ArrayView<double> all(sums[0].data(), sums.size() * sums[0].size());
    Utilities::MPI::sum(ArrayView<const double>(all), communicator, all);

    using Complex            = std::complex<double>;
    const double           M = interface.modulus();
    std::array<Complex, 2> K, without_G;
    for (const unsigned int w : {0, 1})
      {
        const double size =
          std::sqrt(M * material.stiffness_factor * std::max(sums[w][0], 0.));
        without_G[w]       = 0.5 * M * Complex(sums[w][1], sums[w][2]);
        const double other = std::abs(without_G[w]);
        K[w]               = is_wide ? Complex(0., std::copysign(size, slip))
                             : other > 0. ? size / other * without_G[w]
                                          : 0.;
      }
    Estimate estimate{{{K[0].real(), K[0].imag()}}, {}};
    // K_I and K_II mix with the length to which they are related.
    for (const Complex &check : {K[1], is_wide ? K[0] : without_G[0]})
      for (const unsigned int mode : {0, 1})
        if (!is_wide || mode == 1)
          estimate.error[mode] += std::abs(check - K[0]);
    return estimate;
  }
} // namespace Crevasse
