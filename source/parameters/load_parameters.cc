// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/range.h>
#include <crevasse/base/text.h>
#include <crevasse/parameters/checker.h>
#include <crevasse/parameters/load_parameters.h>

namespace Crevasse
{
  namespace
  {
    /** Splits at single bars: in formulas "||" means "or". */
    std::vector<std::string>
    split_at_bars(const std::string &text)
    {
      std::vector<std::string> parts(1);
      for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] != '|')
          parts.back() += text[i];
        else if (text.compare(i, 2, "||") == 0)
          parts.back() += text[i++], parts.back() += text[i];
        else
          parts.emplace_back();
      return parts;
    }



    PlacedFormulas
    parse_placed(const std::string      &text,
                 const Formulas::Parser &parse,
                 const bool              must_be_named)
    {
      // In formulas a colon follows a question mark.
      const std::size_t colon    = text.find(':');
      const bool        is_named = colon < text.find('?');
      if (must_be_named && !is_named)
        throw SceneError("\"" + Text::shorten(Text::squeeze(text)) +
                         "\" must begin with its boundaries and a colon, as in "
                         "top: 0; 10 | bottom: 0; -10");
      PlacedFormulas placed;
      placed.boundaries =
        parse_boundary_list(is_named ? text.substr(0, colon) : "automatic");
      placed.components = parse(is_named ? text.substr(colon + 1) : text);
      return placed;
    }
  } // namespace



  LoadFormulas::Parser
  on_boundaries(const Formulas::Parser &parse)
  {
    return [parse](const std::string &text) {
      std::vector<PlacedFormulas> all;
      if (Text::squeeze(text).empty())
        return all;
      const std::vector<std::string> parts = split_at_bars(text);
      for (const std::string &part : parts)
        all.push_back(parse_placed(part, parse, parts.size() > 1));
      return all;
    };
  }



  LoadFormulas::Parser
  in_volume(const Formulas::Parser &parse)
  {
    return [parse](const std::string &text) {
      if (Text::squeeze(text).empty())
        return std::vector<PlacedFormulas>();
      return std::vector<PlacedFormulas>{
        {parse_boundary_list("automatic"), parse(text)}};
    };
  }



  void
  LoadParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    const std::string allowed =
      "; empty: none. Allowed: one formula of x, y, z, t for each dimension, "
      "separated by semicolons";
    const std::string by_boundary = "; or such values by boundary, as in top: ";
    prm.add_parameter(
      "Period",
      period,
      "Period of loads and material, in units of time. In all formulas t is "
      "the time since the beginning of the period.",
      NumberPattern(Ranges::positive));
    traction.add_parameter(
      "Traction",
      "Force per area on boundaries with the role Loaded, in units of stress" +
        allowed + by_boundary + "0; 10*t | bottom: 0; -10*t",
      prm);
    pressure.add_parameter(
      "Pressure",
      "Pressure on boundaries with the role Loaded, which acts along the "
      "normal "
      "into the body, in units of stress; empty: none. Allowed: a formula of "
      "x, y, z, t" +
        by_boundary + "10 | lip: 2*t",
      prm);
    temperature.add_parameter(
      "Temperature",
      "Difference theta from the temperature without thermal strain, or with "
      "Reference temperature the absolute temperature, in units of "
      "temperature. It strains the body by Thermal expansion, and formulas "
      "of the material may depend on it. Allowed: a formula of x, y, z, t; or "
      "an .h5 file that \"crevasse temperature\" makes from a table or from "
      "the fields of another program",
      prm);
    reference.add_parameter(
      "Reference temperature",
      "Temperature without thermal strain. If it is set, Temperature and theta "
      "are absolute. Empty: they are the change from it. Allowed: a number, or "
      "empty",
      prm);
    body_force.add_parameter("Body force",
                             "Force per volume, in units of stress / length" +
                               allowed,
                             prm);
  }



  std::vector<Expression>
  LoadParameters::Force::formulas() const
  {
    std::vector<Expression> all;
    for (const PlacedFormulas &placed : *values)
      all.insert(all.end(), placed.components.begin(), placed.components.end());
    return all;
  }



  std::vector<LoadParameters::Force>
  LoadParameters::forces() const
  {
    return {
      {"Traction", "traction", traction, false, false},
      {"Pressure", "pressure", pressure, false, true},
      {"Body force", "body force", body_force, true, false},
    };
  }



  void
  LoadParameters::check_dimension(const unsigned int dimension,
                                  Problems          &problems) const
  {
    for (const Force &force : forces())
      if (force.values.is_valid())
        for (const PlacedFormulas &placed : *force.values)
          Checker(section, problems)
            .demand(placed.components.size() ==
                      (force.along_normal ? 1 : dimension),
                    force.parameter,
                    force.along_normal
                      ? "must be one formula, or empty"
                      : "must be " + std::to_string(dimension) +
                          " formulas, one for each dimension, separated by "
                          "semicolons, or empty");
  }



  void
  LoadParameters::check_boundaries(const BoundaryRoles &roles,
                                   Problems            &problems) const
  {
    const Checker checker(section, problems);
    for (const Force &force : forces())
      {
        std::set<dealii::types::boundary_id> seen;
        for (const PlacedFormulas &placed : force.values.is_valid()
                                              ? *force.values
                                              : std::vector<PlacedFormulas>())
          {
            checker.demand(placed.boundaries.names.empty(),
                           force.parameter,
                           "names of boundaries need a mesh file with named "
                           "groups; otherwise these must be boundary ids, as "
                           "in 3: 0; 10 | 4: 0; -10");
            for (const auto id : placed.boundaries.ids)
              {
                const std::string name =
                  "the boundary id " + std::to_string(id);
                checker.demand(roles.loaded.count(id) > 0,
                               force.parameter,
                               name +
                                 " must have the role Loaded ([Boundary] "
                                 "Loaded)");
                checker.demand(seen.insert(id).second,
                               force.parameter,
                               name + " must have one value only");
              }
          }
      }
  }
} // namespace Crevasse
