// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text_file.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace Crevasse
{
  std::string
  why_unreadable(const std::string &file_name)
  {
    // An error of is_directory() recurs when the file is opened below.
    std::error_code ignored;
    if (std::filesystem::is_directory(file_name, ignored))
      return "cannot be read: it is a directory";

    errno = 0;
    std::ifstream file(file_name, std::ios::binary);
    if (file)
      file.peek();
    return file.is_open() && !file.bad()
             ? ""
             : std::string("cannot be read: ") +
                 (errno == 0 ? "unknown reason" : std::strerror(errno));
  }



  std::string
  read_text_file(const std::string &file_name)
  {
    std::string        why = why_unreadable(file_name);
    std::ifstream      file(file_name, std::ios::binary);
    std::ostringstream text;
    // Copying nothing would set the failbit of the copy's target.
    if (file.peek() != std::ifstream::traits_type::eof())
      text << file.rdbuf();
    if (why.empty() && (file.bad() || !text))
      why = "cannot be read to its end";
    if (!why.empty())
      throw FileError("The file \"" + file_name + "\" " + why + ".");

    const std::string byte_order_mark = "\xEF\xBB\xBF";
    const std::string result          = text.str();
    return result.compare(0, 3, byte_order_mark) == 0 ? result.substr(3)
                                                      : result;
  }



  void
  write_atomically(const std::string &text, const std::string &file_name)
  {
    const std::string part = file_name + ".part";
    std::ofstream     file(part, std::ios::binary);
    file << text;
    file.close();
    if (!file || std::rename(part.c_str(), file_name.c_str()) != 0)
      throw FileError("Cannot write " + file_name + ": is the disk full?");
  }
} // namespace Crevasse
