// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
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



  std::vector<std::string>
  parts_of_pattern(const std::string &description)
  {
    static const std::regex forms[] = {
      std::regex("\\[(List) of <(.*)> of.*"),
      std::regex("\\[(Integer|Number) range (.*)\\.\\.\\.(\\S+) \\((.*)\\)\\]"),
      std::regex("\\[(Selection) (.*?) ?\\]")};
    for (const std::regex &form : forms)
      if (std::smatch parts; std::regex_match(description, parts, form))
        return {std::next(parts.begin()), parts.end()};
    return {description};
  }



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
} // namespace Crevasse
