// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/base/version.h>
#include <crevasse/parameters/catalogue.h>

#include <deal.II/base/utilities.h>

#include <limits>
#include <regex>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Splits deal.II's description of a pattern, or NumberPattern's, such as
     * "[Integer range 0...9 (inclusive)]", into "Integer", "0", "9",
     * "inclusive". A description of another form is the only part. */
    std::vector<std::string>
    parts_of_pattern(const std::string &description)
    {
      static const std::regex forms[] = {
        std::regex("\\[(List) of <(.*)> of.*"),
        std::regex(
          "\\[(Integer|Number) range (.*)\\.\\.\\.(\\S+) \\((.*)\\)\\]"),
        std::regex("\\[(Selection) (.*?) ?\\]")};
      for (const std::regex &form : forms)
        if (std::smatch parts; std::regex_match(description, parts, form))
          return {std::next(parts.begin()), parts.end()};
      return {description};
    }



    std::string
    in_words(const std::string &pattern)
    {
      const std::vector<std::string> parts = parts_of_pattern(pattern);
      const std::string             &kind  = parts[0];
      if (kind == "List")
        return "a list separated by commas, each " + in_words(parts[1]);
      if (kind == "Integer")
        {
          const int least = std::stoi(parts[1]), most = std::stoi(parts[2]);
          if (most == std::numeric_limits<int>::max())
            return "an integer of at least " + parts[1];
          return most == least + 1
                   ? parts[1] + " or " + parts[2]
                   : "an integer from " + parts[1] + " to " + parts[2];
        }
      if (kind == "Number")
        return "a number " + parts[3];
      if (kind == "Selection")
        return (parts[1].find('|') == std::string::npos ? "" : "one of: ") +
               Text::join(Text::split(parts[1], '|'), ", ");
      return kind == "[Bool]"       ? "true or false"
             : kind == "[Anything]" ? "any text"
                                    : pattern;
    }



    /** Moves the allowed values from the documentation of a parameter to
     * "allowed" where its pattern does not describe them. */
    Catalogue
    describe(Catalogue entry)
    {
      const std::string mark    = "Allowed:";
      const auto        meaning = entry.at("documentation").get<std::string>();
      const std::size_t begin   = meaning.find(mark);
      entry["documentation"]    = Utilities::trim(meaning.substr(0, begin));
      entry["allowed"] =
        begin == std::string::npos
          ? in_words(entry.at("pattern_description").get<std::string>())
          : Utilities::trim(meaning.substr(begin + mark.size()));
      return entry;
    }
  } // namespace



  Catalogue
  make_catalogue(const ParameterHandler &prm)
  {
    std::stringstream stream;
    prm.print_parameters(stream,
                         ParameterHandler::JSON |
                           ParameterHandler::KeepDeclarationOrder);
    const Catalogue declared = Catalogue::parse(stream);
    Catalogue       catalogue;
    for (const auto &[name, entry] : declared.items())
      if (entry.contains("default_value"))
        catalogue[""][name] = describe(entry);
      else
        for (const auto &[parameter, inner] : entry.items())
          catalogue[name][parameter] = describe(inner);
    return catalogue;
  }



  std::vector<std::string>
  names_in(const Catalogue &object)
  {
    std::vector<std::string> names;
    for (const auto &[name, entry] : object.items())
      if (!name.empty())
        names.push_back(name);
    return names;
  }



  namespace
  {
    /** JSON types of a value that a pattern of deal.II or NumberPattern
     * describes. A number may also be the text that deal.II prints. */
    Catalogue
    ways_to_write(const std::string &pattern)
    {
      const std::vector<std::string> parts = parts_of_pattern(pattern);
      const std::string             &kind  = parts[0];
      const auto text = Catalogue::object({{"type", "string"}});
      if (kind == "List")
        {
          const Catalogue item = ways_to_write(parts[1])[0];
          return Catalogue::array(
            {Catalogue::object({{"type", "array"}, {"items", item}}),
             item,
             text});
        }
      if (kind == "Integer" || kind == "Number")
        return Catalogue::array(
          {Catalogue::object(
             {{"type", kind == "Integer" ? "integer" : "number"},
              {"minimum", Catalogue::parse(parts[1])},
              {"maximum", Catalogue::parse(parts[2])}}),
           Catalogue::object(
             {{"type", "string"}, {"pattern", "^[-+.0-9eE]+$"}})});
      if (kind == "Selection")
        {
          Catalogue names = Text::split(parts[1], '|');
          if (std::count(names.begin(), names.end(), "true") > 0)
            names.insert(names.end(), {false, true});
          return Catalogue::array({Catalogue::object({{"enum", names}})});
        }
      if (kind == "[Bool]")
        return Catalogue::array({Catalogue::object(
          {{"enum", Catalogue::array({true, false, "true", "false"})}})});

      const auto any_number = Catalogue::object({{"type", "number"}});
      return Catalogue::array(
        {text,
         any_number,
         Catalogue::object({{"type", "array"}, {"items", any_number}})});
    }



    /** Default value that an editor inserts with the name: as a number or a
     * Boolean where it may be one. */
    Catalogue
    default_value(const Catalogue &ways, const std::string &text)
    {
      const bool is_text =
        ways[0].contains("type") && ways[0]["type"] == "string";
      const std::string json =
        ways[0].contains("items") ? "[" + text + "]" : text;
      return !is_text && Catalogue::accept(json) ? Catalogue::parse(json)
                                                 : Catalogue(text);
    }



    Catalogue
    make_parameter(const Catalogue &entry)
    {
      const Catalogue ways =
        ways_to_write(entry.at("pattern_description").get<std::string>());
      auto schema = Catalogue::object(
        {{"description",
          entry.at("documentation").get<std::string>() +
            " Allowed: " + entry.at("allowed").get<std::string>() + "."},
         {"default",
          default_value(ways, entry.at("default_value").get<std::string>())}});
      if (ways.size() == 1)
        schema.update(ways[0]);
      else
        schema["anyOf"] = ways;
      return schema;
    }
  } // namespace



  Catalogue
  make_scene_schema(const Catalogue &catalogue)
  {
    const auto make_object = []() {
      return Catalogue::object({{"type", "object"},
                                {"properties", Catalogue::object()},
                                {"additionalProperties", false}});
    };
    Catalogue schema  = make_object();
    schema["$schema"] = "http://json-schema.org/draft-07/schema#";
    schema["title"]   = "Scene of Crevasse " CREVASSE_VERSION;
    // A scene may name its schema by "$schema".
    schema["properties"]["$schema"] = {{"type", "string"}};
    for (const auto &[section, parameters] : catalogue.items())
      {
        Catalogue part = make_object();
        for (const auto &[name, entry] : parameters.items())
          part["properties"][name] = make_parameter(entry);
        if (section.empty())
          schema["properties"].update(part["properties"]);
        else
          schema["properties"][section] = part;
      }
    return schema;
  }
} // namespace Crevasse
