// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/time/arkode_table.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <arkode/arkode_butcher_dirk.h>
#include <arkode/arkode_butcher_erk.h>
#include <array>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>
#include <vector>

namespace Crevasse
{
  namespace
  {
    struct Choice
    {
      const char *name;
      int         id;
      double      excess; ///< of estimates, measured (doc/time_schemes.md)
    };

    /** By order, from 2 on. */
    constexpr std::array<Choice, 4> explicit_choices = {
      {{"Heun-Euler 2(1)", ARKODE_HEUN_EULER_2_1_2, 5.},
       {"Bogacki-Shampine 3(2)", ARKODE_BOGACKI_SHAMPINE_4_2_3, 4.},
       {"Zonneveld 4(3)", ARKODE_ZONNEVELD_5_3_4, 20.},
       {"Dormand-Prince 5(4)", ARKODE_DORMAND_PRINCE_7_4_5, 1.}}};

    /** By order, from 3 on. */
    constexpr std::array<Choice, 3> implicit_choices = {
      {{"ESDIRK3(2)5L[2]SA", ARKODE_ESDIRK325L2SA_5_2_3, 1.},
       {"ARK4(3)6L[2]SA-ESDIRK", ARKODE_ARK436L2SA_DIRK_6_3_4, 1.},
       {"ESDIRK5(4)7L[2]SA2", ARKODE_ESDIRK547L2SA2_7_4_5, 1.}}};



    /** The method of Sdirk2. The weights of the embedded one differ by ±γ²:
     * what it makes of a stiff component is −(1−γ) of it, so that the estimate
     * stays bounded. */
    ARKodeButcherTable
    make_sdirk2()
    {
      constexpr double      gamma = 1. - dealii::numbers::SQRT1_2;
      constexpr double      shift = gamma * gamma;
      std::array<double, 2> c     = {{gamma, 1.}};
      std::array<double, 4> a     = {{gamma, 0., 1. - gamma, gamma}};
      std::array<double, 2> b     = {{1. - gamma, gamma}};
      std::array<double, 2> d     = {{1. - gamma + shift, gamma - shift}};
      return ARKodeButcherTable_Create(
        2, 2, 1, c.data(), a.data(), b.data(), d.data());
    }
  } // namespace



  ArkodeTable::ArkodeTable(const bool is_implicit, const unsigned int order)
    : is_implicit(is_implicit)
    , coefficients(nullptr, &ARKodeButcherTable_Free)
  {
    AssertIndexRange(order - 2, 4);
    if (!is_implicit)
      {
        const Choice &choice = explicit_choices[order - 2];
        table_name           = choice.name;
        excess               = choice.excess;
        coefficients.reset(ARKodeButcherTable_LoadERK(
          static_cast<ARKODE_ERKTableID>(choice.id)));
      }
    else if (order == 2)
      {
        table_name = "SDIRK2(1)";
        excess     = 10.;
        coefficients.reset(make_sdirk2());
      }
    else
      {
        const Choice &choice = implicit_choices[order - 3];
        table_name           = choice.name;
        excess               = choice.excess;
        coefficients.reset(ARKodeButcherTable_LoadDIRK(
          static_cast<ARKODE_DIRKTableID>(choice.id)));
      }
    AssertThrow(coefficients != nullptr, dealii::ExcOutOfMemory(0));
  }



  const std::string &
  ArkodeTable::name() const
  {
    return table_name;
  }



  ARKodeButcherTable
  ArkodeTable::table() const
  {
    return coefficients.get();
  }



  double
  ArkodeTable::excess_of_estimate() const
  {
    return excess;
  }



  double
  ArkodeTable::stability_function(const double z) const
  {
    const ARKodeButcherTableMem &table = *coefficients;
    std::vector<double>          stage(table.stages);
    double                       result = 1.;
    for (int i = 0; i < table.stages; ++i)
      {
        double sum = 1.;
        for (int j = 0; j < i; ++j)
          sum += table.A[i][j] * stage[j];
        stage[i] = z * sum;
        result += table.b[i] * stage[i];
      }
    return result;
  }



  double
  ArkodeTable::stability_limit() const
  {
    if (is_implicit)
      return std::numeric_limits<double>::infinity();
    const auto excess = [this](const double z) {
      return std::abs(stability_function(-z)) - 1.;
    };
    // R is a polynomial of a low degree: it does not leave and come back
    // within less than this.
    constexpr double search = 0.0123, rounding = 1e-12;
    double           z = search;
    while (excess(z + search) <= rounding)
      z += search;
    const auto bracket = boost::math::tools::bisect(
      excess, z, z + search, boost::math::tools::eps_tolerance<double>(48));
    return bracket.first;
  }



  TimeQuadrature
  ArkodeTable::quadrature() const
  {
    const ARKodeButcherTableMem &table = *coefficients;
    return {{table.c, table.c + table.stages},
            {table.b, table.b + table.stages}};
  }
} // namespace Crevasse
