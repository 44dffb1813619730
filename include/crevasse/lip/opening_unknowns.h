// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_lip_opening_unknowns_h
#define crevasse_lip_opening_unknowns_h

#include <deal.II/base/types.h>

#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace Crevasse
{
  /**
   * Basis in which linear functions of the degrees of freedom are unknowns. The
   * k degrees of freedom u of a function a·u become a linear combination of k
   * unknowns numbered after all degrees of freedom: Householder's reflection
   * with a/|a| as one column, scaled so that its unknown is a·u. If functions
   * share degrees of freedom, a later function combines the unknowns of the
   * earlier ones.
   */
  class OpeningUnknowns
  {
  public:
    using Index   = dealii::types::global_dof_index;
    using Weights = std::vector<std::pair<Index, double>>;
    /** Linear combinations that indices represent. */
    using Meanings = std::map<Index, Weights>;

    explicit OpeningUnknowns(const Index n_dofs = 0)
      : n_dofs(n_dofs)
    {
    }

    /** Number of unknowns after the degrees of freedom. */
    Index n_unknowns = 0;

    /** Degrees of freedom as linear combinations of the unknowns. */
    Meanings combinations;

    /** Unknowns as linear combinations of the degrees of freedom. */
    Meanings functionals;

    /** Adds a weight times the meaning of an index, or times the index. */
    static void
    add_expanded(const Index     index,
                 const double    weight,
                 const Meanings &meanings,
                 Weights        &sum);

  protected:
    /** Makes a function of degrees of freedom an unknown, with a preliminary
     * number; invalid for an empty function. If the function is ± a degree of
     * freedom, and @p may_be_dof, this stays the unknown.
     * @return the unknown and its sign; no value if the function depends on
     * earlier functions, so that it cannot be an unknown. */
    std::optional<std::pair<Index, double>>
    make_unknown(const Weights &function, const bool may_be_dof);

    /** Numbers the unknowns that later ones did not replace.
     * @return their new numbers by their preliminary numbers. */
    std::map<Index, Index>
    number_unknowns();

  private:
    /** Splits a function into unknowns of earlier functions and the rest. */
    std::pair<Weights, Weights>
    split(const Weights &function) const;

    Index
    combine(const Weights &former, const Weights &rest);

    Index           n_dofs;
    std::set<Index> made; ///< unknowns of functions
  };
} // namespace Crevasse

#endif
