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
   * What a scene may select as a value of an enum: specialised for each such
   * enum, with its documentation `meaning`, and an array `rows` of structs that
   * begin with `value` and `name` and go on with traits, in the order of the
   * enum.
   */
  template <typename Enum>
  struct Selection;

  /** A row without traits. */
  template <typename Enum>
  struct NamedValue
  {
    Enum        value;
    const char *name;
  };

  /** The row of a value: traits(scheme).is_implicit. */
  template <typename Enum>
  constexpr const auto &
  traits(const Enum value)
  {
    return Selection<Enum>::rows[static_cast<std::size_t>(value)];
  }

  /** What a scene calls the value. */
  template <typename Enum>
  std::string
  name_of(const Enum value)
  {
    return traits(value).name;
  }

  /** Whether a table has a row for each value, in their order. */
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

  /** All names, separated by @p separator. */
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

  /** The value of this name. */
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

  /** Declares the entry @p name of the current subsection, which sets
   * @p value. */
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
