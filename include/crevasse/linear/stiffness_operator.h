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
                      const PointValues<VoigtMatrix<dim>> &stiffness)
      : product(space, points, stiffness)
    {
    }

    void
    vmult(Vector &result, const Vector &v) const override
    {
      const auto is_ours = [this](const Vector &vector) {
        return vector.get_partitioner() == diagonal().get_partitioner();
      };
      if (is_ours(v) && is_ours(result))
        {
          product.vmult(result, v);
          return;
        }
      copy_of_v.reinit(diagonal(), true);
      copy_of_result.reinit(diagonal(), true);
      copy_of_v.copy_locally_owned_data_from(v);
      product.vmult(copy_of_result, copy_of_v);
      result.copy_locally_owned_data_from(copy_of_result);
    }

    const Vector &
    diagonal() const override
    {
      return product.diagonal();
    }

    MPI_Comm
    get_mpi_communicator() const override
    {
      return diagonal().get_mpi_communicator();
    }

    const Matrix *
    matrix() const override
    {
      return nullptr;
    }

    std::size_t
    memory_consumption() const override
    {
      return product.memory_consumption() + copy_of_v.memory_consumption() +
             copy_of_result.memory_consumption();
    }

  private:
    const StiffnessProduct<dim, double> product;
    mutable Vector copy_of_v, copy_of_result; ///< result, if layouts differ
  };
} // namespace Crevasse

#endif
