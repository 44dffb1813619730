// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_selection_h
#define crevasse_base_selection_h

#include <deal.II/base/exceptions.h>
#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <iterator>
#include <string>

namespace Crevasse
{
  /**
   * Values of an enum that a scene may select. Specialised for each such enum,
   * with its documentation `meaning`, and an array `rows` of structs that begin
   * with `value` and `name`, followed by traits, in the order of the enum.
   */
  template <typename Enum>
  struct Selection;

  /** Row of a Selection without traits. */
  template <typename Enum>
  struct NamedValue
  {
    Enum        value;
    const char *name;
  };

  /** Row of a Selection with some traits, a sum of enumerators of Trait. */
  template <typename Enum, typename Trait>
  struct ValueWithTraits
  {
    Enum         value;
    const char  *name;
    unsigned int traits;

    constexpr bool
    has(const Trait trait) const
    {
      return (traits & trait) != 0;
    }
  };

  /** Row of a Selection for a value, as in traits(scheme).name. */
  template <typename Enum>
  constexpr const auto &
  traits(const Enum value)
  {
    return Selection<Enum>::rows[static_cast<std::size_t>(value)];
  }

  /** Name of an enum's value in a scene. */
  template <typename Enum>
  std::string
  name_of(const Enum value)
  {
    return traits(value).name;
  }

  /** Whether a table has a row for each value of an enum, in their order. */
  template <typename Enum, typename Rows>
  constexpr bool
  follows_enum(const Rows &rows)
  {
    std::size_t i = 0;
    for (const auto &row : rows)
      if (static_cast<std::size_t>(row.value) != i++)
        return false;
    return i == std::size(Selection<Enum>::rows);
  }

  /** Names of all values of an enum, separated by @p separator. */
  template <typename Enum>
  std::string
  all_names(const std::string &separator)
  {
    static_assert(follows_enum<Enum>(Selection<Enum>::rows),
                  "rows in the order of the enum");
    std::string names;
    for (const auto &row : Selection<Enum>::rows)
      names += (names.empty() ? "" : separator) + row.name;
    return names;
  }

  /** Value of an enum with this name. */
  template <typename Enum>
  Enum
  value_of(const std::string &name)
  {
    for (const auto &row : Selection<Enum>::rows)
      if (name == row.name)
        return row.value;
    AssertThrow(false,
                dealii::ExcMessage('"' + name + "\" is not one of " +
                                   all_names<Enum>(", ")));
    return {};
  }

  /** Declares a parameter @p name for an enum in the current subsection; it
   * sets @p value. */
  template <typename Enum>
  void
  add_selection(const std::string        &name,
                Enum                     &value,
                dealii::ParameterHandler &prm)
  {
    prm.declare_entry(name,
                      name_of(value),
                      dealii::Patterns::Selection(all_names<Enum>("|")),
                      Selection<Enum>::meaning);
    prm.add_action(name, [&value](const std::string &text) {
      value = value_of<Enum>(text);
    });
  }
} // namespace Crevasse

#endif
