// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/base/version.h>
#include <crevasse/parameters/scene_schema.h>

namespace Crevasse
{
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
