// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_condensed_problem_h
#define crevasse_contact_condensed_problem_h

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <functional>
#include <vector>

namespace Crevasse
{
  /**
   * The linear complementarity problem on the lip,
   *
   *     w = w₀ + S g,      0 ≤ g ⟂ w ≥ 0,
   *
   * with the compliance S = L A⁻¹ Lᵀ (symmetric, positive definite), whose
   * columns are computed when a node first closes and kept. It is solved by a
   * primal–dual active set, started from the last set (Hintermüller, Ito and
   * Kunisch, SIAM J. Optim. 13, 2002); if a set comes back, one node at a time
   * changes, the last one that is wrong, which ends on every positive definite
   * S (Murty, Opsearch 11, 1974).
   */
  class CondensedProblem
  {
  public:
    /** Returns columns of S: for each node asked for, S e_node. */
    using ComplianceColumns = std::function<std::vector<dealii::Vector<double>>(
      const std::vector<unsigned int> &nodes)>;

    /** Improves the set that follows on another one, where more is known about
     * the nodes than S: see LipGraph::extrapolate(). */
    using Extrapolation = std::function<void(const std::vector<bool> &active,
                                             std::vector<bool>       &next)>;

    CondensedProblem(const unsigned int       n_nodes,
                     const ComplianceColumns &columns,
                     const Extrapolation     &extrapolation = {});

    /**
     * @param opening_without_contact w₀
     * @param[out] forces g
     * @return the number of active sets tried.
     * @throw NumericalError if S is found not to be positive definite.
     */
    unsigned int
    solve(const dealii::Vector<double> &opening_without_contact,
          dealii::Vector<double>       &forces);

    /** Makes these nodes the first set. */
    void
    start_from(const std::vector<bool> &closed_nodes);

    /** The forces that bring the nodes of the active set from the given
     * opening w₀ to none, whatever their sign, by S_CC g_C = −w₀_C; the factor
     * is kept while the set stays. */
    void
    forces_that_close(const dealii::Vector<double> &opening,
                      dealii::Vector<double>       &forces);

    /** Nodes closed in the last solution. */
    const std::vector<unsigned int> &
    active_set() const
    {
      return active;
    }

    /** The columns of S, empty where they were not computed yet; one that is
     * set will not be computed. */
    std::vector<dealii::Vector<double>> &
    known_columns()
    {
      return columns;
    }

    /** Bytes of the columns and the factor. */
    std::size_t
    memory_consumption() const;

    /** How often sets came back. */
    unsigned int
    n_rescues() const
    {
      return rescues;
    }

  private:
    using Set = std::vector<unsigned int>; // ascending

    /** The set that forces and openings call for.
     *
     * @param rounding how negative an opening may be off the set, and on it
     * that which a force stands for. */
    Set
    next_set(const dealii::Vector<double> &forces,
             const dealii::Vector<double> &opening,
             const double                  rounding) const;

    /** The same, extrapolated. */
    Set
    extrapolated(const Set &next) const;

    void
    factorise();

    const unsigned int      n;
    const ComplianceColumns compute_columns;
    const Extrapolation     extrapolation;

    std::vector<dealii::Vector<double>> columns; ///< empty where not computed
    Set                                 active;
    Set                                 factored_set;
    dealii::LAPACKFullMatrix<double>    factor;
    unsigned int                        rescues = 0;

    /** For one set: w₀ + S g, and −w₀ on the set, then g there. */
    dealii::Vector<double> openings, on_set;
  };
} // namespace Crevasse

#endif
