// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/base/text_file.h>
#include <crevasse/parameters/json_reader.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

namespace Crevasse
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    /** Undoes deal.II's mangling of names, "_20" for a space. */
    std::string
    demangle(const std::string &name)
    {
      std::string result;
      for (std::size_t i = 0; i < name.size(); ++i)
        {
          unsigned char character = 0;
          const char   *digits    = name.data() + i + 1;
          if (name[i] == '_' && i + 2 < name.size() &&
              std::from_chars(digits, digits + 2, character, 16).ptr ==
                digits + 2)
            {
              result += static_cast<char>(character);
              i += 2;
            }
          else
            result += name[i];
        }
      return result;
    }



    /** Numbers keep the digits that print them exactly. */
    std::optional<std::string>
    to_text(const Json &value)
    {
      if (value.is_string())
        return Text::squeeze(value.get<std::string>());
      if (value.is_number() || value.is_boolean())
        return value.dump();
      if (!value.is_array())
        return {};

      std::vector<std::string> numbers;
      for (const Json &element : value)
        if (element.is_number())
          numbers.push_back(element.dump());
        else
          return {};
      return Text::join(numbers, ", ");
    }



    /** Names that occur twice, which the parsed object does not tell any more.
     */
    class DuplicateNames
    {
    public:
      void
      see(const Json::parse_event_t event, const Json &parsed)
      {
        if (event == Json::parse_event_t::object_start)
          levels.push_back({});
        else if (event == Json::parse_event_t::object_end)
          levels.pop_back();
        else if (event == Json::parse_event_t::key)
          {
            Level &level = levels.back();
            level.last   = demangle(parsed.get<std::string>());
            if (!level.names.insert(level.last).second)
              duplicates.push_back(path());
          }
      }

      std::vector<std::string> duplicates;

    private:
      struct Level
      {
        std::string           last;
        std::set<std::string> names;
      };

      std::string
      path() const
      {
        std::vector<std::string> names;
        for (const Level &level : levels)
          names.push_back(level.last);
        return Text::join(names, "/");
      }

      std::vector<Level> levels;
    };



    /** Reads the parameters of one section, and the sections in it. */
    void
    read_object(const Json              &object,
                const std::string       &section,
                const std::string       &file_name,
                std::vector<Assignment> &assignments,
                Problems                &problems)
    {
      for (const auto &[key, value] : object.items())
        {
          const std::string name = demangle(key);
          const bool        is_parameter =
            !value.is_object() ||
            (value.contains("value") && !value.at("value").is_object());
          if (!is_parameter)
            {
              const std::string path =
                section.empty() ? name : section + "/" + name;
              assignments.push_back({file_name, path, "", ""});
              // Sections do not nest: one below another is reported as
              // unknown, and what it contains does not matter.
              if (section.empty())
                read_object(value, path, file_name, assignments, problems);
              continue;
            }

          const Json &leaf = value.is_object() ? value.at("value") : value;
          if (const auto text = to_text(leaf))
            assignments.push_back({file_name, section, name, *text});
          else
            problems.add(file_name + ": " + Text::parameter(section, name) +
                         ": must be a number, true or false, a text, or an "
                         "array of numbers");
        }
    }
  } // namespace



  void
  read_json(const std::string       &file_name,
            std::vector<Assignment> &assignments,
            Problems                &problems)
  {
    const std::string text = read_text_file(file_name);
    try
      {
        DuplicateNames names;
        const Json     scene =
          Json::parse(text,
                      [&names](int, Json::parse_event_t event, Json &parsed) {
                        names.see(event, parsed);
                        return true;
                      });
        for (const std::string &name : names.duplicates)
          problems.add(file_name + ": \"" + Text::shorten(name) +
                       "\" occurs twice");

        if (scene.is_object())
          read_object(scene, "", file_name, assignments, problems);
        else
          problems.add(file_name + ": must be one JSON object, {...}");
      }
    catch (const Json::exception &error)
      {
        // The library's number of the error comes first, in brackets.
        const std::string message = error.what();
        const std::size_t bracket = message.find("] ");
        problems.add(file_name + ": is not valid JSON: " +
                     (bracket == std::string::npos
                        ? message
                        : message.substr(bracket + 2)));
      }
  }
} // namespace Crevasse
