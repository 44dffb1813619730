// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_stiffness_operator_h
#define crevasse_linear_stiffness_operator_h

#include <crevasse/linear/linear_operator.h>
#include <crevasse/linear/stiffness_product.h>

namespace Crevasse
{
  /** Matrix-free LinearOperator of the stiffness A: see StiffnessProduct. */
  template <int dim>
  class StiffnessOperator : public LinearOperator
  {
  public:
    /** Does not support singular functions.
     *
     * @param space Must outlive this object.
     * @param stiffness K at the quadrature points, which is copied. */
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
    mutable Vector copy_of_v, copy_of_result; ///< result, if layouts differ
  };
} // namespace Crevasse

#endif
