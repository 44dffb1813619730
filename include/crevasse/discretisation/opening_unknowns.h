// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_opening_unknowns_h
#define crevasse_discretisation_opening_unknowns_h

#include <deal.II/base/types.h>

#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace Crevasse
{
  /**
   * A basis in which linear functions of the degrees of freedom are unknowns.
   * The k degrees of freedom u of a function a·u become a linear combination of
   * k unknowns numbered after all degrees of freedom: Householder's reflection
   * with a/|a| as one column, scaled so that its unknown is a·u. Where
   * functions share degrees of freedom, the later ones combine what the former
   * ones left.
   */
  class OpeningUnknowns
  {
  public:
    using Index   = dealii::types::global_dof_index;
    using Weights = std::vector<std::pair<Index, double>>;
    /** What indices stand for. */
    using Meanings = std::map<Index, Weights>;

    explicit OpeningUnknowns(const Index n_dofs = 0)
      : n_dofs(n_dofs)
    {
    }

    /** How many unknowns there are after the degrees of freedom. */
    Index n_unknowns = 0;

    /** What degrees of freedom are of the unknowns. */
    Meanings combinations;

    /** The inverse: what the unknowns are of the degrees of freedom. */
    Meanings functionals;

    /** Adds a weight times what an index stands for, or times the index. */
    static void
    add_expanded(const Index     index,
                 const double    weight,
                 const Meanings &meanings,
                 Weights        &sum);

  protected:
    /** The unknown that is this function of degrees of freedom, till all are
     * numbered anew; none for nothing. If a degree of freedom is the function,
     * times ±1, and @p may_be_dof, it stays the unknown.
     * @return besides, the sign; nothing if the function depends on former ones
     * alone, so that it cannot be an unknown. */
    std::optional<std::pair<Index, double>>
    make_unknown(const Weights &function, const bool may_be_dof);

    /** Without those that later ones replaced.
     * @return the new numbers of the others. */
    std::map<Index, Index>
    number_unknowns();

  private:
    /** By what is not replaced: that of former functions, and the rest. */
    std::pair<Weights, Weights>
    split(const Weights &function) const;

    Index
    combine(const Weights &former, const Weights &rest);

    Index           n_dofs;
    std::set<Index> made; ///< the functions' unknowns
  };
} // namespace Crevasse

#endif
