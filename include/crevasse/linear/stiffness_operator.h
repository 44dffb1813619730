// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_stiffness_operator_h
#define crevasse_linear_stiffness_operator_h

#include <crevasse/linear/linear_operator.h>
#include <crevasse/linear/stiffness_product.h>

namespace Crevasse
{
  /** A as products: see StiffnessProduct. */
  template <int dim>
  class StiffnessOperator : public LinearOperator
  {
  public:
    /** Without singular functions.
     *
     * @param space must outlive this object.
     * @param stiffness K at the quadrature points; a copy is made. */
    StiffnessOperator(const Space<dim>                    &space,
                      const QuadratureField<dim>          &points,
                      const PointValues<VoigtMatrix<dim>> &stiffness);

    void
    vmult(Vector &result, const Vector &v) const override;

    const Vector &
    diagonal() const override
    {
      return product.diagonal();
    }

    std::vector<Indices>
    couplings(const Indices &rows, const Indices &columns) const override;

    MPI_Comm
    get_mpi_communicator() const override
    {
      return space.communicator();
    }

    const Matrix *
    matrix() const override
    {
      return nullptr;
    }

    std::size_t
    memory_consumption() const override;

  private:
    const Space<dim>                   &space;
    const StiffnessProduct<dim, double> product;
    mutable Vector copy_of_v, copy_of_result; ///< if layouts differ
  };
} // namespace Crevasse

#endif
