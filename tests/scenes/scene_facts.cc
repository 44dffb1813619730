// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// What deal.II's harness runs a scene with: it starts the program, and prints
// what must be the same everywhere from summary.json. Certificates are of the
// size of rounding, which the harness takes for zero: judged here.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

int
main(int, char **argv)
{
  const std::filesystem::path scene = argv[1];
  const std::string           command =
    "'" CREVASSE "' --quiet --force '" + scene.string() + "'";
  if (std::system(command.c_str()) != 0)
    return EXIT_FAILURE;

  std::ifstream file("results/" + scene.stem().string() + "/summary.json");
  const nlohmann::json summary     = nlohmann::json::parse(file);
  const nlohmann::json certificate = summary.at("certificate");

  for (const char *name : {"cells", "unknowns", "contact_nodes", "periods"})
    std::cout << name << ": " << summary.at(name) << '\n';
  std::cout << "contact solver: " << summary.at("contact_solver").at("name")
            << "\neffects:";
  for (const auto &[name, effect] : summary.at("effects").items())
    if (effect.at("on"))
      std::cout << ' ' << name << ';';
  std::cout << '\n' << std::setprecision(10);
  for (const auto &[name, size] : summary.at("extremes").items())
    std::cout << "largest " << name << ", scaled: "
              << size.get<double>() /
                   (name == "displacement" || name == "opening" ? 1e-3 : 10.)
              << '\n';
  for (const double change : summary.at("stress_change"))
    std::cout << "change of stress: " << change << '\n';

  bool accepted = true;
  for (const char *name :
       {"penetration", "tension", "complementarity", "residual"})
    accepted &= certificate.at(name) <= certificate.at("accuracy");
  std::cout << "certificate accepted: " << (accepted ? "yes" : "no")
            << "\naccuracy below 1e-11: "
            << (certificate.at("accuracy") < 1e-11 ? "yes" : "no") << std::endl;
  return accepted ? EXIT_SUCCESS : EXIT_FAILURE;
}
