// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/checked_file.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/base/text_file.h>
#include <crevasse/checkpoint/scene_difference.h>

#include <cstdlib>
#include <filesystem>
#include <regex>
#include <sstream>

namespace Crevasse
{
  namespace
  {
    /** Whether a resumed run may have another value of this parameter. */
    bool
    may_differ(const std::string &pointer)
    {
      static const std::set<std::string> names = {
        "/Title",
        "/Output directory",
        "/Output/Checkpoint every",
        "/Output/Error bars",
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



    /** The text with all numbers and blanks written in the same way. */
    std::string
    normal_form(const std::string &text)
    {
      static const std::regex word(
        R"((\d+\.?\d*|\.\d+)([eE][-+]?\d+)?(?![\w.])|[\w.]+|\S)");
      const std::sregex_iterator words(text.begin(), text.end(), word);
      std::string                result;
      for (auto w = words; w != std::sregex_iterator(); ++w)
        result +=
          (w->length(1) > 0 ? Summary(std::atof(w->str().c_str())).dump()
                            : w->str()) +
          ' ';
      return result;
    }



    /** Converts "/Section/Name" to "[Section] Name", as users know it. */
    std::string
    describe(const std::string &pointer)
    {
      const auto slash = pointer.find('/', 1);
      return slash == std::string::npos ? pointer.substr(1)
                                        : '[' + pointer.substr(1, slash - 1) +
                                            "] " + pointer.substr(slash + 1);
    }



    /** Checksum of a file; 0 if unreadable: its reader reports that better. */
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
    Summary    scene = Summary::parse(text.str());
    const auto value = [&scene](const char *pointer) {
      const Summary::json_pointer place(pointer);
      return scene.contains(place) ? scene[place].get<std::string>() : "";
    };
    const auto add = [&scene](const std::string &what,
                              const std::string &name) {
      std::error_code not_there;
      if (name.empty() || !std::filesystem::is_regular_file(name, not_there))
        return;
      // Files of one name in different folders: a sum finds a change in each.
      Summary &sum = scene[checksums_of_files][what];
      sum = checksum_of(name) + (sum.is_null() ? 0 : sum.get<std::uint32_t>());
    };
    for (const char *pointer : {"/Geometry/Mesh file",
                                "/Loads/Temperature",
                                "/Crack tip/Growth table"})
      add(describe(pointer), value(pointer));
    for (const std::string &name : Text::split(value("/Tables/Files"), ','))
      add("[Tables] " + std::filesystem::path(name).filename().string(), name);
    return scene;
  }



  void
  require_same_scene(const Summary &before, const Summary &now)
  {
    const Summary old_values = before.flatten(), new_values = now.flatten();
    const auto value = [](const Summary &values, const std::string &pointer) {
      return values.contains(pointer) ? as_text(values[pointer]) : "";
    };
    Summary all = old_values;
    all.update(new_values);
    std::string differences;
    for (const auto &item : all.items())
      {
        const std::string was = value(old_values, item.key());
        const std::string is  = value(new_values, item.key());
        if (!may_differ(item.key()) && normal_form(was) != normal_form(is))
          differences += describe(item.key()) + ": was \"" + was + "\", is \"" +
                         is + "\"\n  ";
      }
    if (!differences.empty())
      throw SceneError(
        "--resume: the scene has changed since the run was started:\n  " +
        differences.substr(0, differences.size() - 2) +
        "Set these parameters back, or start again without --resume, in "
        "another output directory.");
  }
} // namespace Crevasse
