// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_format_h
#define crevasse_base_format_h

#include <cstdio>
#include <sstream>
#include <string>

namespace Crevasse
{
  namespace Text
  {
    /** A message assembled by <<; numbers have six digits. */
    class Message
    {
    public:
      template <typename Part>
      Message &
      operator<<(const Part &part)
      {
        static_cast<std::ostream &>(stream) << part;
        return *this;
      }

      operator std::string() const
      {
        return stream.str();
      }

    private:
      std::ostringstream stream;
    };

    /** Text formatted like std::printf(), at most 999 characters. */
    template <typename... Arguments>
    std::string
    format(const char *pattern, const Arguments... arguments)
    {
      char text[1000];
      std::snprintf(text, sizeof(text), pattern, arguments...);
      return text;
    }
  } // namespace Text
} // namespace Crevasse

#endif
