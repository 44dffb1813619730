// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_held_rows_h
#define crevasse_linear_held_rows_h

#include <crevasse/linear/stiffness_operator.h>

#include <vector>

namespace Crevasse
{
  /** Rows that an operator holds for as long as this object lives, whether an
   * exception ends that or not. */
  template <int dim>
  class HeldRows
  {
  public:
    /** @param rows empty while this object lives. Both must outlive it. */
    HeldRows(StiffnessOperator<dim> &A, std::vector<unsigned int> &rows)
      : A(A)
      , rows(rows)
    {
      A.swap_held(rows);
    }

    HeldRows(const HeldRows &) = delete;
    HeldRows &
    operator=(const HeldRows &) = delete;

    ~HeldRows()
    {
      A.swap_held(rows);
    }

  private:
    StiffnessOperator<dim>    &A;
    std::vector<unsigned int> &rows;
  };
} // namespace Crevasse

#endif
