// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_text_h
#define crevasse_base_text_h

#include <deal.II/base/point.h>

#include <cstdio>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace Crevasse
{
  /** Functions of text to read scenes and to write messages. Numbers are read
   * and written alike under every locale. */
  namespace Text
  {
    /** Splits a text at every @p separator and trims the parts. A separator at
     * the end begins no further part; an empty text has no parts. */
    std::vector<std::string>
    split(const std::string &text, const char separator);

    /** Extension of a file name in lower case: ".csv". */
    std::string
    suffix(const std::string &file_name);

    std::string
    join(const std::vector<std::string> &parts, const std::string &glue);

    /** Replaces every run of white space by one space; none at the ends. */
    std::string
    squeeze(const std::string &text);

    /** Cuts a long text to a length that fits into a message. */
    std::string
    shorten(const std::string &text);

    /** Name of a parameter: "[Section] Name", or "Name" at the top level. */
    std::string
    parameter(const std::string &section, const std::string &name);

    /** Whether a character is an ASCII control character, such as a tab. */
    bool
    is_control(const char character);

    bool
    is_utf8(const std::string &text);

    /** Writes a number with so many digits; 0: the shortest text that reads
     * back as the same number. */
    std::string
    from_number(const double number, const int n_digits = 0);

    /** Writes a point as "(x, y)" with six digits, for messages. */
    template <int dim>
    std::string
    from_point(const dealii::Point<dim> &point)
    {
      std::vector<std::string> coordinates;
      for (unsigned int d = 0; d < dim; ++d)
        coordinates.push_back(from_number(point[d], 6));
      return "(" + join(coordinates, ", ") + ")";
    }

    /** Reads all of a text as one finite number. */
    std::optional<double>
    to_number(const std::string &text);

    /** Reads all of a text as one non-negative integer. */
    std::optional<unsigned int>
    to_unsigned(const std::string &text);

    /** Reads a list of numbers "x, y, ..."; no value if one is not a number. */
    std::optional<std::vector<double>>
    to_numbers(const std::string &text);

    /** Suggestion "; did you mean ...?" with the candidate next to a misspelt
     * word; empty if none is near. */
    std::string
    did_you_mean(const std::string              &word,
                 const std::vector<std::string> &candidates);

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
