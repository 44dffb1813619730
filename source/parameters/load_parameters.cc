// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/range.h>
#include <crevasse/base/text.h>
#include <crevasse/parameters/load_parameters.h>

#include <functional>

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
          {
            parts.back() += "||";
            ++i;
          }
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



    /** @param add Adds what else @p parse found in the text before. */
    std::vector<PlacedFormulas>
    parse_by_boundary(
      const std::string                           &text,
      const Formulas::Parser                      &parse,
      const std::function<void(PlacedFormulas &)> &add = [](auto &) {})
    {
      std::vector<PlacedFormulas> all;
      if (Text::squeeze(text).empty())
        return all;
      const std::vector<std::string> parts = split_at_bars(text);
      for (const std::string &part : parts)
        {
          all.push_back(parse_placed(part, parse, parts.size() > 1));
          add(all.back());
        }
      return all;
    }
  } // namespace



  LoadFormulas::Parser
  on_boundaries(const Formulas::Parser &parse)
  {
    return [parse](const std::string &text) {
      return parse_by_boundary(text, parse);
    };
  }



  LoadFormulas::Parser
  displacements(const std::string &name,
                const std::string &variables,
                const Tables      &tables)
  {
    return [name = "[Loads] " + name, variables, tables](
             const std::string &text) -> std::vector<PlacedFormulas> {
      std::set<unsigned int> free;
      const auto             parse = [&](const std::string &components) {
        std::vector<std::string> values = Text::split(components, ';');
        free.clear();
        for (unsigned int d = 0; d < values.size(); ++d)
          if (values[d] == "free")
            {
              free.insert(d);
              values[d] = "0";
            }
        return Expression::parse_list(
          Text::join(values, ";"), ';', variables, name, tables);
      };
      return parse_by_boundary(text, parse, [&](PlacedFormulas &placed) {
        placed.free = free;
      });
    };
  }



  LoadFormulas::Parser
  in_volume(const Formulas::Parser &parse)
  {
    return [parse](const std::string &text) {
      if (Text::squeeze(text).empty())
        return std::vector<PlacedFormulas>();
      return std::vector<PlacedFormulas>{
        {parse_boundary_list("automatic"), parse(text), {}}};
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
    displacement.add_parameter(
      "Displacement",
      "Displacement of boundaries with the role Displaced, in units of length; "
      "a component that is \"free\" is not imposed, and has no traction" +
        allowed + by_boundary + "free; 0.01*sin(t) | 2: 0; 0",
      prm);
    displacement_rate.add_parameter(
      "Displacement rate",
      "Steady part of the velocity of boundaries with the role Displaced, in "
      "units of length / time, which enters the secular problem: the "
      "displacement grows by it from period to period; empty: none. Allowed: "
      "one formula of x, y, z for each dimension, separated by semicolons" +
        by_boundary + "0; 1e-5",
      prm);
  }



  std::vector<Expression>
  formulas_of(const LoadFormulas &values)
  {
    std::vector<Expression> all;
    for (const PlacedFormulas &placed : *values)
      all.insert(all.end(), placed.components.begin(), placed.components.end());
    return all;
  }



  std::array<LoadParameters::Force, 3>
  LoadParameters::forces() const
  {
    return {{
      {"Traction", "traction", traction, false, false},
      {"Pressure", "pressure", pressure, false, true},
      {"Body force", "body force", body_force, true, false},
    }};
  }



  void
  LoadParameters::check_dimension(const unsigned int dimension,
                                  Problems          &problems) const
  {
    const auto check = [&](const char         *parameter,
                           const LoadFormulas &values,
                           const bool          has_one) {
      if (values.is_valid())
        for (const PlacedFormulas &placed : *values)
          Checker(section, problems)
            .demand(placed.components.size() == (has_one ? 1 : dimension),
                    parameter,
                    has_one ? "must be one formula, or empty"
                            : "must be " + std::to_string(dimension) +
                                " formulas, one for each dimension, separated "
                                "by semicolons, or empty");
    };
    for (const LoadOnBoundaries &load : loads_on_boundaries)
      check(load.parameter, this->*load.values, load.has_one_component);
    check("Body force", body_force, false);
  }



  void
  check_boundaries(const Checker                              &checker,
                   const char                                 *parameter,
                   const LoadFormulas                         &values,
                   const std::string                          &role,
                   const std::set<dealii::types::boundary_id> &allowed)
  {
    std::set<dealii::types::boundary_id> seen;
    if (!values.is_valid())
      return;
    for (const PlacedFormulas &placed : *values)
      {
        checker.demand(placed.boundaries.names.empty(),
                       parameter,
                       "names of boundaries need a mesh file with named "
                       "groups; otherwise these must be boundary ids, as in "
                       "3: first value | 4: second value");
        for (const auto id : placed.boundaries.ids)
          {
            const std::string name = "the boundary id " + std::to_string(id);
            checker.demand(allowed.count(id) > 0,
                           parameter,
                           name + " must have the role " + role +
                             " ([Boundary] " + role + ")");
            checker.demand(seen.insert(id).second,
                           parameter,
                           name + " must have one value only");
          }
      }
  }



  void
  LoadParameters::check_boundaries(const BoundaryRoles &roles,
                                   Problems            &problems) const
  {
    const Checker checker(section, problems);
    for (const LoadOnBoundaries &load : loads_on_boundaries)
      Crevasse::check_boundaries(checker,
                                 load.parameter,
                                 this->*load.values,
                                 load.role,
                                 roles.*load.ids);
    if (displacement.is_valid() && displacement_rate.is_valid())
      check_displaced(roles, problems);
  }



  void
  LoadParameters::check_displaced(const BoundaryRoles &roles,
                                  Problems            &problems) const
  {
    const Checker checker(section, problems);
    checker.demand((displacement->empty() && displacement_rate->empty()) ||
                     !roles.displaced.empty(),
                   displacement->empty() ? "Displacement rate" : "Displacement",
                   "no boundary has the role Displaced; set [Boundary] "
                   "Displaced");
    for (const auto id : roles.displaced)
      {
        const std::string name = "the boundary id " + std::to_string(id);
        const PlacedFormulas *const value = placed_on(id, displacement);
        const PlacedFormulas *const rate  = placed_on(id, displacement_rate);
        checker.demand(value != nullptr,
                       "Displacement",
                       "must have a value for " + name +
                         ", whose role is Displaced");
        if (value == nullptr || rate == nullptr)
          continue;
        for (const unsigned int d : value->free)
          checker.demand(d >= rate->components.size() ||
                           rate->components[d].is_zero(),
                         "Displacement rate",
                         "must be free for component " + std::to_string(d + 1) +
                           " of " + name + ", as Displacement is");
      }
  }



  const PlacedFormulas *
  placed_on(const dealii::types::boundary_id id, const LoadFormulas &values)
  {
    for (const PlacedFormulas &placed : *values)
      if (placed.act_on(id))
        return &placed;
    return nullptr;
  }
} // namespace Crevasse
