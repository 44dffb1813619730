// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/output/output_directory.h>
#include <crevasse/scene/problems.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <system_error>

namespace Crevasse
{
  void
  require_writable_directory(const std::string &directory)
  {
    namespace fs = std::filesystem;
    std::error_code error;
    fs::create_directories(directory, error);
    if (error)
      throw FileError("[Output directory] " + directory +
                      ": cannot be created (" + error.message() +
                      "). Choose another one by --output DIR.");

    const fs::path probe    = fs::path(directory) / ".write_test";
    const bool     writable = std::ofstream(probe).put('\n').good();
    fs::remove(probe, error);
    if (!writable)
      throw FileError("[Output directory] " + directory +
                      ": cannot be written to. Choose another one by --output "
                      "DIR.");
  }



  void
  remove_earlier_results(const std::string &directory)
  {
    namespace fs = std::filesystem;
    static const std::regex ours(
      "summary\\.json|used\\.prm|log\\.txt|solution\\.pvd|"
      "solution_[0-9.]+\\.p?vtu|(probe_.*|contact|periods|relaxation)\\.csv");
    for (const fs::directory_entry &entry : fs::directory_iterator(directory))
      if (std::regex_match(entry.path().filename().string(), ours))
        fs::remove(entry.path());
  }
} // namespace Crevasse
