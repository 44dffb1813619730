// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_solver_choice_h
#define crevasse_linear_solver_choice_h

#include <crevasse/parameters/parameters.h>

#include <cstddef>
#include <string>

namespace Crevasse
{
  /** Which linear solver, and why. */
  struct LinearSolverChoice
  {
    LinearSolverType type;
    std::string      why;

    /** "cholesky (why)". */
    std::string
    describe() const;

    /** Whether it iterates, and knows no singular functions. */
    bool
    is_multigrid() const
    {
      return traits(type).is_multigrid;
    }
  };

  /** Above this many unknowns a factor takes more memory, or its making more
   * time, than the solves of a run are worth. */
  std::size_t
  largest_factorised(const unsigned int dimension);

  /** What is fastest for a matrix of this size, by the measurements in
   * doc/contact_solvers.md: a factorisation, or CG + ML. */
  LinearSolverChoice
  choose_matrix_solver(const unsigned int dimension,
                       const std::size_t  n_unknowns,
                       const unsigned int n_ranks);

  /** What the scene asks for or, if that is "automatic", what is fastest by
   * the measurements in doc/contact_solvers.md and doc/scaling.md.
   *
   * @param has_coarser_meshes and nothing needs a matrix: gmg can be had. */
  LinearSolverChoice
  choose_linear_solver(const LinearSolverParameters &parameters,
                       const unsigned int            dimension,
                       const unsigned int            degree,
                       const std::size_t             n_unknowns,
                       const unsigned int            n_ranks,
                       const bool                    has_coarser_meshes);

  /** Which contact solver, and why. */
  struct ContactSolverChoice
  {
    ContactSolverType type;
    std::string       why;

    /** "active set (why)". */
    std::string
    describe() const;
  };

  ContactSolverChoice
  choose_contact_solver(const ContactParameters  &parameters,
                        const LinearSolverChoice &linear_solver,
                        const std::size_t         n_bounds);
} // namespace Crevasse

#endif
