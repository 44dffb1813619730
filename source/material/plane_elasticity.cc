// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/material/plane_elasticity.h>

#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  PlaneElasticity::PlaneElasticity(const VoigtMatrix<2> &stiffness)
    : lambda(stiffness[0][1])
    , mu(stiffness[3][3])
  {
  }



  bool
  PlaneElasticity::is_isotropic(const VoigtMatrix<2> &stiffness)
  {
    constexpr double tolerance = 1e-10; // a viscosity is an inverse
    const double     rounding  = tolerance * std::abs(stiffness[0][0]);
    const auto       vanishes  = [rounding](const double difference) {
      return std::abs(difference) <= rounding;
    };
    return vanishes(stiffness[0][0] - stiffness[1][1]) &&
           vanishes(stiffness[0][3]) && vanishes(stiffness[1][3]) &&
           vanishes(stiffness[0][0] - stiffness[0][1] - 2. * stiffness[3][3]);
  }



  VoigtMatrix<2>
  PlaneElasticity::like_stiffness(const VoigtMatrix<2> &compliance)
  {
    // 1/μ for 4 × 1/(4μ)
    VoigtMatrix<2> matrix = compliance;
    matrix[3][3] /= 4.;
    return matrix;
  }



  double
  PlaneElasticity::kappa() const
  {
    return (lambda + 3. * mu) / (lambda + mu);
  }



  double
  PlaneElasticity::modulus() const
  {
    return 8. * mu / (kappa() + 1.);
  }



  Tensor<2, 2>
  PlaneElasticity::stress(const Tensor<2, 2> &gradient,
                          const double        dilatation) const
  {
    // What the dilatation exceeds the trace by is a third in each direction.
    const double normal =
      lambda * dilatation + 2. / 3. * mu * (dilatation - trace(gradient));
    Tensor<2, 2> sigma = mu * (gradient + transpose(gradient));
    sigma[0][0] += normal;
    sigma[1][1] += normal;
    return sigma;
  }



  Tensor<2, 2>
  PlaneElasticity::stress(const Tensor<2, 2> &gradient) const
  {
    return stress(gradient, trace(gradient));
  }
} // namespace Crevasse
