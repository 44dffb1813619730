// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace Crevasse
{
  namespace
  {
    /** What the user wrote is quoted in messages. A zero byte would end the
     * text of an exception, and other control characters confuse a terminal. */
    std::string
    printable(std::string message)
    {
      for (char &character : message)
        if (character != '\n' && Text::is_control(character))
          character = '?';
      return message;
    }



    struct FileLine
    {
      std::string  file;
      unsigned int line = 0; ///< 0: none
    };



    /** The place that a message begins with, as in "scene.prm:12: ...". */
    FileLine
    place_of(const std::string &message)
    {
      for (std::size_t colon = message.find(':'); colon != std::string::npos;
           colon             = message.find(':', colon + 1))
        {
                      const std::size_t end =
                        message.find_first_not_of("0123456789", colon + 1);
                      if (end != std::string::npos && message.compare(end, 2, ": ") == 0)
            if (const auto line =
                  Text::to_unsigned(message.substr(colon + 1, end - colon - 1)))
              return {message.substr(0, colon), *line};
        }
      return {};
    }



    /** File by file in the order in which they appear, the lines of each one
     * after the other; at the end what has no line, such as an option of the
     * command line. */
    std::vector<std::string>
    in_order_of_lines(std::vector<std::string> messages)
    {
      std::map<std::string, std::size_t> rank;
      for (const std::string &message : messages)
        rank.emplace(place_of(message).file, rank.size());

      const auto key = [&rank](const std::string &message) {
        const FileLine place = place_of(message);
        return std::make_tuple(place.line == 0, rank[place.file], place.line);
      };
      std::stable_sort(messages.begin(),
                       messages.end(),
                       [&key](const std::string &a, const std::string &b) {
                         return key(a) < key(b);
                       });
      return messages;
    }
  } // namespace



  void
  Problems::add(const std::string &message)
  {
    messages.push_back(printable(message));
  }



  void
  Problems::add(const std::string &section,
                const std::string &name,
                const std::string &value,
                const std::string &allowed)
  {
    const auto        place = places.find({section, name});
    const std::string origin =
      place == places.end() ? "" : place->second + ": ";

    add(origin + Text::parameter(section, name) + " = " +
        (value.empty() ? "(nothing)" : Text::shorten(value)) + ": " + allowed);
    concerned.emplace(section, name);
  }



  void
  Problems::add_unreadable(const std::string &section,
                           const std::string &name,
                           const std::string &file_name,
                           const std::string &reason)
  {
    add(section, name, file_name, reason);
    ++n_unreadable;
  }



  void
  Problems::add_unreadable(const std::string &message)
  {
    add(message);
    ++n_unreadable;
  }



  void
  Problems::locate(const std::string &section,
                   const std::string &name,
                   const std::string &place)
  {
    places[{section, name}] = place;
  }



  bool
  Problems::empty() const
  {
    return messages.empty();
  }



  bool
  Problems::concern(const std::string &section) const
  {
    return std::any_of(concerned.begin(),
                       concerned.end(),
                       [&section](const Parameter &parameter) {
                         return parameter.first == section;
                       });
  }



  bool
  Problems::concern(const std::string &section, const std::string &name) const
  {
    return concerned.count({section, name}) > 0;
  }



  void
  Problems::throw_if_any() const
  {
    if (messages.empty())
      return;
    const std::string text =
      messages.size() == 1 ? messages[0]
                           : std::to_string(messages.size()) + " problems:\n" +
                               Text::join(in_order_of_lines(messages), "\n");
    if (n_unreadable == messages.size())
      throw FileError(text);
    throw SceneError(text);
  }
} // namespace Crevasse
