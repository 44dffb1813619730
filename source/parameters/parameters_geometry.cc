// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/parameters/checker.h>
#include <crevasse/parameters/parameters.h>

#include <cmath>
#include <tuple>

namespace Crevasse
{
  namespace
  {
    void
    check_crack_length(const GeometryParameters &geometry,
                       const Checker            &checker)
    {
      const auto &[width, length] =
        std::tie(geometry.width, geometry.crack_length);
      checker.demand(length < width,
                     "Crack length",
                     length,
                     "must be shorter than the plate: Width = " +
                       Text::from_number(width));
      // Beyond this the cells at the tip vanish in rounding.
      const double shortest = 1e-8 * width;
      checker.demand(length >= width ||
                       (length >= shortest && width - length >= shortest),
                     "Crack length",
                     length,
                     "crack and ligament must each be at least 1e-8 of "
                     "Width = " +
                       Text::from_number(width));
    }



    /** Blames Subdivisions only where they are too many by themselves. */
    void
    check_number_of_cells(const GeometryParameters &geometry,
                          const Checker            &checker)
    {
      constexpr double  most = 2e7;
      const std::string why  = "; more than 2e7 are refused";

      double                   n_cells = 1.;
      std::vector<std::string> factors;
      for (const unsigned int n : geometry.subdivisions)
        {
          n_cells *= n;
          factors.push_back(std::to_string(n));
        }
      const std::string subdivisions = Text::join(factors, ", ");
      checker.demand(n_cells <= most,
                     "Subdivisions",
                     subdivisions,
                     "makes " + Text::from_number(n_cells) + " cells" + why);

      const double n_refined =
        n_cells *
        std::pow(2., geometry.subdivisions.size() * geometry.refinements);
      checker.demand(n_cells > most || n_refined <= most,
                     "Refinements",
                     std::to_string(geometry.refinements),
                     "makes " + Text::from_number(n_refined) +
                       " cells of Subdivisions = " + subdivisions + why);
    }
  } // namespace



  void
  GeometryParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    checker.demand_positive("Width", width);
    checker.demand_positive("Height", height);
    checker.demand_positive("Thickness", thickness);
    const bool cracked = traits(shape).has_crack;
    if (cracked)
      {
        checker.demand_positive("Crack length", crack_length);
        if (!problems.concern(section, "Width"))
          check_crack_length(*this, checker);
      }

    for (const unsigned int n : subdivisions)
      checker.demand(n > 0, "Subdivisions", n, "must be at least 1");
    if (cracked && !subdivisions.empty())
      checker.demand(subdivisions[0] != 1,
                     "Subdivisions",
                     subdivisions[0],
                     "must be at least 2 along x, because the crack tip is a "
                     "vertex of the mesh");
    checker.demand(refinements <= 12,
                   "Refinements",
                   refinements,
                   "must be at most 12");

    if (shape != Shape::mesh_file && !problems.concern(section, "Refinements"))
      check_number_of_cells(*this, checker);

    if (shape == Shape::mesh_file)
      {
        if (mesh_file.empty())
          checker.demand(false,
                         "Mesh file",
                         mesh_file,
                         "must be given, for the shape is \"mesh file\"");
        else
          checker.demand_file("Mesh file", mesh_file);
      }
    else
      checker.demand(mesh_file.empty(),
                     "Mesh file",
                     mesh_file,
                     "is allowed only for the shape \"mesh file\"; the shape "
                     "is \"" +
                       name_of(shape) + "\"");
  }
} // namespace Crevasse
