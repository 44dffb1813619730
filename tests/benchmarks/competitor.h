// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_benchmarks_competitor_h
#define crevasse_benchmarks_competitor_h

#include <crevasse/contact/signorini_problem.h>

#include <memory>
#include <string>
#include <vector>

/** A solver of contact problems that takes part in the duel. */
class Competitor
{
public:
  virtual ~Competitor() = default;

  /** Whatever is done once for a matrix. */
  virtual void
  prepare(const Crevasse::SignoriniProblem    &problem,
          const std::vector<Crevasse::Vector> &rigid_modes,
          const unsigned int                   degree) = 0;

  /** From @p q as start; returns the number of (outer) iterations. */
  virtual unsigned int
  solve(const Crevasse::Vector &b, Crevasse::Vector &q) = 0;

  const std::string name;

  /** Set as soon as it took too long: larger problems are spared. */
  bool has_given_up = false;

protected:
  explicit Competitor(const std::string &name)
    : name(name)
  {
  }
};

using Competitors = std::vector<std::unique_ptr<Competitor>>;

void
add_our_competitors(Competitors &competitors);
void
add_petsc_competitors(Competitors &competitors);
void
add_rol_competitor(Competitors &competitors);

#endif
