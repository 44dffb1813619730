// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_proximal_point_h
#define crevasse_contact_proximal_point_h

#include <crevasse/contact/signorini_problem.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

namespace Crevasse
{
  /**
   * Solves problems on the lip of a body with unconstrained motions that only
   * contact stops: with weak springs at the bounds that are relaxed in the
   * previous solution. The proximal point method (Rockafellar, SIAM J. Control
   * Optim. 14, 1976); its steps tend to one endless motion if there is no
   * solution. Each rank solves the same problem.
   */
  class ProximalPoint
  {
  public:
    using LipVector = dealii::Vector<double>;

    /** Solves a problem on the lip with springs: loads, then displacements.
     * Returns the number of sets tried. */
    using LipProblem =
      std::function<unsigned int(const LipVector &loads, LipVector &on_lip)>;

    /** Collective.
     * @param problem must outlive this object.
     * @param stiffness Σ with springs, which must outlive this object. Unknowns
     * after those with bounds have no springs. */
    ProximalPoint(const SignoriniProblem                 &problem,
                  const dealii::LAPACKFullMatrix<double> &stiffness);

    /** Whether there are unconstrained motions: otherwise one solution without
     * springs is enough. */
    bool
    is_needed() const
    {
      return free_motions.n() > 0;
    }

    /**
     * @param[in,out] on_lip loads; then displacements.
     * @param accuracy of forces that is enough.
     * @param negligible_force stops no motion.
     * @return the number of sets tried.
     * @throw NumericalError if the loads do work on an unconstrained motion
     * that no bound stops. */
    unsigned int
    solve(LipVector        &on_lip,
          const double      accuracy,
          const double      negligible_force,
          const LipProblem &solve_lip);

    /** Number of solutions whose forces leave a motion possible. */
    std::size_t n_undetermined = 0;

  private:
    /** Whether forces larger than @p negligible leave a motion possible. */
    bool
    leave_motions_free(const LipVector &forces, const double negligible) const;

    void
    require_no_escape(const LipVector &loads, const LipVector &step) const;

    const SignoriniProblem                 &problem;
    const dealii::LAPACKFullMatrix<double> &stiffness;
    LipVector                               sign, springs; ///< of all ranks
    dealii::FullMatrix<double> free_motions; ///< one motion in each column
  };
} // namespace Crevasse

#endif
