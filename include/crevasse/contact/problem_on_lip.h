// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_problem_on_lip_h
#define crevasse_contact_problem_on_lip_h

#include <crevasse/linear/principal_factor.h>

#include <string>

namespace Crevasse
{
  /** Problem on the unknowns of the lip, with their stiffness Σ (symmetric,
   * positive definite), that an active set method solves: see CondensedSolver.
   */
  class ProblemOnLip
  {
  public:
    using LipVector = dealii::Vector<double>;

    /** @param stiffness Σ, which must outlive this object. */
    explicit ProblemOnLip(const dealii::LAPACKFullMatrix<double> &stiffness)
      : factor(stiffness)
    {
    }

    virtual ~ProblemOnLip() = default;

    /**
     * @param loads c of the forces g = Σ q − c.
     * @param[out] jumps q
     * @return the number of sets tried.
     * @throw NumericalError if no solution is found.
     */
    virtual unsigned int
    solve(const LipVector &loads, LipVector &jumps) = 0;

    /** Whether each pair of nodes is closed in the last solution. */
    virtual std::vector<bool>
    closed_pairs() const = 0;

    /** Sets the first guess of the next solve: see closed_pairs(). */
    virtual void
    start_from(const std::vector<bool> &closed_pairs) = 0;

    /** Serialises what else the next solution depends on. */
    virtual void
    serialize(StateArchive &)
    {
    }

    /** Bytes, without Σ. */
    virtual std::size_t
    memory_consumption() const
    {
      return factor.memory_consumption();
    }

    /** Number of solves whose sets recurred. */
    unsigned int
    n_rescues() const
    {
      return rescues;
    }

    /** How recurring sets are ended, for the log. */
    virtual std::string
    rescue() const = 0;

    PrincipalFactor factor; ///< factor of Σ for the free unknowns

  protected:
    unsigned int rescues = 0;
  };
} // namespace Crevasse

#endif
