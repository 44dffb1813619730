// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/time/arkode_table.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <arkode/arkode_butcher_dirk.h>
#include <arkode/arkode_butcher_erk.h>
#include <array>
#include <limits>

namespace Crevasse
{
  namespace
  {
    constexpr double no_limit = std::numeric_limits<double>::infinity();

    struct Choice
    {
      const char *name;
      int         id;
      double      excess; ///< of estimates, measured (doc/time_schemes.md)
      double      limit;  ///< of stability
    };

    /** By order, from 2 on. */
    constexpr std::array<Choice, 4> explicit_choices = {
      {{"Heun-Euler 2(1)", ARKODE_HEUN_EULER_2_1_2, 5., 2.},
       {"Bogacki-Shampine 3(2)",
        ARKODE_BOGACKI_SHAMPINE_4_2_3,
        4.,
        2.512745326618329},
       {"Zonneveld 4(3)", ARKODE_ZONNEVELD_5_3_4, 20., 2.785293563405282},
       {"Dormand-Prince 5(4)",
        ARKODE_DORMAND_PRINCE_7_4_5,
        1.,
        3.306567892634947}}};

    /** The same; the first is none of ARKODE's. */
    constexpr std::array<Choice, 4> implicit_choices = {
      {{"SDIRK2(1)", ARKODE_DIRK_NONE, 10., no_limit},
       {"ESDIRK3(2)5L[2]SA", ARKODE_ESDIRK325L2SA_5_2_3, 1., no_limit},
       {"ARK4(3)6L[2]SA-ESDIRK", ARKODE_ARK436L2SA_DIRK_6_3_4, 1., no_limit},
       {"ESDIRK5(4)7L[2]SA2", ARKODE_ESDIRK547L2SA2_7_4_5, 1., no_limit}}};



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
    : coefficients(nullptr, &ARKodeButcherTable_Free)
  {
    AssertIndexRange(order - 2, 4);
    const Choice &choice =
      (is_implicit ? implicit_choices : explicit_choices)[order - 2];
    table_name = choice.name;
    excess     = choice.excess;
    limit      = choice.limit;
    coefficients.reset(
      !is_implicit
        ? ARKodeButcherTable_LoadERK(static_cast<ARKODE_ERKTableID>(choice.id))
      : order == 2 ? make_sdirk2()
                   : ARKodeButcherTable_LoadDIRK(
                       static_cast<ARKODE_DIRKTableID>(choice.id)));
    AssertThrow(coefficients != nullptr, dealii::ExcOutOfMemory(0));
  }



  TimeQuadrature
  ArkodeTable::quadrature() const
  {
    const ARKodeButcherTableMem &table = *coefficients;
    return {{table.c, table.c + table.stages},
            {table.b, table.b + table.stages}};
  }
} // namespace Crevasse
