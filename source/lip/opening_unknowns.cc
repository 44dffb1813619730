// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/lip/opening_unknowns.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  namespace
  {
    constexpr double rounding = 1e-12;
  } // namespace



  void
  OpeningUnknowns::add_expanded(const Index     index,
                                const double    weight,
                                const Meanings &meanings,
                                Weights        &sum)
  {
    if (const auto meaning = meanings.find(index); meaning != meanings.end())
      {
        for (const auto &[other, factor] : meaning->second)
          add_expanded(other, weight * factor, meanings, sum);
        return;
      }
    const auto there =
      std::find_if(sum.begin(), sum.end(), [index](const auto &term) {
        return term.first == index;
      });
    if (there == sum.end())
      sum.emplace_back(index, weight);
    else
      there->second += weight;
  }



  std::pair<OpeningUnknowns::Weights, OpeningUnknowns::Weights>
  OpeningUnknowns::split(const Weights &function) const
  {
    Weights sum, former, rest;
    for (const auto &[dof, weight] : function)
      add_expanded(dof, weight, combinations, sum);
    for (const auto &[index, weight] : sum)
      if (std::abs(weight) > rounding)
        (made.count(index) > 0 ? former : rest).emplace_back(index, weight);
    return {former, rest};
  }



  std::optional<std::pair<OpeningUnknowns::Index, double>>
  OpeningUnknowns::make_unknown(const Weights &function, const bool may_be_dof)
  {
    const auto [former, rest] = split(function);
    if (rest.empty() && !former.empty())
      return {};
    if (rest.empty())
      return {{dealii::numbers::invalid_dof_index, 1.}};
    std::pair<Index, double> unknown{rest[0].first,
                                     std::copysign(1., rest[0].second)};
    if (!may_be_dof || !former.empty() || rest.size() > 1 ||
        std::abs(std::abs(rest[0].second) - 1.) > rounding ||
        rest[0].first >= n_dofs)
      unknown = {combine(former, rest), 1.};
    made.insert(unknown.first);
    return unknown;
  }



  OpeningUnknowns::Index
  OpeningUnknowns::combine(const Weights &former, const Weights &rest)
  {
    const unsigned int n      = rest.size();
    double             square = 0.;
    unsigned int       pivot  = 0;
    for (unsigned int i = 0; i < n; ++i)
      {
        square += rest[i].second * rest[i].second;
        if (std::abs(rest[i].second) >
            (1. + rounding) * std::abs(rest[pivot].second))
          pivot = i;
      }
    const double length = std::sqrt(square);
    const auto   w      = [&](const unsigned int i) {
      return rest[i].second / length;
    };
    const auto v = [&](const unsigned int i) {
      return w(i) + (i == pivot ? std::copysign(1., w(pivot)) : 0.);
    };
    const auto reflection = [&](const unsigned int i, const unsigned int j) {
      return (i == j ? 1. : 0.) - v(i) * v(j) / (1. + std::abs(w(pivot)));
    };

    const Index first = n_dofs + n_unknowns;
    n_unknowns += n;
    for (unsigned int j = 0; j < n; ++j)
      {
        Weights &functional = functionals[first + j];
        for (unsigned int i = 0; i < n; ++i)
          add_expanded(rest[i].first,
                       j == pivot ? rest[i].second : reflection(j, i),
                       functionals,
                       functional);
        if (j == pivot)
          for (const auto &[opening, factor] : former)
            add_expanded(opening, factor, functionals, functional);
      }
    for (unsigned int i = 0; i < n; ++i)
      {
        Weights &combination = combinations[rest[i].first];
        for (unsigned int j = 0; j < n; ++j)
          if (const double weight =
                j == pivot ? w(i) / length : reflection(i, j);
              std::abs(weight) > rounding)
            combination.emplace_back(first + j, weight);
        for (const auto &[opening, factor] : former)
          combination.emplace_back(opening, -factor * w(i) / length);
      }
    return first + pivot;
  }



  std::map<OpeningUnknowns::Index, OpeningUnknowns::Index>
  OpeningUnknowns::number_unknowns()
  {
    std::map<Index, Index> numbers;
    for (const auto &[unknown, weights] : functionals)
      if (combinations.count(unknown) == 0)
        numbers.emplace(unknown, n_dofs + numbers.size());
    Meanings of_dofs, of_unknowns;
    for (const auto &[dof, weights] : combinations)
      if (dof < n_dofs)
        {
          Weights &sum = of_dofs[dof];
          add_expanded(dof, 1., combinations, sum);
          for (auto &[unknown, weight] : sum)
            if (unknown >= n_dofs)
              unknown = numbers.at(unknown);
        }
    for (const auto &[unknown, index] : numbers)
      of_unknowns[index] = functionals[unknown];
    combinations = of_dofs;
    functionals  = of_unknowns;
    n_unknowns   = numbers.size();
    return numbers;
  }
} // namespace Crevasse
