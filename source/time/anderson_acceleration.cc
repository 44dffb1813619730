// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/time/anderson_acceleration.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Crevasse
{
  void
  AndersonAcceleration::add(const Vector &x, const Vector &image)
  {
    Pair pair{image, image};
    pair.residual -= x;
    residual_norm = pair.residual.l2_norm();
    if (!pairs.empty())
      {
        Vector step = pair.residual;
        step -= pairs.back().residual;
        const double residual_change = step.l2_norm();
        // Recover the point: x = G(x) − f.
        step = x;
        step -= pairs.back().image;
        step += pairs.back().residual;
        const double noise = accuracy * image.l2_norm();
        if (residual_change > noise)
          pair.slowness = step.l2_norm() / residual_change;
      }
    keep(std::move(pair));
  }



  void
  AndersonAcceleration::add_measured(const Vector &image,
                                     const Vector &residual)
  {
    residual_norm = residual.l2_norm();
    keep({image, residual});
  }



  void
  AndersonAcceleration::keep(Pair &&pair)
  {
    pairs.push_back(std::move(pair));
    if (pairs.size() > settings.depth + 1)
      pairs.pop_front();
  }



  void
  AndersonAcceleration::extrapolate(Vector &x)
  {
    constexpr double independent = 1e-4;

    const Pair  &last  = pairs.back();
    const double noise = accuracy * last.image.l2_norm();
    // Used differences ΔF, as Q R with normalised columns, and ΔG, divided by
    // the same norms.
    dealii::QR<Vector>  factors;
    std::vector<Vector> images;
    Vector              column;
    // Residuals that are hardly more than noise carry no information.
    constexpr double clear = 10.;
    const bool       tells = residual_norm > clear * noise;
    for (std::size_t k = tells ? pairs.size() - 1 : 0; k > 0; --k)
      {
        column = pairs[k].residual;
        column -= pairs[k - 1].residual;
        const double norm = column.l2_norm();
        if (norm <= noise)
          continue;
        column /= norm;
        factors.append_column(column);
        const unsigned int n = factors.size();
        if (const double rest = factors.get_R()(n - 1, n - 1);
            rest < independent || rest * norm < noise)
          factors.remove_column(n - 1);
        else
          {
            images.push_back(pairs[k].image);
            images.back() -= pairs[k - 1].image;
            images.back() /= norm;
          }
      }

    combine(factors, images, x);
    const std::size_t n_independent = images.size();
    while (!images.empty() && settings.contracts && !is_possible(x))
      {
        factors.remove_column(images.size() - 1);
        images.pop_back();
        combine(factors, images, x);
      }
    if (images.size() < n_independent)
      ++shortened;
  }



  void
  AndersonAcceleration::combine(const dealii::QR<Vector>  &factors,
                                const std::vector<Vector> &images,
                                Vector                    &x)
  {
    const Pair &last     = pairs.back();
    x                    = last.image;
    unexplained          = residual_norm;
    const unsigned int n = images.size();
    if (n == 0)
      return;
    dealii::Vector<double> gamma(n);
    factors.multiply_with_QT(gamma, last.residual);
    unexplained =
      std::sqrt(std::max(unexplained * unexplained - gamma.norm_sqr(), 0.));
    factors.solve(gamma, gamma);
    for (unsigned int i = 0; i < n; ++i)
      x.add(-gamma(i), images[i]);
  }



  bool
  AndersonAcceleration::is_possible(const Vector &x) const
  {
    Vector way;
    return std::all_of(pairs.begin(), pairs.end(), [&](const Pair &pair) {
      way = x;
      way -= pair.image;
      // The image is G(xᵢ) = xᵢ + fᵢ.
      return way * pair.residual >= -0.5 * pair.residual.norm_sqr();
    });
  }



  double
  AndersonAcceleration::unexplained_distance() const
  {
    double slowest = 0.;
    for (const Pair &pair : pairs)
      slowest = std::max(slowest, pair.slowness);
    return slowest * unexplained;
  }



  void
  AndersonAcceleration::serialize(StateArchive &archive)
  {
    std::size_t n = pairs.size();
    archive.common(n);
    pairs.resize(n);
    for (Pair &pair : pairs)
      {
        archive.at_points(pair.image);
        archive.at_points(pair.residual);
        archive.common(pair.slowness);
      }
    archive.common(unexplained);
    archive.common(residual_norm);
    archive.common(shortened);
  }
} // namespace Crevasse
