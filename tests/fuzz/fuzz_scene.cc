// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Whatever stands in a scene file is refused with a message, or makes a scene
// that used.prm keeps: all that the program does before there is a mesh.

#include <crevasse/material/maxwell_law.h>
#include <crevasse/model/body.h>
#include <crevasse/parameters/scene_file.h>
#include <crevasse/temperature/temperature.h>

#include <cstdint>
#include <sstream>
#include <stdexcept>

#include "input_file.h"

using namespace Crevasse;

namespace
{
  using OutputStyle = dealii::ParameterHandler::OutputStyle;

  std::string
  print(const dealii::ParameterHandler &prm, const OutputStyle style)
  {
    std::ostringstream text;
    prm.print_parameters(text, style);
    return text.str();
  }



  /** What was printed says the same when it is read. */
  void
  read_again(const std::string &file_name, const std::string &used)
  {
    dealii::ParameterHandler prm;
    Problems                 problems;
    read_scene(file_name, {}, prm, problems).check(problems);
    if (!problems.empty() || used_parameters(prm) != used)
      throw std::logic_error(file_name + " is another scene");
  }



  template <int dim>
  void
  evaluate(const Scene &scene)
  {
    const Temperature<dim> temperature(*scene.loads.temperature,
                                       scene.loads.temperature.text(),
                                       scene.loads.period);
    const MaxwellLaw<dim>  law(scene.material);
    const Effects          effects(scene,
                          boundary_roles(scene),
                          temperature.depends_on_time());
    effects.list();
    describe_boundaries<dim>(scene);

    for (const double t : {0., 0.3 * scene.loads.period})
      {
        Place<dim> place;
        place.t           = t;
        place.point[0]    = t;
        place.temperature = temperature.value(place.point, t);
        law.stiffness.at(place);
        for (const auto &strain : law.free_strains)
          strain.value.at(place);
        for (const auto &branch : law.branches)
          branch.fluidity.at(place);
        scene.boundary.gap->value(place);
        for (const auto &force : scene.loads.forces())
          for (const Expression &component : force.formulas())
            component.value(place);
      }
  }



  void
  use_scene(const ScratchFolder &folder, const std::string &text)
  {
    const auto        first   = text.find_first_not_of(" \t\r\n");
    const bool        is_json = first != text.npos && text[first] == '{';
    const std::string file_name =
      folder.write(is_json ? "scene.json" : "scene.prm", text);

    dealii::ParameterHandler prm;
    Problems                 problems;
    const Scene              scene = read_scene(file_name, {}, prm, problems);
    scene.check(problems);
    problems.throw_if_any();

    // Elsewhere, as used.prm is.
    const std::string used = used_parameters(prm);
    read_again(folder.write("used/used.prm", used), used);
    read_again(folder.write("used/used.json",
                            print(prm, dealii::ParameterHandler::ShortJSON)),
               used);

    if (scene.dimension == 2)
      evaluate<2>(scene);
    else
      evaluate<3>(scene);
  }
} // namespace



extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  static const ScratchFolder folder;
  const std::string          text(data, data + size);
  allow_refusal([&text]() { use_scene(folder, text); });
  return 0;
}
