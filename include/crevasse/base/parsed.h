// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_parsed_h
#define crevasse_base_parsed_h

#include <crevasse/base/problems.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <optional>

namespace Crevasse
{
  /**
   * A parameter that is a text in the scene file and a value in the program,
   * such as a formula or a list of points. The text is parsed once, when it is
   * set. A text that cannot be parsed is kept together with the reason, so that
   * only scenes that use the parameter fail.
   */
  template <typename Value>
  class Parsed
  {
  public:
    /** Parses a text, or throws a SceneError that says what is expected. */
    using Parser = std::function<Value(const std::string &)>;

    Parsed(const std::string &text, Parser parser)
      : parse(std::move(parser))
    {
      *this = text;
    }

    Parsed &
    operator=(const std::string &text)
    {
      source = text;
      reason.clear();
      value.reset();
      try
        {
          value.emplace(parse(text));
        }
      catch (const SceneError &error)
        {
          reason = error.what();
        }
      return *this;
    }

    /** Parsed value. @throw SceneError if the text could not be parsed. */
    const Value &
    operator*() const
    {
      if (!value)
        throw SceneError(reason);
      return *value;
    }

    const Value *
    operator->() const
    {
      return &**this;
    }

    /** Parsed value, to be changed in place: names replaced by numbers. */
    Value &
    edit()
    {
      return *value;
    }

    const std::string &
    text() const
    {
      return source;
    }

    /** Whether the text could be parsed. */
    bool
    is_valid() const
    {
      return value.has_value();
    }

    /** Why the text could not be parsed. */
    const std::string &
    error() const
    {
      return reason;
    }

    /** Declares the parameter @p name, which sets this object. */
    void
    add_parameter(const std::string        &name,
                  const std::string        &documentation,
                  dealii::ParameterHandler &prm)
    {
      prm.declare_entry(name,
                        source,
                        dealii::Patterns::Anything(),
                        documentation);
      prm.add_action(name, [this](const std::string &text) { *this = text; });
    }

  private:
    Parser               parse;
    std::string          source;
    std::optional<Value> value;
    std::string          reason;
  };
} // namespace Crevasse

#endif
