// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/parameters/tensor_formulas.h>

#include <algorithm>
#include <iterator>

namespace Crevasse
{
  namespace
  {
    constexpr auto tensor_variables =
      Expression::Variables::space_time_and_material;



    /** The numbers of rows that there may be, and their components. */
    struct Shapes
    {
      std::vector<std::size_t> sizes;
      std::string              text;
    };



    Shapes
    shapes_of_matrix(const unsigned int dimension, const bool plane_stress)
    {
      if (dimension == 3)
        return {{6}, "6 (11, 22, 33, 12, 13, 23) rows"};
      if (plane_stress)
        return {{3, 4}, "3 (11, 22, 12) or 4 (11, 22, 33, 12) rows"};
      return {{4}, "4 (11, 22, 33, 12) rows"};
    }
  } // namespace



  std::vector<Expression>
  parse_matrix(const std::string &text,
               const unsigned int dimension,
               const bool         plane_stress,
               const std::string &parameter)
  {
    const std::vector<std::string> rows = Text::split(text, ';');
    const Shapes shapes = shapes_of_matrix(dimension, plane_stress);
    if (std::count(shapes.sizes.begin(), shapes.sizes.end(), rows.size()) == 0)
      throw SceneError("must have " + shapes.text +
                       ", separated by semicolons; it has " +
                       std::to_string(rows.size()));

    std::vector<Expression> formulas;
    for (const std::string &row : rows)
      {
        std::vector<Expression> entries =
          Expression::parse_row(row, tensor_variables, parameter);
        if (entries.size() != rows.size())
          throw SceneError("the row \"" + Text::shorten(row) + "\" must have " +
                           std::to_string(rows.size()) +
                           " entries, separated by commas; it has " +
                           std::to_string(entries.size()));
        std::move(entries.begin(), entries.end(), std::back_inserter(formulas));
      }
    return formulas;
  }



  std::vector<Expression>
  parse_tensor(const std::string &text,
               const unsigned int dimension,
               const std::string &parameter)
  {
    std::vector<Expression> formulas =
      Expression::parse_row(text, tensor_variables, parameter);
    const std::size_t n       = formulas.size();
    const bool        is_full = n == (dimension == 2 ? 4 : 6);
    if (n != 1 && !is_full && !(dimension == 2 && n == 3))
      throw SceneError(
        std::string("must have ") + (dimension == 2 ? "1, 3 or 4" : "1 or 6") +
        " components, separated by commas; it has " + std::to_string(n));
    return formulas;
  }
} // namespace Crevasse
