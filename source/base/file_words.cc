// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/file_words.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>

#include <algorithm>
#include <charconv>

namespace Crevasse
{
  namespace
  {
    /** A word as messages show it; a file may contain anything. */
    std::string
    quote(const std::string &word)
    {
      const bool is_text =
        Text::is_utf8(word) &&
        std::none_of(word.begin(), word.end(), Text::is_control);
      return is_text ? "\"" + Text::shorten(word) + "\""
                     : "something that is no text";
    }
  } // namespace



  FileWords::FileWords(const std::string &text)
    : text(text)
  {
  }



  bool
  FileWords::read(std::string &word)
  {
    while (position < text.size() && Text::is_space(text[position]))
      line_of_reader += text[position++] == '\n' ? 1 : 0;
    const std::size_t begin = position;
    while (position < text.size() && !Text::is_space(text[position]))
      ++position;
    word.assign(text, begin, position - begin);
    line_of_word = line_of_reader;
    return !word.empty();
  }



  std::string
  FileWords::next(const std::string &expected)
  {
    std::string word;
    if (!read(word))
      refuse("the file breaks off where " + expected + " must be");
    return word;
  }



  void
  FileWords::expect(const std::string &word)
  {
    if (const std::string found = next("\"" + word + "\""); found != word)
      refuse(quote(found) + " stands where \"" + word + "\" must be");
  }



  bool
  FileWords::next_is(const std::string &word)
  {
    const std::size_t before      = position;
    const auto        line_before = line_of_reader;
    std::string       found;
    if (read(found) && found == word)
      return true;
    position       = before;
    line_of_reader = line_before;
    return false;
  }



  void
  FileWords::skip_to(const std::string &word)
  {
    while (next("\"" + word + "\"") != word)
      {
      }
  }



  int
  FileWords::integer(const std::string &expected, const int least)
  {
    const std::string word    = next(expected);
    int               integer = 0;
    const char       *end     = word.data() + word.size();
    const auto        result  = std::from_chars(word.data(), end, integer);
    if (result.ec != std::errc() || result.ptr != end || integer < least)
      refuse(quote(word) + " stands where " + expected +
             " must be, an integer from " + std::to_string(least) + " to " +
             std::to_string(std::numeric_limits<int>::max()));
    return integer;
  }



  double
  FileWords::number(const std::string &expected)
  {
    const std::string word   = next(expected);
    const auto        number = Text::to_number(word);
    if (!number)
      refuse(quote(word) + " stands where " + expected +
             " must be, a finite number");
    return *number;
  }



  unsigned int
  FileWords::line() const
  {
    return line_of_word;
  }



  void
  FileWords::refuse(const unsigned int line, const std::string &reason)
  {
    throw SceneError("line " + std::to_string(line) + ": " + reason);
  }



  void
  FileWords::refuse(const std::string &reason) const
  {
    refuse(line_of_word, reason);
  }
} // namespace Crevasse
