// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text_file.h>
#include <crevasse/postprocess/output_directory.h>
#include <crevasse/study/sweep_folder.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

namespace Crevasse
{
  namespace fs = std::filesystem;

  namespace
  {
    constexpr const char *mark = "finished.json";



    /** Nothing if it cannot be read. */
    std::string
    content(const std::string &file_name)
    {
      std::error_code error;
      if (!fs::is_regular_file(file_name, error))
        return "";
      std::ifstream file(file_name, std::ios::binary);
      using Characters = std::istreambuf_iterator<char>;
      return std::string(Characters(file), Characters());
    }



    void
    remove(const std::string &file_name)
    {
      std::error_code error;
      fs::remove(file_name, error);
      if (error)
        throw FileError("Cannot remove " + file_name + ": " + error.message() +
                        '.');
    }
  } // namespace



  SweepFolder::SweepFolder(const std::string &path,
                           const std::string &used_parameters)
    : folder(path)
    , used(used_parameters)
  {
  }



  const std::string &
  SweepFolder::path() const
  {
    return folder;
  }



  std::string
  SweepFolder::file(const std::string &name) const
  {
    return folder + '/' + name;
  }



  std::optional<SweepResult>
  SweepFolder::finished() const
  {
    if (content(file("used.prm")) != used)
      return std::nullopt;
    try
      {
        const Summary json = Summary::parse(content(file(mark)));
        for (const auto &[name, size] : json.at("files").items())
          {
            std::error_code missing;
            if (fs::file_size(file(name), missing) !=
                  size.get<std::uintmax_t>() ||
                missing)
              return std::nullopt;
          }
        return SweepResult::from_json(json);
      }
    catch (const Summary::exception &)
      {
        return std::nullopt; // not there, or damaged
      }
  }



  void
  SweepFolder::prepare() const
  {
    require_writable_directory(folder);
    // Of the same scene, but not finished or damaged, or of another one.
    const bool is_other = content(file("used.prm")) != used;
    // First: from now on the folder is not finished.
    remove(file(mark));
    remove(file(stress_file));
    clear_earlier_results(folder,
                          is_other ? EarlierResults::are_kept
                                   : EarlierResults::are_removed);
    write_atomically(used, file("used.prm"));
  }



  Summary
  SweepFolder::summary() const
  {
    try
      {
        return Summary::parse(content(file("summary.json")));
      }
    catch (const Summary::exception &)
      {
        throw FileError("Cannot read " + file("summary.json") + '.');
      }
  }



  void
  SweepFolder::finish(const SweepResult &result) const
  {
    Summary json  = result.to_json();
    json["files"] = sizes();
    write_atomically(json.dump(2) + '\n', file(mark));
  }



  Summary
  SweepFolder::sizes() const
  {
    // What a run cannot do without. The stress is only needed to compare with
    // another reference, and its file knows its own size.
    std::map<std::string, std::uintmax_t> sizes;
    std::error_code                       error;
    for (const auto &entry : fs::directory_iterator(folder, error))
      {
        const std::string name  = entry.path().filename().string();
        const bool        table = entry.path().extension() == ".csv";
        if (table || name == "summary.json" || name == "used.prm")
          sizes[name] = fs::file_size(entry.path(), error);
      }
    return sizes;
  }
} // namespace Crevasse
