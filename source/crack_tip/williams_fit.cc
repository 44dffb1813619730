// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/crack_tip/williams_fit.h>
#include <crevasse/discretisation/polar_field.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int most_terms = 8;
    /** Number of points per term, each with three stress components. */
    constexpr unsigned int points_per_term = 3;

    using Terms = std::array<VoigtVector<2>, most_terms>;

    std::vector<PolarField>
    williams_series()
    {
      // The stress of a term does not depend on κ: 2 means λ = μ.
      std::vector<PolarField> series;
      for (unsigned int n = 1; n <= most_terms; ++n)
        series.push_back(williams_term(n, 2.));
      return series;
    }



    /** Stresses of the terms at a point, in the coordinates of the mesh; the
     * stress of term n is scaled by R^(1 − n/2). */
    Terms
    stresses(const std::vector<PolarField> &series,
             const CrackTip                &tip,
             const Point<2>                &point,
             const double                   radius)
    {
      const Point<2>     local = tip.local(point);
      const Tensor<2, 2> turn  = tip.to_local();
      Terms              terms;
      for (unsigned int n = 1; n <= most_terms; ++n)
        {
          // The term's gradient is the gradient of 2μu.
          const Tensor<2, 2> gradient = series[n - 1].gradient(local);
          Tensor<2, 2>       sigma    = 0.5 * (gradient + transpose(gradient));
          for (unsigned int i = 0; i < 2; ++i)
            sigma[i][i] += 0.5 * trace(gradient);
          sigma                = transpose(turn) * sigma * turn;
          VoigtVector<2> &term = terms[n - 1];
          term[0]              = sigma[0][0];
          term[1]              = sigma[1][1];
          term[3]              = sigma[0][1];
          term *= std::pow(radius, 1. - n / 2.);
        }
      return terms;
    }



    /** Inner product s:t of stresses in the plane. */
    double
    product(const VoigtVector<2> &s, const VoigtVector<2> &t)
    {
      return s[0] * t[0] + s[1] * t[1] + 2. * s[3] * t[3];
    }



    /** First row of the inverse of a Gram matrix, without the directions whose
     * eigenvalues are rounding. */
    dealii::Vector<double>
    first_row_of_inverse(const FullMatrix<double> &gram, const unsigned int n)
    {
      LAPACKFullMatrix<double> matrix(n, n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          matrix(i, j) = gram(i, j);
      constexpr double rounding = 1e-13;
      matrix.compute_inverse_svd(rounding);
      dealii::Vector<double> unit(n), row(n);
      unit[0] = 1.;
      matrix.vmult(row, unit);
      return row;
    }
  } // namespace



  WilliamsFit::WilliamsFit(const PointGeometry      &points,
                           const ContactBoundary<2> &lip,
                           const TipRegion          &region,
                           const double              radius,
                           const MPI_Comm            communicator)
    : communicator(communicator)
    , small(fit(points, lip, region, 0.5 * radius))
    , large(fit(points, lip, region, radius))
  {
  }



  double
  WilliamsFit::least_radius(const PointGeometry &points,
                            const TipRegion     &region,
                            const MPI_Comm       communicator)
  {
    constexpr unsigned int enough = points_per_term * most_terms;
    std::vector<double>    radii;
    for (const Point<2> &point : points.location)
      radii.push_back(region.tip.local(point).norm());
    const unsigned int n = std::min<std::size_t>(radii.size(), enough);
    std::partial_sort(radii.begin(), radii.begin() + n, radii.end());
    radii.resize(n);
    std::vector<double> all = of_all_ranks(communicator, radii);
    std::sort(all.begin(), all.end());
    return all[std::min<std::size_t>(all.size(), enough) - 1];
  }



  WilliamsFit::Disc
  WilliamsFit::fit(const PointGeometry      &points,
                   const ContactBoundary<2> &lip,
                   const TipRegion          &region,
                   const double              radius) const
  {
    const std::vector<PolarField> series = williams_series();
    const CrackTip               &tip    = region.tip;
    std::vector<std::size_t>      inside;
    FullMatrix<double>            gram(most_terms, most_terms);
    for (std::size_t p = 0; p < points.location.size(); ++p)
      if (tip.local(points.location[p]).norm() <= radius)
        {
          inside.push_back(p);
          const Terms at_point =
            stresses(series, tip, points.location[p], radius);
          for (unsigned int i = 0; i < most_terms; ++i)
            for (unsigned int j = 0; j < most_terms; ++j)
              gram(i, j) +=
                points.weight[p] * product(at_point[i], at_point[j]);
        }
    const std::size_t n_points =
      Utilities::MPI::sum(inside.size(), communicator);
    Utilities::MPI::sum(gram, communicator, gram);
    const unsigned int terms = std::max<std::size_t>(
      1, std::min<std::size_t>(most_terms, n_points / points_per_term));

    const dealii::Vector<double> row = first_row_of_inverse(gram, terms);
    // The first term has K_I = √(2π), and was scaled by √R.
    const double scale = std::sqrt(2. * numbers::PI * radius);
    Disc         disc{radius, {}, {}};
    for (const std::size_t p : inside)
      {
        const Terms at_point =
          stresses(series, tip, points.location[p], radius);
        VoigtVector<2> sum;
        for (unsigned int i = 0; i < terms; ++i)
          sum += row[i] * at_point[i];
        sum[3] *= 2.; // counts s₁₂ and s₂₁
        disc.of_stress.emplace_back(p * QuadratureField<2>::n_components,
                                    scale * points.weight[p] * sum);
      }
    fit_pressure(points, lip, tip, disc);
    return disc;
  }



  Tensor<1, 2>
  WilliamsFit::of_pressure(const PointGeometry &points,
                           const CrackTip      &tip,
                           const Disc          &disc) const
  {
    VoigtVector<2> pressed; // stress −e₂ ⊗ e₂
    pressed[0] = -tip.inward[0] * tip.inward[0];
    pressed[1] = -tip.inward[1] * tip.inward[1];
    pressed[3] = -tip.inward[0] * tip.inward[1];
    Tensor<1, 2> sums;
    for (const auto &[offset, row] : disc.of_stress)
      {
        const Point<2> &point =
          points.location[offset / QuadratureField<2>::n_components];
        sums[0] += row * pressed;
        sums[1] -= row * pressed * tip.local(point)[0] / disc.radius;
      }
    return Utilities::MPI::sum(sums, communicator);
  }



  void
  WilliamsFit::fit_pressure(const PointGeometry      &points,
                            const ContactBoundary<2> &lip,
                            const CrackTip           &tip,
                            Disc                     &disc) const
  {
    const Tensor<1, 2> sums = of_pressure(points, tip, disc);
    // (p₀, p₁R) = M⁻¹ Σ (1, r/R) g, M = Σ weight (1, r/R) ⊗ (1, r/R)
    SymmetricTensor<2, 2>     M;
    std::vector<Tensor<1, 2>> lines;
    for (const LipNode<2> &node : lip.nodes)
      {
        const double r         = tip.local(node.point).norm() / disc.radius;
        const bool   is_inside = tip.local(node.point)[0] < 0. && r <= 1.;
        lines.push_back(is_inside ? Tensor<1, 2>({1., r}) : Tensor<1, 2>());
        M +=
          node.weight * symmetrize(outer_product(lines.back(), lines.back()));
      }
    M                         = Utilities::MPI::sum(M, communicator);
    constexpr double rounding = 1e-10;
    Tensor<1, 2>     solution; // M⁻¹ applied to the sums
    if (determinant(M) > rounding * M[0][0] * M[0][0])
      solution = invert(M) * sums;
    else if (M[0][0] > 0.) // one node: a constant pressure
      solution[0] = sums[0] / M[0][0];
    for (const Tensor<1, 2> &line : lines)
      disc.of_contact_forces.push_back(-(solution * line));
  }



  double
  WilliamsFit::apply(const Disc          &disc,
                     const Vector        &stress,
                     const ContactForces &contact_forces) const
  {
    double sum = 0.;
    for (const auto &[offset, row] : disc.of_stress)
      sum += row * QuadratureField<2>::get(stress, offset);
    for (std::size_t k = 0; k < disc.of_contact_forces.size(); ++k)
      sum += disc.of_contact_forces[k] * contact_forces.normal[k];
    return Utilities::MPI::sum(sum, communicator);
  }



} // namespace Crevasse
