// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/scene/problems.h>
#include <crevasse/scene/text.h>

#include <algorithm>

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
    if (!messages.empty())
      throw SceneError(Text::join(messages, "\n"));
  }
} // namespace Crevasse
