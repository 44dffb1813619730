// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_stiffness_operator_h
#define crevasse_linear_stiffness_operator_h

#include <crevasse/discretisation/point_values.h>
#include <crevasse/discretisation/quadrature_field.h>
#include <crevasse/discretisation/space.h>
#include <crevasse/linear/linear_operator.h>
#include <crevasse/linear/point_moduli.h>

#include <deal.II/base/subscriptor.h>
#include <deal.II/matrix_free/matrix_free.h>

#include <array>
#include <functional>
#include <variant>

namespace Crevasse
{
  /**
   * A = ∫ DᵀKD as a loop over the cells with sum factorisation (Kronbichler and
   * Kormann, Computers & Fluids 63, 2012): what assemble_stiffness() writes
   * into a matrix, without the matrix. Rows and columns of constrained unknowns
   * are those of the identity.
   */
  template <int dim>
  class StiffnessOperator : public LinearOperator, public dealii::Subscriptor
  {
  public:
    using Vector = LinearOperator::Vector;

    /** Work on a range of vector entries. */
    using RangeFunction =
      std::function<void(const unsigned int, const unsigned int)>;

    /** Without singular functions.
     *
     * @param space must outlive this object.
     * @param stiffness K at the quadrature points; a copy is made. */
    StiffnessOperator(const Space<dim>                    &space,
                      const QuadratureField<dim>          &points,
                      const PointValues<VoigtMatrix<dim>> &stiffness);

    /** Gives @p vector the layout for which vmult() makes no copies. */
    void
    initialize_dof_vector(Vector &vector) const
    {
      loops->initialize_dof_vector(vector);
    }

    void
    vmult(Vector &result, const Vector &v) const override;

    /** The same, with work on the entries before the first cell touches them
     * and after the last one did, while they are in the cache. */
    void
    vmult(Vector              &result,
          const Vector        &v,
          const RangeFunction &before,
          const RangeFunction &after) const;

    /** Makes these unconstrained rows and columns those of the identity, until
     * others are named, for vectors that are zero there. (The diagonal stays
     * what it is.)
     *
     * @param rows local indices of locally owned unknowns, ascending; must
     * outlive the call that ends it, with null. */
    void
    hold(const std::vector<unsigned int> *rows) noexcept
    {
      held_rows = rows;
    }

    /** 1 where constrained. The masters of hanging nodes have the squares of
     * their weights times the diagonal of these only. */
    const Vector &
    diagonal() const override
    {
      return operator_diagonal;
    }

    std::vector<LinearOperator::Indices>
    couplings(const LinearOperator::Indices &rows,
              const LinearOperator::Indices &columns) const override;

    MPI_Comm
    get_mpi_communicator() const override
    {
      return space.communicator();
    }

    const LinearOperator::Matrix *
    matrix() const override
    {
      return nullptr;
    }

    dealii::types::global_dof_index
    m() const
    {
      return space.n_unknowns();
    }

    /** A diagonal entry of this rank, for smoothers. */
    double
    el(const dealii::types::global_dof_index row,
       const dealii::types::global_dof_index) const
    {
      return operator_diagonal(row);
    }

    /** Without the loops that belong to the space. */
    std::size_t
    memory_consumption() const override;

  private:
    using Number = dealii::VectorizedArray<double>;
    using Loops  = dealii::MatrixFree<dim, double>;

    static constexpr unsigned int n_components = n_stress_components<dim>;
    using Moduli = std::variant<PointValues<IsotropicModuli<dim>>,
                                PointValues<GeneralModuli<dim>>>;

    /** Isotropic ones if K is that everywhere, on all ranks. */
    static Moduli
    moduli_of(const Space<dim>                    &space,
              const QuadratureField<dim>          &points,
              const PointValues<VoigtMatrix<dim>> &stiffness);

    /** One of these for each kind of element. */
    template <int degree, bool mean_volume>
    void
    apply(const Loops                                 &loops,
          Vector                                      &result,
          const Vector                                &v,
          const std::pair<unsigned int, unsigned int> &cells) const;

    template <int degree, bool mean_volume>
    void
    add_cell_diagonals();

    /** From the gradients of a batch of cells to what is to be integrated with
     * those of the test functions. */
    template <bool mean_volume, typename PointModuli, typename Evaluation>
    void
    multiply_at_points(const PointValues<PointModuli> &moduli,
                       const unsigned int              batch,
                       Evaluation                     &evaluation) const;

    /** @param stress K times the strain at a point of a batch of cells. */
    template <typename PointModuli>
    void
    multiply(const PointValues<PointModuli>         &moduli,
             const unsigned int                      batch,
             const unsigned int                      point,
             const std::array<Number, n_components> &strain,
             std::array<Number, n_components>       &stress) const;

    void
    compute_diagonal();

    const Space<dim>                  &space;
    const std::shared_ptr<const Loops> loops;
    const Moduli                       moduli;

    /** The first point of each lane of each batch of cells. */
    std::vector<std::array<std::size_t, Number::size()>> first_points;

    std::vector<unsigned int>        constrained_rows;    ///< ascending
    const std::vector<unsigned int> *held_rows = nullptr; ///< likewise
    Vector                           operator_diagonal;
    mutable Vector copy_of_v, copy_of_result; ///< if layouts differ
  };
} // namespace Crevasse

#endif
