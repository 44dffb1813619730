// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/parameters/scene.h>

#include <deal.II/base/patterns.h>

namespace Crevasse
{
  void
  Scene::add_parameters(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Title",
                      title,
                      "A line of text for figures and reports.");
    prm.add_parameter("Dimension",
                      dimension,
                      "Dimension of space. Allowed: 2 or 3",
                      dealii::Patterns::Integer(0));
    prm.add_parameter("Output directory",
                      output_directory,
                      "Where the results are written; nothing: results/ and "
                      "the name of the scene file. A relative path begins at "
                      "the working directory. Allowed: a path");

    const auto add = [&prm](auto &parameters) {
      prm.enter_subsection(parameters.section);
      parameters.add_parameters(prm);
      prm.leave_subsection();
    };
    add(geometry);
    add(boundary);
    add(material);
    add(loads);
    add(discretisation);
    add(refinement);
    add(contact);
    add(linear_solver);
    add(time_integration);
    add(periodic_state);
    add(crack_tip);
    add(output);
  }
} // namespace Crevasse
