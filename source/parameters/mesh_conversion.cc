// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/checked_file.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/parameters/assignments.h>
#include <crevasse/parameters/mesh_conversion.h>
#include <crevasse/parameters/parameters.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>

namespace Crevasse
{
  namespace fs = std::filesystem;

  namespace
  {
    /** Text of a mesh file, and of the files that *INCLUDE names there. */
    std::string
    read_with_includes(const fs::path &path, const unsigned int depth = 0)
    {
      static const std::regex include(
        R"(\*\s*include\s*,\s*input\s*=\s*"?([^",]*[^",\s]).*)",
        std::regex::icase);
      constexpr unsigned int most = 5; // a file may include itself
      std::ifstream          file(path);
      std::string            text, line;
      std::smatch            parts;
      while (std::getline(file, line))
        {
          text += line + '\n';
          if (line[0] == '*' && depth < most &&
              std::regex_match(line, parts, include))
            text += read_with_includes(path.parent_path() / parts[1].str(),
                                       depth + 1);
        }
      return text;
    }
  } // namespace



  std::string
  find_file(const std::string &scene_file, const std::string &name)
  {
    const fs::path  file = fs::path(scene_file).parent_path() / name;
    std::error_code not_found;
    return !name.empty() && fs::exists(file, not_found)
             ? fs::absolute(file).lexically_normal().string()
             : name;
  }



  std::string
  converted_mesh(const std::string &mesh_file)
  {
    // deal.II reads .inp files of UCD, which do not begin with a star.
    static const std::set<std::string> suffixes = {".inp",
                                                   ".unv",
                                                   ".med",
                                                   ".e",
                                                   ".exo",
                                                   ".ex2",
                                                   ".vtk",
                                                   ".vtu",
                                                   ".geo",
                                                   ".brep"};
    const std::string                  suffix   = Text::suffix(mesh_file);
    std::ifstream                      file(mesh_file);
    char                               first = 0;
    if (suffixes.count(suffix) == 0 || !(file >> first) ||
        (suffix == ".inp" && first != '*'))
      return "";
    return Text::format("results/meshes/%s-%08x.msh",
                        fs::path(mesh_file).stem().c_str(),
                        checksum(read_with_includes(mesh_file)));
  }



  std::string
  mesh_file_of(const std::string              &scene_file,
               const std::vector<std::string> &overrides)
  {
    Problems                           ignored; // reported with the scene
    std::map<std::string, std::string> values;
    for (const Assignment &assignment :
         read_assignments(scene_file, overrides, ignored))
      if (assignment.section == GeometryParameters::section)
        values[assignment.name] = assignment.value;
    return values["Shape"] == name_of(Shape::mesh_file)
             ? find_file(scene_file, values["Mesh file"])
             : "";
  }
} // namespace Crevasse
