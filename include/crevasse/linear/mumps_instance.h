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
  /** The entries on and above the diagonal in the rows of this rank, counted
   * from 1 as MUMPS does. */
  template <typename Number>
  struct UpperTriangle
  {
    std::vector<int>    rows, columns;
    std::vector<Number> values;
  };

  UpperTriangle<double>
  upper_triangle(const dealii::TrilinosWrappers::SparseMatrix &matrix);

  /** Frees what exceptions left behind: see ~MumpsInstance(). To be called
   * wherever one is caught and the run goes on, where all ranks have caught it.
   * Collective. */
  void
  end_abandoned_factors();

  /**
   * One instance of MUMPS: the factor LDLᵀ of a symmetric matrix, real or
   * complex, of which each rank has some rows, without pivoting. Right-hand
   * sides are gathered on the first rank, from which MUMPS takes them.
   *
   * Some unknowns, P, may be eliminated last, outside of MUMPS: the matrix is
   * condensed onto them, and so is each right-hand side.
   *
   * MUMPS works by communication: whatever is called here is collective.
   */
  template <typename Number>
  class MumpsInstance
  {
  public:
    using Indices = std::vector<dealii::types::global_dof_index>;

    /** Overwrites the right-hand side on P by the solution there. */
    using Problem = std::function<void(dealii::Vector<Number> &on_last)>;

    using Data = std::conditional_t<std::is_same<Number, double>::value,
                                    DMUMPS_STRUC_C,
                                    ZMUMPS_STRUC_C>;

    /**
     * Begins.
     *
     * @param n_local rows of this rank, which follow on those of the ranks
     * before.
     * @param last P, of all ranks, the same on each.
     * @param matrix_name for messages: "the stiffness".
     * @param if_memory_is_short what to try then.
     * @param otherwise what to try if it fails for another reason.
     */
    MumpsInstance(const MPI_Comm     communicator,
                  const int          n_local,
                  const Indices     &last,
                  const std::string &matrix_name,
                  const std::string &if_memory_is_short,
                  const std::string &otherwise);

    MumpsInstance(const MumpsInstance &) = delete;

    /** Frees the factor. That takes all ranks, which may be elsewhere while an
     * exception is on its way: then end_abandoned_factors() does it. */
    ~MumpsInstance();

    /** A setting, with its number in MUMPS' manual. */
    int &
    icntl(const unsigned int number)
    {
      return data.icntl[number - 1];
    }

    /** Numbers as MUMPS names them. */
    static auto
    for_mumps(std::vector<Number> &values)
    {
      return reinterpret_cast<decltype(Data::rhs)>(values.data());
    }

    /** Analyses and factorises, in as much memory as that takes.
     * @throw NumericalError */
    void
    factorise(UpperTriangle<Number> &triangle);

    /** Solves in place on the first rank.
     *
     * @param problem on P, called on all ranks, where it must not
     * communicate; not used if P is empty.
     * @throw NumericalError */
    void
    solve(std::vector<Number> &on_root, const Problem &problem);

    /** Of P, on all ranks: the inverse of what A⁻¹ has in the rows and columns
     * of P. */
    dealii::LAPACKFullMatrix<Number> schur_complement;

    /** The first rank gets all entries of a vector of which the ranks have
     * their parts, and nothing the others. */
    std::vector<Number>
    gather(const Number *local) const;

    /** The other way. */
    void
    scatter(const std::vector<Number> &on_root, Number *local) const;

    bool
    is_root() const
    {
      return !counts.empty();
    }

    /** Of the factor, on this rank. */
    std::size_t
    memory_consumption() const
    {
      return bytes;
    }

    /** What MUMPS' manual describes. */
    Data data = {};

    const MPI_Comm communicator;
    const int      n_ranks;

  private:
    static void
    call(Data &data, const int job);
    void
    require(const char *what) const;

    const int         n_local;
    std::vector<int>  last; ///< P, counted from 1
    const std::string matrix_name, if_memory_is_short, otherwise;
    std::vector<int>  counts, starts; ///< of all ranks; the first knows them
    std::size_t       bytes = 0;
  };
} // namespace Crevasse

#endif
