// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/parameters/boundary_names.h>

#include <fstream>
#include <iomanip>
#include <map>

namespace Crevasse
{
  namespace
  {
    using Names = std::map<std::string, unsigned int>;



    /** The physical groups of one dimension that have a name. The section is
     * text in binary files too, and stands before the nodes. */
    Names
    physical_names(const std::string &file_name, const unsigned int dim)
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



    std::string
    list(const Names &names)
    {
      std::vector<std::string> entries;
      for (const auto &[name, number] : names)
        entries.push_back('"' + name + "\" (" + std::to_string(number) + ')');
      return entries.empty() ? "none" : Text::join(entries, ", ");
    }
  } // namespace



  void
  replace_boundary_names(Scene &scene, Problems &problems)
  {
    if (scene.geometry.shape != Shape::mesh_file ||
        Text::suffix(scene.geometry.mesh_file) != ".msh")
      return;
    const Names names =
      physical_names(scene.geometry.mesh_file, scene.dimension - 1);

    BoundaryParameters                               &boundary = scene.boundary;
    const std::pair<const char *, std::string *const> roles[]  = {
       {"Clamped", &boundary.clamped},
       {"Symmetry", &boundary.symmetry},
       {"Loaded", &boundary.loaded},
       {"Contact", &boundary.contact}};
    for (const auto &[role, value] : roles)
      {
        std::vector<std::string> ids;
        for (const std::string &entry : Text::split(*value, ','))
          {
            const auto name = names.find(Text::squeeze(entry));
            if (Text::to_number(entry) || entry == "automatic" ||
                entry == "none")
              ids.push_back(entry);
            else if (name != names.end())
              ids.push_back(std::to_string(name->second));
            else
              problems.add(BoundaryParameters::section,
                           role,
                           *value,
                           "the mesh file has no boundary named \"" +
                             Text::shorten(entry) +
                             "\"; its names: " + list(names));
          }
        *value = ids.empty() ? "none" : Text::join(ids, ", ");
      }
  }
} // namespace Crevasse
