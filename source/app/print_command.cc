// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/app/print_command.h>
#include <crevasse/app/run_command.h>
#include <crevasse/base/expression.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/checkpoint/scene_difference.h>
#include <crevasse/parameters/scene_file.h>

#include <cstdlib>
#include <iostream>

namespace Crevasse
{
  namespace
  {
    /** Prints the parameters of the scene, or else the defaults. */
    void
    print_parameters_of(const Command &command)
    {
      std::ostringstream text;
      if (command.scene_file.empty())
        print_parameters(text, command.print_format);
      else if (command.print_format != "prm" && command.print_format != "json")
        throw SceneError("--print-parameters " + command.print_format +
                         " describes all parameters; for the values of a scene "
                         "use prm or json.");
      else
        {
          dealii::ParameterHandler prm;
          const Scene              scene = read_scene(command, prm);
          Summary                  json  = scene_as_json(prm);
          json.erase(checksums_of_files);
          text << (command.print_format == "prm" ? used_parameters(prm)
                                                 : json.dump(2) + '\n');
        }
      std::cout << text.str() << std::flush;
      if (!std::cout)
        throw FileError("Cannot write to the standard output.");
    }
  } // namespace



  int
  show_parameters(const Command &command)
  {
    const char *rank = std::getenv("OMPI_COMM_WORLD_RANK");
    if (rank != nullptr && std::string(rank) != "0")
      return done;
    try
      {
        print_parameters_of(command);
        return done;
      }
    catch (const std::exception &error)
      {
        std::cerr << "crevasse: " << error.what() << std::endl;
        return exit_status_of(error);
      }
  }



  int
  evaluate(const std::vector<std::string> &words)
  {
    try
      {
        const Expression formula(words.at(3),
                                 Expression::Variables::space_and_time,
                                 words[2]);
        if (formula.depends_on_space())
          throw SceneError("a formula may depend on t, but not on x, y, z");
        for (std::size_t i = 4; i < words.size(); ++i)
          std::cout << Text::from_number(
                         formula.value(dealii::Point<2>(), std::stod(words[i])))
                    << '\n';
        return done;
      }
    catch (const std::exception &error) // also if T is no number
      {
        std::cerr << error.what() << std::endl;
        return bad_input;
      }
  }
} // namespace Crevasse
