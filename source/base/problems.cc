// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>

#include <algorithm>
#include <tuple>

namespace Crevasse
{
  namespace
  {
    /** Replaces control characters in a message that quotes input: a zero byte
     * would end the message, and others confuse a terminal. */
    std::string
    printable(std::string message)
    {
      for (char &character : message)
        if (character != '\n' && Text::is_control(character))
          character = '?';
      return message;
    }
  } // namespace



  std::string
  Origin::text() const
  {
    return source + (line == 0 ? "" : ":" + std::to_string(line));
  }



  void
  Problems::add(const std::string &message, const Origin &origin)
  {
    messages.emplace_back(
      origin,
      printable((origin.source.empty() ? "" : origin.text() + ": ") + message));
  }



  void
  Problems::add(const std::string &section,
                const std::string &name,
                const std::string &value,
                const std::string &allowed)
  {
    add(Text::parameter(section, name) + " = " +
          (value.empty() ? "(empty)" : Text::shorten(value)) + ": " + allowed,
        origins[{section, name}]);
    concerned.emplace(section, name);
  }



  void
  Problems::add(const std::string &section,
                const std::string &name,
                const std::string &allowed)
  {
    add(section, name, values[{section, name}], allowed);
  }



  void
  Problems::throw_if_any() const
  {
    if (messages.empty())
      return;
    // Messages are sorted by file in the order of appearance, then by line;
    // messages without a line come last.
    std::map<std::string, std::size_t> rank;
    for (const auto &[origin, message] : messages)
      rank.emplace(origin.source, rank.size());
    const auto key = [&rank](const auto &message) {
      const Origin &origin = message.first;
      return std::make_tuple(origin.line == 0,
                             origin.line == 0 ? 0 : rank[origin.source],
                             origin.line);
    };
    auto in_order = messages;
    std::stable_sort(in_order.begin(),
                     in_order.end(),
                     [&key](const auto &a, const auto &b) {
                       return key(a) < key(b);
                     });
    std::string text = messages.size() == 1
                         ? ""
                         : std::to_string(messages.size()) + " problems:";
    for (const auto &[origin, message] : in_order)
      text += (text.empty() ? "" : "\n") + message;
    if (n_unreadable == messages.size())
      throw FileError(text);
    throw SceneError(text);
  }
} // namespace Crevasse
