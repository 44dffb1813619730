// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_singular_stress_h
#define crevasse_discretisation_singular_stress_h

#include <crevasse/discretisation/space.h>
#include <crevasse/material/voigt.h>

#include <vector>

namespace Crevasse
{
  /** The stress K Σ c_k Dψ_k that the singular functions of an elastic
   * displacement have, not shifted: what is left without it is the stress of
   * polynomials. w₁ and w₃ are in equilibrium and leave the lip free; what D
   * lacks is left out of account, for an elastic body has hardly any of it. */
  template <int dim>
  class SingularStress
  {
  public:
    /** Collective. @p space must outlive this object.
     * @param displacement null: there is nothing, as without singular
     * functions. */
    SingularStress(const Space<dim> &space, const Vector *displacement);

    bool
    is_zero() const;

    /** Not at the tip. */
    VoigtVector<dim>
    at(const dealii::Point<dim> &point,
       const VoigtMatrix<dim>   &stiffness) const;

  private:
    const Space<dim>   &space;
    std::vector<double> coefficients; ///< c_k
  };
} // namespace Crevasse

#endif
