// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_text_h
#define crevasse_base_text_h

#include <deal.II/base/point.h>

#include <optional>
#include <string>
#include <vector>

namespace Crevasse
{
  /** What reading a scene and speaking about it need of text. Numbers are read
   * and written alike under every locale. */
  namespace Text
  {
    /** Cuts at every @p separator and trims the parts. A separator at the end
     * does not begin another part, so that nothing gives no parts. */
    std::vector<std::string>
    split(const std::string &text, const char separator);

    /** What a file name ends in, in small letters: ".csv". */
    std::string
    suffix(const std::string &file_name);

    std::string
    join(const std::vector<std::string> &parts, const std::string &glue);

    /** One space for every run of white space, none at the ends. */
    std::string
    squeeze(const std::string &text);

    /** A long text cut to what fits into a message. */
    std::string
    shorten(const std::string &text);

    /** "[Section] Name", or only "Name" at the top level. */
    std::string
    parameter(const std::string &section, const std::string &name);

    /** Whether it is a control character of ASCII, such as a tabulator. */
    bool
    is_control(const char character);

    bool
    is_utf8(const std::string &text);

    /** With so many digits; 0: the shortest text that reads back as the same
     * number. */
    std::string
    from_number(const double number, const int n_digits = 0);

    /** "(x, y)" with six digits, for messages. */
    template <int dim>
    std::string
    from_point(const dealii::Point<dim> &point);

    /** All of the text as one finite number. */
    std::optional<double>
    to_number(const std::string &text);

    /** All of the text as one integer that is not negative. */
    std::optional<unsigned int>
    to_unsigned(const std::string &text);

    /** The numbers of "x, y, ..."; nothing if one of them is none. */
    std::optional<std::vector<double>>
    to_numbers(const std::string &text);

    /** "; did you mean ...?" with the candidate next to a misspelt word, or
     * nothing if none is near. */
    std::string
    did_you_mean(const std::string              &word,
                 const std::vector<std::string> &candidates);
  } // namespace Text
} // namespace Crevasse

#endif
