// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/parameters/units.h>

#include <cmath>

namespace Crevasse
{
  namespace
  {
    using Known = std::vector<Units::Unit>;

    // Of K and °C only differences have a size: 1 of either is 1 K. Units of
    // one size are spellings.
    const Known lengths      = {{"m", 1.},
                                {"cm", 1e-2},
                                {"mm", 1e-3},
                                {"um", 1e-6},
                                {"µm", 1e-6},
                                {"in", 0.0254}};
    const Known stresses     = {{"Pa", 1.},
                                {"kPa", 1e3},
                                {"MPa", 1e6},
                                {"N/mm2", 1e6},
                                {"N/mm^2", 1e6},
                                {"GPa", 1e9},
                                {"kgf/mm2", 9.80665e6},
                                {"kgf/mm^2", 9.80665e6},
                                {"kg/mm2", 9.80665e6},
                                {"kg/mm^2", 9.80665e6},
                                {"psi", 6894.757},
                                {"ksi", 6894757.}};
    const Known times        = {{"s", 1.},
                                {"min", 60.},
                                {"h", 3600.},
                                {"d", 86400.},
                                {"a", 31557600.}};
    const Known temperatures = {{"K", 1.},
                                {"C", 1.},
                                {"degC", 1.},
                                {"°C", 1.},
                                {"F", 5. / 9.},
                                {"degF", 5. / 9.},
                                {"°F", 5. / 9.}};

    std::string
    names_of(const Known &known)
    {
      std::vector<std::string> names;
      for (const Units::Unit &unit : known)
        names.push_back(unit.name);
      return Text::join(names, ", ");
    }
  } // namespace



  Units::Units(const std::string &names, Problems *problems)
  {
    const std::vector<std::string> words = Text::split(names, ',');
    if (words.empty())
      return;
    const auto complain = [&](const std::string &what) {
      if (problems != nullptr)
        problems->add("", "Units", what);
    };
    if (words.size() != 4)
      {
        complain(
          "must be units of length, stress, time and temperature, as in "
          "mm, MPa, h, K");
        return;
      }
    const std::pair<const char *, const Known *> kinds[] = {
      {"length", &lengths},
      {"stress", &stresses},
      {"time", &times},
      {"temperature", &temperatures}};
    Unit *const mine[] = {&length, &stress, &time, &temperature};
    for (unsigned int i = 0; i < 4; ++i)
      {
        for (const Unit &unit : *kinds[i].second)
          if (unit.name == words[i])
            *mine[i] = unit;
        if (mine[i]->name.empty())
          complain("\"" + words[i] + "\" is no unit of " + kinds[i].first +
                   "; known are " + names_of(*kinds[i].second));
      }
  }



  double
  Units::intensity_in_MPa() const
  {
    return 1e-6 * stress.size * std::sqrt(length.size);
  }



  std::string
  Units::range_of_intensity(const double least, const double most) const
  {
    const std::string plain = Text::format("%.5g to %.5g", least, most);
    if (!are_known())
      return plain;
    const double factor = intensity_in_MPa();
    return plain + ' ' + stress.name + " sqrt(" + length.name + ")" +
           (std::abs(factor - 1.) < 1e-12
              ? ""
              : Text::format(" (%.4g to %.4g MPa sqrt(m))",
                             factor * least,
                             factor * most));
  }



  std::string
  Units::describe() const
  {
    return length.name + ", " + stress.name + ", " + time.name + ", " +
           temperature.name + "; K in " + stress.name + " sqrt(" + length.name +
           ")" +
           Text::format(", of which %.4g are 1 MPa sqrt(m)",
                        1. / intensity_in_MPa());
  }



  std::vector<std::string>
  Units::doubts(const double diameter,
                const double young_modulus,
                const double period) const
  {
    std::vector<std::string> all;
    const auto               doubt = [&all](const std::string &what,
                              const double       value,
                              const Unit        &unit,
                              const double       least,
                              const double       most) {
      const double in_SI = value * unit.size;
      if (in_SI > 0. && (in_SI < least || in_SI > most))
        all.push_back("Units: " + what + " " + Text::from_number(value, 3) +
                      ' ' + unit.name +
                      ". Is it in these units? Numbers are not converted.");
    };
    // From gels to diamond; from a grain to a mountain; to a geological age.
    if (are_known())
      {
        doubt("the Young modulus reaches", young_modulus, stress, 1e3, 5e12);
        doubt("the body has a diameter of", diameter, length, 1e-6, 1e4);
        doubt("the period is", period, time, 1e-6, 3e13);
      }
    return all;
  }
} // namespace Crevasse
