// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/singular_stress.h>

#include <deal.II/base/mpi.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  SingularStress<dim>::SingularStress(const Space<dim> &space,
                                      const Vector     *displacement)
    : space(space)
  {
    if (displacement == nullptr || space.singular_shapes() == nullptr)
      return;
    for (unsigned int k = 0; k < space.singular_shapes()->size(); ++k)
      {
        const auto unknown = space.singular_unknown(k);
        coefficients.push_back(Utilities::MPI::sum(
          displacement->in_local_range(unknown) ? (*displacement)(unknown) : 0.,
          space.communicator()));
      }
  }



  template <int dim>
  bool
  SingularStress<dim>::is_zero() const
  {
    return coefficients.empty();
  }



  template <int dim>
  VoigtVector<dim>
  SingularStress<dim>::at(const Point<dim>       &point,
                          const VoigtMatrix<dim> &stiffness) const
  {
    VoigtVector<dim> stress;
    if constexpr (dim == 2)
      {
        const SingularFunctions &functions =
          space.singular_shapes()->functions();
        const Tensor<2, 2> to_local = functions.tip.to_local();
        Tensor<2, 2>       gradient;
        for (unsigned int k = 0; k < coefficients.size(); ++k)
          gradient += coefficients[k] *
                      functions.fields[k].gradient(functions.tip.local(point));
        stress = stiffness *
                 voigt_strain<2>(transpose(to_local) * gradient * to_local);
      }
    return stress;
  }



  template class SingularStress<2>;
  template class SingularStress<3>;
} // namespace Crevasse
