// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/parameters/catalogue.h>
#include <crevasse/parameters/physical_names.h>

#include <fstream>
#include <iomanip>
#include <optional>
#include <regex>
#include <vector>

namespace Crevasse
{
  namespace
  {
    using Names = std::map<std::string, unsigned int>;



    /** The physical groups of one dimension that have a name. The section is
     * text in binary files too, and stands before the nodes. */
    Names
    read_names(const std::string &file_name, const unsigned int dim)
    {
      std::ifstream file(file_name);
      std::string   line;
      while (line != "$PhysicalNames" && line != "$Nodes" &&
             std::getline(file, line))
        line = Text::squeeze(line);
      Names        names;
      unsigned int n = 0, group_dim = 0, number = 0;
      if (line == "$PhysicalNames")
        file >> n;
      std::string name;
      for (unsigned int i = 0;
           i < n && file >> group_dim >> number >> std::quoted(name);
           ++i)
        if (group_dim == dim)
          names[Text::squeeze(name)] = number;
      return names;
    }



    bool
    has_gmsh_file(const Scene &scene)
    {
      return scene.geometry.shape == Shape::mesh_file &&
             Text::suffix(scene.geometry.mesh_file) == ".msh";
    }



    std::string
    describe_unknown(const std::string &beginning,
                     const std::string &name,
                     const Names       &names)
    {
      std::vector<std::string> known;
      for (const auto &[other, number] : names)
        known.push_back('"' + other + "\" (" + std::to_string(number) + ')');
      return beginning + " \"" + Text::shorten(name) + "\"; its names: " +
             (known.empty() ? "none" : Text::join(known, ", "));
    }
  } // namespace



  void
  replace_boundary_names(Scene &scene, Problems &problems)
  {
    if (!has_gmsh_file(scene))
      return;
    const Names names =
      read_names(scene.geometry.mesh_file, scene.dimension - 1);
    for (const BoundaryRole &role : boundary_role_table)
      {
        Parsed<BoundaryList> &list = scene.boundary.*role.list;
        if (!list.is_valid() || list->names.empty())
          continue;
        std::vector<std::string> ids;
        for (const auto id : list->ids)
          ids.push_back(std::to_string(id));
        for (const std::string &name : list->names)
          if (const auto group = names.find(name); group != names.end())
            ids.push_back(std::to_string(group->second));
          else
            problems.add(BoundaryParameters::section,
                         role.name,
                         describe_unknown("the mesh file has no boundary named",
                                          name,
                                          names));
        list = ids.empty() ? "none" : Text::join(ids, ", ");
      }
  }



  std::map<std::string, std::string>
  named_materials(const Scene                    &scene,
                  const dealii::ParameterHandler &prm,
                  Problems                       &problems)
  {
    const std::string section = MaterialParameters::section;
    const std::regex  quoted("\"([^\"]*)\"");
    const Catalogue   catalogue = make_catalogue(prm);
    const Names       names =
      has_gmsh_file(scene)
              ? read_names(scene.geometry.mesh_file, scene.dimension)
              : Names();

    std::map<std::string, std::string> replaced;
    for (const auto &[parameter, entry] : catalogue[section].items())
      {
        std::string text = prm.get({section}, parameter);
        for (std::smatch match; std::regex_search(text, match, quoted);)
          {
            const std::string name  = Text::squeeze(match[1]);
            const auto        group = names.find(name);
            std::string       id    = "0"; // for the rest of the formula
            if (group != names.end())
              id = std::to_string(group->second);
            else
              problems.add(
                section,
                parameter,
                has_gmsh_file(scene)
                  ? describe_unknown("the mesh file has no material named",
                                     name,
                                     names)
                  : "names of materials are those of physical groups "
                    "of a Gmsh file");
            text = match.prefix().str() + id + match.suffix().str();
            replaced[parameter] = text;
          }
      }
    return replaced;
  }
} // namespace Crevasse
