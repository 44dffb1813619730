// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_mumps_instance_h
#define crevasse_linear_mumps_instance_h

#include <deal.II/base/types.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <complex>
#include <cstddef>
#include <dmumps_c.h>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>
#include <zmumps_c.h>

namespace Crevasse
{
  /** Entries on and above the diagonal in the rows of this rank, with indices
   * from 1 as in MUMPS. */
  template <typename Number>
  struct UpperTriangle
  {
    std::vector<int>    rows, columns;
    std::vector<Number> values;
  };

  UpperTriangle<double>
  upper_triangle(const dealii::TrilinosWrappers::SparseMatrix &matrix);

  /** Frees factors that exceptions left behind: see ~MumpsInstance(). Call this
   * wherever all ranks have caught an exception and the run continues.
   * Collective. */
  void
  end_abandoned_factors();

  /**
   * One instance of MUMPS: the factor LDLᵀ without pivoting of a symmetric
   * matrix, real or complex, whose rows are distributed over the ranks.
   * Right-hand sides are gathered on the first rank for MUMPS.
   *
   * Some unknowns, P, may be eliminated last, outside of MUMPS: the matrix and
   * each right-hand side are condensed onto them.
   *
   * All functions that call MUMPS are collective.
   */
  template <typename Number>
  class MumpsInstance
  {
  public:
    using Indices = std::vector<dealii::types::global_dof_index>;

    /** Function that overwrites the right-hand side on P by the solution. */
    using Problem = std::function<void(dealii::Vector<Number> &on_last)>;

    using Data = std::conditional_t<std::is_same<Number, double>::value,
                                    DMUMPS_STRUC_C,
                                    ZMUMPS_STRUC_C>;

    /**
     * Initialises MUMPS.
     *
     * @param n_local Number of rows of this rank, which follow the rows of
     * lower ranks.
     * @param last P on all ranks, the same list on each.
     * @param matrix_name Name for messages: "the stiffness".
     * @param if_memory_is_short Advice if memory is short.
     * @param otherwise Advice after other failures.
     */
    MumpsInstance(const MPI_Comm     communicator,
                  const int          n_local,
                  const Indices     &last,
                  const std::string &matrix_name,
                  const std::string &if_memory_is_short,
                  const std::string &otherwise);

    MumpsInstance(const MumpsInstance &) = delete;

    /** Frees the factor. This is collective, and ranks may be elsewhere while
     * an exception propagates: then end_abandoned_factors() frees it. */
    ~MumpsInstance();

    /** Control parameter ICNTL of MUMPS, by its number in the manual. */
    int &
    icntl(const unsigned int number)
    {
      return data.icntl[number - 1];
    }

    /** Pointer to numbers, with MUMPS' type. */
    static auto
    for_mumps(std::vector<Number> &values)
    {
      return reinterpret_cast<decltype(Data::rhs)>(values.data());
    }

    /** Analyses and factorises the matrix in the memory that this takes. */
    void
    factorise(UpperTriangle<Number> &triangle);

    /** Solves in place on the first rank.
     *
     * @param problem Problem on P, called on all ranks, where it must not
     * communicate; not used if P is empty.
     * @throw NumericalError */
    void
    solve(std::vector<Number> &on_root, const Problem &problem);

    /** Schur complement of P, on all ranks: the inverse of the block of A⁻¹ in
     * the rows and columns of P. */
    dealii::LAPACKFullMatrix<Number> schur_complement;

    /** Gathers a distributed vector on the first rank; the other ranks get an
     * empty vector. */
    std::vector<Number>
    gather(const Number *local) const;

    /** Distributes a vector from the first rank to all ranks. */
    void
    scatter(const std::vector<Number> &on_root, Number *local) const;

    bool
    is_root() const
    {
      return !counts.empty();
    }

    /** Bytes of the factor on this rank. */
    std::size_t
    memory_consumption() const
    {
      return bytes;
    }

    /** Data structure described in MUMPS' manual. */
    Data data = {};

    const MPI_Comm communicator;
    const int      n_ranks;

  private:
    static void
    call(Data &data, const int job);
    void
    require(const char *what) const;

    const int         n_local;
    std::vector<int>  last; ///< unknowns P, from 1
    const std::string matrix_name, if_memory_is_short, otherwise;
    std::vector<int>  counts, starts; ///< rows of each rank, on the first
    std::size_t       bytes = 0;
  };
} // namespace Crevasse

#endif
