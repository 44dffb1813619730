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
    /** deal.II's description of a pattern, such as "[Integer range 0...9
     * (inclusive)]", in words. */
    std::string
    in_words(const std::string &pattern)
    {
      std::smatch parts;
      if (std::regex_match(pattern,
                           parts,
                           std::regex("\\[List of <(.*)> of.*")))
        return "a list separated by commas, each " + in_words(parts[1]);
      if (std::regex_match(pattern,
                           parts,
                           std::regex(
                             "\\[Integer range (.*)\\.\\.\\.(\\d+) .*")))
        {
          const int least = std::stoi(parts[1]), most = std::stoi(parts[2]);
          if (most == std::numeric_limits<int>::max())
            return "an integer of at least " + parts[1].str();
          return most == least + 1 ? parts[1].str() + " or " + parts[2].str()
                                   : "an integer from " + parts[1].str() +
                                       " to " + parts[2].str();
        }
      if (std::regex_match(pattern,
                           parts,
                           std::regex("\\[Selection (.*?) ?\\]")))
        return (parts[1].str().find('|') == std::string::npos ? ""
                                                              : "one of: ") +
               Text::join(Text::split(parts[1], '|'), ", ");
      if (std::regex_match(pattern,
                           parts,
                           std::regex("\\[Number range \\S+ \\((.*)\\)\\]")))
        return "a number " + parts[1].str();
      return pattern == "[Bool]"       ? "true or false"
             : pattern == "[Anything]" ? "any text"
                                       : pattern;
    }



    /** What is allowed follows in the documentation where the pattern does not
     * tell it. */
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
} // namespace Crevasse
