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
    /** A text put together as by a stream: numbers have six digits. */
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

    /** As std::printf() has it. */
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
