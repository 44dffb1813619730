// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/expression.h>

#include <cctype>

namespace Crevasse
{
  namespace
  {
    bool
    is_in_name(const char c)
    {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
    }



    /** The name that ends before @p end: of a function, if a bracket follows;
     * or nothing. */
    std::string
    name_before(const std::string &formula, std::size_t end)
    {
      while (end > 0 && formula[end - 1] == ' ')
        --end;
      std::size_t begin = end;
      while (begin > 0 && is_in_name(formula[begin - 1]))
        --begin;
      return formula.substr(begin, end - begin);
    }



    bool
    has_variable(const std::string &text, const std::string &variable)
    {
      for (std::size_t at = text.find(variable); at != std::string::npos;
           at             = text.find(variable, at + 1))
        {
                      const std::size_t end = at + variable.size();
                      if ((at == 0 || !is_in_name(text[at - 1])) &&
              (end == text.size() || !is_in_name(text[end])))
            return true;
        }
      return false;
    }



    /** One level of brackets: what lies between them, commas, "?" and ":" is a
     * part, with all deeper levels in it. */
    struct Level
    {
      std::string function; ///< before the bracket
      bool        is_first_argument;
      std::size_t begin;    ///< of the part
      bool        compares; ///< at this level
    };
  } // namespace



  bool
  Expression::can_jump_with(const std::string &variable) const
  {
    std::vector<Level> levels = {{"", true, 0, false}};
    for (std::size_t i = 0; i <= text.size(); ++i)
      {
        const char c     = i < text.size() ? text[i] : ',';
        Level     &level = levels.back();
        if (c == '(')
          levels.push_back({name_before(text, i), true, i + 1, false});
        else if (std::string("<>=!&|").find(c) != std::string::npos)
          level.compares = true;
        else if (std::string(",?:)").find(c) != std::string::npos)
          {
            const std::string &f            = level.function;
            const bool         is_condition = level.compares || c == '?' ||
                                      (f == "if" && level.is_first_argument) ||
                                      f == "sign" || f == "rint" ||
                                      f == "floor" || f == "ceil";
            if (is_condition &&
                has_variable(text.substr(level.begin, i - level.begin),
                             variable))
              return true;
            level.begin    = i + 1;
            level.compares = false;
            level.is_first_argument &= c != ',';
            if (c == ')')
              levels.pop_back();
          }
      }
    return false;
  }
} // namespace Crevasse
