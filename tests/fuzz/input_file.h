// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_tests_fuzz_input_file_h
#define crevasse_tests_fuzz_input_file_h

#include <crevasse/base/problems.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <unistd.h>

/** A folder of this process alone, for what a fuzzer invents: the program reads
 * files. */
class ScratchFolder
{
public:
  ScratchFolder()
    : path(std::filesystem::temp_directory_path() /
           ("crevasse_fuzz_" + std::to_string(getpid())))
  {
    std::filesystem::create_directories(path);
  }

  ~ScratchFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }

  /** Returns the name of the file. */
  std::string
  write(const std::string &name, const std::string &text) const
  {
    const std::filesystem::path file = path / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file.string();
  }

private:
  const std::filesystem::path path;
};

/** Any other exception than those that users are meant to see ends the
 * fuzzer. */
inline void
allow_refusal(const std::function<void()> &f)
{
  try
    {
      f();
    }
  catch (const Crevasse::SceneError &)
    {
    }
  catch (const Crevasse::FileError &)
    {
    }
  catch (const Crevasse::NumericalError &)
    {
    }
}

#endif
