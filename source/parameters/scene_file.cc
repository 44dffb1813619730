// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text_file.h>
#include <crevasse/parameters/assignments.h>
#include <crevasse/parameters/boundary_names.h>
#include <crevasse/parameters/json_reader.h>
#include <crevasse/parameters/prm_reader.h>
#include <crevasse/parameters/scene_file.h>
#include <crevasse/temperature/temperature.h>

#include <filesystem>
#include <sstream>

namespace Crevasse
{
  namespace
  {
    std::vector<Assignment>
    read_assignments(const std::string &file_name, Problems &problems)
    {
      std::vector<Assignment> assignments;
      const std::string       extension =
        std::filesystem::path(file_name).extension().string();
      if (extension == ".prm")
        read_prm(file_name, assignments, problems);
      else if (extension == ".json")
        read_json(file_name, assignments, problems);
      else
        {
          // A file that is not there is the greater mistake.
          read_text_file(file_name);
          problems.add(file_name +
                       ": the name of a scene file must end in .prm or .json");
        }
      return assignments;
    }



    /** A file that lies next to the scene is found from any directory, and
     * also from where used.prm will lie. */
    void
    resolve_file(const std::string        &scene_file_name,
                 const char               *section,
                 const char               *name,
                 const std::string        &value,
                 dealii::ParameterHandler &prm)
    {
      namespace fs = std::filesystem;

      if (value.empty())
        return;
      const fs::path  file = fs::path(scene_file_name).parent_path() / value;
      std::error_code not_found;
      if (!fs::exists(file, not_found))
        return;

      prm.enter_subsection(section);
      prm.set(name, fs::absolute(file).lexically_normal().string());
      prm.leave_subsection();
    }
  } // namespace



  Scene
  read_scene(const std::string              &file_name,
             const std::vector<std::string> &overrides,
             dealii::ParameterHandler       &prm,
             Problems                       &problems)
  {
    Scene scene;
    scene.add_parameters(prm);

    std::vector<Assignment> assignments = read_assignments(file_name, problems);
    for (const std::string &text : overrides)
      read_override(text, assignments, problems);
    apply(assignments, prm, problems);

    resolve_file(file_name,
                 GeometryParameters::section,
                 "Mesh file",
                 scene.geometry.mesh_file,
                 prm);
    if (Temperature<2>::is_file(scene.loads.temperature.text()))
      resolve_file(file_name,
                   LoadParameters::section,
                   "Temperature",
                   scene.loads.temperature.text(),
                   prm);
    replace_boundary_names(scene, problems);
    return scene;
  }



  std::string
  used_parameters(dealii::ParameterHandler &prm)
  {
    std::ostringstream text;
    prm.print_parameters(text, dealii::ParameterHandler::PRM);
    return text.str();
  }
} // namespace Crevasse
