// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/checked_file.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/base/text_file.h>
#include <crevasse/checkpoint/scene_difference.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace Crevasse
{
  namespace
  {
    /** How far a run goes, how it solves, and what it is called. */
    bool
    may_differ(const std::string &pointer)
    {
      static const std::set<std::string> names = {
        "/Title",
        "/Output directory",
        "/Output/Checkpoint every",
        "/Periodic state/Maximum periods",
        "/Periodic state/Tolerance",
        "/Contact/Solver",
        "/Contact/Maximum iterations",
        "/Linear solver/Type",
        "/Linear solver/Tolerance",
        "/Linear solver/Memory for instants"};
      return names.count(pointer) > 0;
    }



    std::string
    as_text(const Summary &value)
    {
      return value.is_string() ? value.get<std::string>() : value.dump();
    }



    /** Whether two texts are the same number. */
    bool
    are_equal_numbers(const std::string &a, const std::string &b)
    {
      char        *end_of_a, *end_of_b;
      const double number_a = std::strtod(a.c_str(), &end_of_a);
      const double number_b = std::strtod(b.c_str(), &end_of_b);
      return !a.empty() && !b.empty() && *end_of_a == '\0' &&
             *end_of_b == '\0' && number_a == number_b;
    }



    /** "/Section/Name" as users know it. */
    std::string
    describe(const std::string &pointer)
    {
      const auto slash = pointer.find('/', 1);
      return slash == std::string::npos ? pointer.substr(1)
                                        : '[' + pointer.substr(1, slash - 1) +
                                            "] " + pointer.substr(slash + 1);
    }



    /** 0 if the file cannot be read, which its reader tells better. */
    std::uint32_t
    checksum_of(const std::string &name)
    {
      try
        {
          return checksum(read_text_file(name));
        }
      catch (const std::runtime_error &)
        {
          return 0;
        }
    }
  } // namespace



  Summary
  scene_as_json(const dealii::ParameterHandler &prm)
  {
    std::ostringstream text;
    prm.print_parameters(text, dealii::ParameterHandler::ShortJSON);
    Summary scene = Summary::parse(text.str());
    for (const char *pointer : {"/Geometry/Mesh file", "/Loads/Temperature"})
      {
        const Summary::json_pointer place(pointer);
        const std::string           name =
          scene.contains(place) ? scene[place].get<std::string>() : "";
        std::error_code not_there;
        if (!name.empty() && std::filesystem::is_regular_file(name, not_there))
          scene[checksums_of_files][describe(pointer)] = checksum_of(name);
      }
    return scene;
  }



  std::vector<std::string>
  differences_that_matter(const Summary &before, const Summary &now)
  {
    const Summary old_values = before.flatten(), new_values = now.flatten();
    std::vector<std::string> differences;
    const auto value = [](const Summary &values, const std::string &pointer) {
      return values.contains(pointer) ? as_text(values[pointer]) : "";
    };
    std::set<std::string> pointers;
    for (const Summary &values : {old_values, new_values})
      for (const auto &item : values.items())
        pointers.insert(item.key());
    for (const std::string &pointer : pointers)
      {
        const std::string was = value(old_values, pointer);
        const std::string is  = value(new_values, pointer);
        if (was != is && !are_equal_numbers(was, is) && !may_differ(pointer))
          differences.push_back(describe(pointer) + ": was \"" + was +
                                "\", is \"" + is + '"');
      }
    return differences;
  }



  void
  require_same_scene(const Summary &before, const Summary &now)
  {
    const std::vector<std::string> differences =
      differences_that_matter(before, now);
    if (!differences.empty())
      throw SceneError(
        "--resume: the scene is not the one that the run was begun with:\n  " +
        Text::join(differences, "\n  ") +
        "\nSet these back, or begin anew without --resume, in another output "
        "directory.");
  }
} // namespace Crevasse
