// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/join.hpp>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>

namespace Crevasse
{
  namespace Text
  {
    namespace
    {
      /** Number of characters to insert, delete or replace to turn one word
       * into the other, ignoring case. */
      std::size_t
      edit_distance(const std::string &a, const std::string &b)
      {
        std::vector<std::size_t> row(b.size() + 1);
        std::iota(row.begin(), row.end(), 0);
        for (std::size_t i = 0; i < a.size(); ++i)
          {
            std::size_t diagonal = row[0];
            row[0]               = i + 1;
            for (std::size_t j = 0; j < b.size(); ++j)
              {
                const bool equal =
                  std::tolower(static_cast<unsigned char>(a[i])) ==
                  std::tolower(static_cast<unsigned char>(b[j]));
                const std::size_t replaced = diagonal + (equal ? 0 : 1);
                diagonal                   = row[j + 1];
                row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
              }
          }
        return row.back();
      }
    } // namespace



    std::string
    suffix(const std::string &file_name)
    {
      return boost::algorithm::to_lower_copy(
        std::filesystem::path(file_name).extension().string());
    }



    std::vector<std::string>
    split(const std::string &text, const char separator)
    {
      return dealii::Utilities::split_string_list(text, separator);
    }



    std::string
    join(const std::vector<std::string> &parts, const std::string &glue)
    {
      return boost::algorithm::join(parts, glue);
    }



    std::string
    squeeze(const std::string &text)
    {
      std::istringstream       words(text);
      std::vector<std::string> parts;
      for (std::string word; words >> word;)
        parts.push_back(word);
      return join(parts, " ");
    }



    std::string
    shorten(const std::string &text)
    {
      constexpr std::size_t longest = 120;
      if (text.size() <= longest)
        return text;

      // Bytes 10xxxxxx continue a character of UTF-8: do not cut before one.
      std::size_t length = longest;
      while (length > 0 && (text[length] & 0xC0) == 0x80)
        --length;
      return text.substr(0, length) + "...";
    }



    std::string
    parameter(const std::string &section, const std::string &name)
    {
      return section.empty() ? name : "[" + section + "] " + name;
    }



    bool
    is_control(const char character)
    {
      return std::iscntrl(static_cast<unsigned char>(character)) != 0;
    }



    bool
    is_utf8(const std::string &text)
    {
      // Texts are written to JSON files, so the JSON library checks them.
      try
        {
          nlohmann::json(text).dump();
          return true;
        }
      catch (const nlohmann::json::type_error &)
        {
          return false;
        }
    }



    std::string
    from_number(const double number, const int n_digits)
    {
      char       buffer[32];
      const auto end = n_digits == 0
                         ? std::to_chars(buffer, std::end(buffer), number)
                         : std::to_chars(buffer,
                                         std::end(buffer),
                                         number,
                                         std::chars_format::general,
                                         n_digits);
      return std::string(buffer, end.ptr);
    }



    namespace
    {
      /** Reads all of a text as one number. */
      template <typename Number>
      std::optional<Number>
      read_all(const std::string &text)
      {
        Number      number = 0;
        const char *end    = text.data() + text.size();
        const auto  result = std::from_chars(text.data(), end, number);
        if (result.ec != std::errc() || result.ptr != end)
          return {};
        return number;
      }
    } // namespace



    std::optional<double>
    to_number(const std::string &text)
    {
      std::string trimmed = dealii::Utilities::trim(text);
      // std::from_chars rejects a leading plus sign.
      if (trimmed.size() > 1 && trimmed[0] == '+' && trimmed[1] != '-')
        trimmed.erase(0, 1);
      const auto number = read_all<double>(trimmed);
      return number && std::isfinite(*number) ? number : std::nullopt;
    }



    std::optional<unsigned int>
    to_unsigned(const std::string &text)
    {
      return read_all<unsigned int>(dealii::Utilities::trim(text));
    }



    std::optional<std::vector<double>>
    to_numbers(const std::string &text)
    {
      std::vector<double> numbers;
      for (const std::string &part : split(text, ','))
        {
          const auto number = to_number(part);
          if (!number)
            return {};
          numbers.push_back(*number);
        }
      return numbers;
    }



    std::string
    did_you_mean(const std::string              &word,
                 const std::vector<std::string> &candidates)
    {
      std::string nearest;
      std::size_t least = 1 + std::max<std::size_t>(2, word.size() / 4);
      for (const std::string &candidate : candidates)
        {
          // The distance is at least the difference in length, so that most
          // candidates and very long words need no comparison.
          const std::size_t difference =
            std::max(word.size(), candidate.size()) -
            std::min(word.size(), candidate.size());
          if (difference >= least)
            continue;
          const std::size_t distance = edit_distance(word, candidate);
          if (distance < least && distance < candidate.size())
            {
              least   = distance;
              nearest = candidate;
            }
        }
      return nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?";
    }
  } // namespace Text
} // namespace Crevasse
