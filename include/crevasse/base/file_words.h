// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_file_words_h
#define crevasse_base_file_words_h

#include <limits>
#include <string>

namespace Crevasse
{
  /** The words of a text file one after the other, between white space, with
   * the line of each for messages. The text must live as long as this does. */
  class FileWords
  {
  public:
    explicit FileWords(const std::string &text);

    /** The next word. @throw SceneError if there is none. */
    std::string
    next(const std::string &expected);

    /** The next word must be this one. */
    void
    expect(const std::string &word);

    /** Whether the next word is this one, which then is read. */
    bool
    next_is(const std::string &word);

    /** Goes on until after this word. */
    void
    skip_to(const std::string &word);

    /** The next word as an integer from @p least to the largest int. */
    int
    integer(const std::string &expected,
            const int          least = std::numeric_limits<int>::min());

    /** The next word as a finite number. */
    double
    number(const std::string &expected);

    /** The line of the word that was read last. */
    unsigned int
    line() const;

    /** Speaks of this line, as "line 7: 12 is no node".
     * @throw SceneError always */
    [[noreturn]] static void
    refuse(const unsigned int line, const std::string &reason);

    /** Speaks of the line of the word that was read last. */
    [[noreturn]] void
    refuse(const std::string &reason) const;

  private:
    bool
    read(std::string &word);

    const std::string &text;
    std::size_t        position       = 0;
    unsigned int       line_of_word   = 1;
    unsigned int       line_of_reader = 1;
  };
} // namespace Crevasse

#endif
