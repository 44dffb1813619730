// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/parameters/catalogue.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;
  using Json = nlohmann::ordered_json;

  namespace
  {
    bool
    begins_with(const std::string &text, const std::string &beginning)
    {
      return text.compare(0, beginning.size(), beginning) == 0;
    }



    /** deal.II's description of a pattern, such as "[Integer range 0...9
     * (inclusive)]", in words. */
    std::string
    in_words(const std::string &pattern)
    {
      if (begins_with(pattern, "[List of <[Double"))
        return "a list of numbers, separated by commas";
      if (begins_with(pattern, "[List of <[Integer range 0..."))
        return "a list of integers of at least 0, separated by commas";
      if (begins_with(pattern, "[Double"))
        return "a number";
      if (begins_with(pattern, "[Integer range 0..."))
        return "an integer of at least 0";
      if (begins_with(pattern, "[Bool"))
        return "true or false";
      if (begins_with(pattern, "[Anything"))
        return "any text";

      const std::string selection = "[Selection ";
      if (begins_with(pattern, selection))
        {
          const std::size_t end     = pattern.rfind(']');
          const auto        choices = Text::split(
            pattern.substr(selection.size(), end - selection.size()), '|');
          return (choices.size() == 1 ? "" : "one of: ") +
                 Text::join(choices, ", ");
        }
      return pattern;
    }



    Catalogue::Parameter
    read_parameter(const std::string &name, const Json &entry)
    {
      Catalogue::Parameter parameter;
      parameter.name          = name;
      parameter.default_value = entry.at("default_value").get<std::string>();
      parameter.meaning       = entry.at("documentation").get<std::string>();
      parameter.type =
        in_words(entry.at("pattern_description").get<std::string>());
      parameter.allowed = parameter.type;

      const std::string mark  = "Allowed:";
      const std::size_t begin = parameter.meaning.find(mark);
      if (begin != std::string::npos)
        {
          parameter.allowed =
            Utilities::trim(parameter.meaning.substr(begin + mark.size()));
          parameter.meaning =
            Utilities::trim(parameter.meaning.substr(0, begin));
        }
      return parameter;
    }



    template <typename Item>
    const Item *
    find_name(const std::vector<Item> &items, const std::string &name)
    {
      const auto item =
        std::find_if(items.begin(), items.end(), [&name](const Item &item) {
          return item.name == name;
        });
      return item == items.end() ? nullptr : &*item;
    }
  } // namespace



  Catalogue::Catalogue(const ParameterHandler &prm)
    : sections(1)
  {
    std::stringstream stream;
    prm.print_parameters(stream,
                         ParameterHandler::JSON |
                           ParameterHandler::KeepDeclarationOrder);

    const Json declared = Json::parse(stream);
    for (const auto &[name, entry] : declared.items())
      if (entry.contains("default_value"))
        sections[0].parameters.push_back(read_parameter(name, entry));
      else
        {
          Section section{name, {}};
          for (const auto &[key, value] : entry.items())
            section.parameters.push_back(read_parameter(key, value));
          sections.push_back(section);
        }
  }



  const Catalogue::Section *
  Catalogue::find(const std::string &name) const
  {
    return find_name(sections, name);
  }



  std::vector<std::string>
  Catalogue::names() const
  {
    std::vector<std::string> result;
    for (const Section &section : sections)
      if (!section.name.empty())
        result.push_back(section.name);
    return result;
  }



  const Catalogue::Parameter *
  Catalogue::Section::find(const std::string &name) const
  {
    return find_name(parameters, name);
  }



  std::vector<std::string>
  Catalogue::Section::names() const
  {
    std::vector<std::string> result;
    for (const Parameter &parameter : parameters)
      result.push_back(parameter.name);
    return result;
  }
} // namespace Crevasse
