// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/parameters/built_in_boundary.h>
#include <crevasse/parameters/physical_names.h>

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <regex>

namespace Crevasse
{
  namespace
  {
    using Names = std::map<std::string, unsigned int>;



    /** Names and ids of the physical groups of one dimension. Their section is
     * text in binary files, too, and precedes the nodes. */
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



    /** Whether a file is readable; if not, only that is reported. */
    bool
    is_readable(const std::string &file_name)
    {
      return std::ifstream(file_name).good();
    }



    /** Whether there is a Gmsh file, or a file that cannot be read, of which
     * nothing else is reported. */
    bool
    has_gmsh_file(const Scene &scene)
    {
      return scene.geometry.shape == Shape::mesh_file &&
             (Text::suffix(scene.geometry.file_to_read()) == ".msh" ||
              !is_readable(scene.geometry.mesh_file));
    }



    /** Names of the groups of one dimension in the Gmsh file, if it is one. */
    std::map<unsigned int, std::string>
    names_of_ids(const Scene &scene, const unsigned int dim)
    {
      std::map<unsigned int, std::string> of_ids;
      if (has_gmsh_file(scene))
        for (const auto &[name, id] :
             read_names(scene.geometry.file_to_read(), dim))
          of_ids[id] = name;
      return of_ids;
    }



    /** Whether the parts of a formula before and after a name compare it with
     * the material. */
    bool
    is_compared(const std::string &before, const std::string &after)
    {
      static const std::regex left("\\bmaterial\\s*[=!]=\\s*$"),
        right("^\\s*[=!]=\\s*material\\b");
      constexpr std::size_t enough = 40; // characters; regex is recursive
      const std::size_t begin = before.size() - std::min(before.size(), enough);
      return std::regex_search(before.substr(begin), left) ||
             std::regex_search(after.substr(0, enough), right);
    }



    std::string
    describe_unknown(const std::string &beginning,
                     const std::string &name,
                     const std::string &file_name,
                     const unsigned int dim)
    {
      constexpr const char *kinds[] = {"Point", "Curve", "Surface", "Volume"};
      for (unsigned int other = 0; other <= 3; ++other)
        if (other != dim && read_names(file_name, other).count(name) > 0)
          return beginning + " \"" + Text::shorten(name) + "\": it is a " +
                 kinds[other] + ", but with this Dimension it must be a " +
                 kinds[dim];
      std::vector<std::string> known;
      for (const auto &[other, number] : read_names(file_name, dim))
        known.push_back('"' + other + "\" (" + std::to_string(number) + ')');
      return beginning + " \"" + Text::shorten(name) + "\"; its names: " +
             (known.empty()
                ? std::string("none. In Gmsh, Physical ") + kinds[dim] + "(\"" +
                    Text::shorten(name) + "\", 1) = {1} gives one"
                : Text::join(known, ", "));
    }
  } // namespace



  void
  replace_boundary_names(Scene &scene, Problems &problems)
  {
    if (!has_gmsh_file(scene))
      return;
    const unsigned int dim   = scene.dimension - 1;
    const Names        names = read_names(scene.geometry.file_to_read(), dim);
    const auto         with_ids =
      [&](const char *section, const char *parameter, BoundaryList &list) {
        for (const std::string &name : std::exchange(list.names, {}))
          if (const auto group = names.find(name); group != names.end())
            list.ids.insert(group->second);
          else if (is_readable(scene.geometry.file_to_read()))
            problems.add(section,
                         parameter,
                         describe_unknown("the mesh file has no boundary named",
                                          name,
                                          scene.geometry.file_to_read(),
                                          dim));
      };
    for (const BoundaryRole &role : boundary_role_table)
      if (Parsed<BoundaryList> &list = scene.boundary.*role.list;
          list.is_valid())
        with_ids(BoundaryParameters::section, role.name, list.edit());
    const auto place =
      [&](const char *section, const char *parameter, LoadFormulas &values) {
        if (values.is_valid())
          for (PlacedFormulas &placed : values.edit())
            with_ids(section, parameter, placed.boundaries);
      };
    for (const LoadOnBoundaries &load : loads_on_boundaries)
      place(LoadParameters::section, load.parameter, scene.loads.*load.values);
    place(BoundaryParameters::section,
          "Friction coefficient",
          scene.boundary.friction);
  }



  std::map<unsigned int, std::string>
  material_names(const Scene &scene)
  {
    return names_of_ids(scene, scene.dimension);
  }



  std::map<unsigned int, std::string>
  boundary_names(const Scene &scene)
  {
    return scene.geometry.shape == Shape::mesh_file
             ? names_of_ids(scene, scene.dimension - 1)
             : built_in_names(scene.geometry, scene.dimension);
  }



  std::map<std::string, std::string>
  named_materials(const Scene                    &scene,
                  const Catalogue                &catalogue,
                  const dealii::ParameterHandler &prm,
                  Problems                       &problems)
  {
    const std::string section = MaterialParameters::section;
    const Names       names =
      has_gmsh_file(scene)
              ? read_names(scene.geometry.file_to_read(), scene.dimension)
              : Names();

    std::map<std::string, std::string> replaced;
    for (const auto &[parameter, entry] : catalogue[section].items())
      {
        std::string text = prm.get({section}, parameter);
        for (std::size_t begin; (begin = text.find('"')) != std::string::npos;)
          {
            const std::size_t end = text.find('"', begin + 1);
            if (end == std::string::npos)
              break; // muParser reports it
            const std::string name =
              Text::squeeze(text.substr(begin + 1, end - begin - 1));
            const std::string before = text.substr(0, begin),
                              after  = text.substr(end + 1);
            std::string id           = "0"; // to parse the rest
            if (!is_compared(before, after))
              problems.add(section,
                           parameter,
                           '"' + Text::shorten(name) +
                             "\" must be compared with the material, as in "
                             "material == \"blade\" || material == \"root\"");
            else if (!has_gmsh_file(scene))
              problems.add(section,
                           parameter,
                           "there is no material named \"" +
                             Text::shorten(name) +
                             "\": names are those of physical groups of a Gmsh "
                             "file; compare with material ids, as in "
                             "material == 1");
            else if (const auto group = names.find(name); group != names.end())
              id = std::to_string(group->second);
            else if (is_readable(scene.geometry.file_to_read()))
              problems.add(
                section,
                parameter,
                describe_unknown("the mesh file has no material named",
                                 name,
                                 scene.geometry.file_to_read(),
                                 scene.dimension));
            text                = before + id + after;
            replaced[parameter] = text;
          }
      }
    return replaced;
  }
} // namespace Crevasse
