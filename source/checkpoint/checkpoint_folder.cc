// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text_file.h>
#include <crevasse/base/version.h>
#include <crevasse/checkpoint/checkpoint_folder.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <filesystem>
#include <unistd.h>

namespace Crevasse
{
  namespace fs = std::filesystem;

  namespace
  {
    /** Format of a checkpoint's files; other formats cannot be read. */
    constexpr int format_version = 20;

    constexpr const char *manifest_file = "/manifest.json";

    /** Reason why a checkpoint is not as it was written. */
    struct Damaged : std::runtime_error
    {
      using std::runtime_error::runtime_error;
    };



    /** @throw FileError if @p error is set; its message begins with @p what. */
    void
    throw_if(const std::error_code &error, const std::string &what)
    {
      if (error)
        throw FileError(what + " (" + error.message() + ").");
    }



    std::string
    now()
    {
      const std::time_t seconds = std::time(nullptr);
      char              text[40];
      std::strftime(text,
                    sizeof(text),
                    "%Y-%m-%d %H:%M:%S UTC",
                    std::gmtime(&seconds));
      return text;
    }



    Summary
    as_json(const CheckpointManifest &manifest)
    {
      return {{"format", format_version},
              {"version", CREVASSE_VERSION},
              {"written", now()},
              {"number", manifest.number},
              {"period", manifest.period},
              {"step", manifest.step},
              {"ranks", manifest.ranks},
              {"files", manifest.files},
              {"tables", manifest.tables},
              {"scene", manifest.scene}};
    }



    CheckpointManifest
    as_manifest(const Summary &json)
    {
      CheckpointManifest manifest;
      json.at("number").get_to(manifest.number);
      json.at("period").get_to(manifest.period);
      json.at("step").get_to(manifest.step);
      json.at("ranks").get_to(manifest.ranks);
      json.at("files").get_to(manifest.files);
      json.at("tables").get_to(manifest.tables);
      manifest.scene = json.at("scene");
      return manifest;
    }
  } // namespace



  std::size_t
  CheckpointManifest::bytes() const
  {
    std::size_t sum = 0;
    for (const auto &[name, check] : files)
      {
        (void)name;
        sum += check.first;
      }
    return sum;
  }



  CheckpointFolder::CheckpointFolder(const std::string &directory)
    : directory(directory)
    , path(directory + "/checkpoint")
  {
  }



  std::vector<unsigned int>
  CheckpointFolder::numbers() const
  {
    std::vector<unsigned int> found;
    std::error_code           error;
    for (fs::directory_iterator entry(path, error), end; !error && entry != end;
         entry.increment(error))
      {
        const std::string name = entry->path().filename().string();
        if (name.find_first_not_of("0123456789") == std::string::npos &&
            name.size() < 10)
          found.push_back(std::stoul(name));
      }
    if (error != std::errc::no_such_file_or_directory)
      throw_if(error, "Cannot look for checkpoints in " + path);
    std::sort(found.begin(), found.end());
    return found;
  }



  unsigned int
  CheckpointFolder::begin(const std::size_t bytes) const
  {
    const std::vector<unsigned int> there = numbers();
    const unsigned int number = there.empty() ? 1 : there.back() + 1;
    const std::string  folder = new_name(number);
    std::error_code    error;
    fs::remove_all(folder, error);
    fs::create_directories(folder, error);
    throw_if(error, "Cannot make " + folder);
    try
      {
        // p4est aborts the program if it cannot write.
        require_disk_space(folder + "/room", bytes);
      }
    catch (const FileError &)
      {
        abandon(number);
        throw;
      }
    return number;
  }



  void
  CheckpointFolder::finish(CheckpointManifest             &manifest,
                           const std::vector<std::string> &tables) const
  {
    const std::string folder = new_name(manifest.number);
    std::error_code   error;
    for (fs::directory_iterator file(folder, error), end; !error && file != end;
         file.increment(error))
      {
        const std::string name = file->path().string();
        write_through(name);
        const FileCheck check = check_file(name);
        if (check.first != file->file_size(error) && !error)
          throw FileError("Cannot read " + name + " back as a whole.");
        manifest.files[file->path().filename().string()] = check;
      }
    throw_if(error, "Cannot list " + folder);
    for (const std::string &table : tables)
      {
        // A table that somebody has removed is left out.
        const std::string name = directory + '/' + table;
        if (!fs::exists(name, error))
          continue;
        write_through(name);
        manifest.tables[table] = check_file(name);
      }
    const std::string content = as_json(manifest).dump(2);
    write_file(folder + manifest_file,
               std::to_string(checksum(content)) + '\n' + content);
    write_through(folder);

    fs::rename(folder, name(manifest.number), error);
    throw_if(error, "Cannot rename " + folder);
    write_through(path);
    write_through(directory);
    for (const unsigned int other : numbers())
      if (other + 1 < manifest.number)
        fs::remove_all(name(other), error); // leftovers are harmless
  }



  void
  CheckpointFolder::abandon(const unsigned int number) const
  {
    std::error_code error; // ignored: the first error is reported
    fs::remove_all(new_name(number), error);
  }



  CheckpointManifest
  CheckpointFolder::read(const unsigned int number) const
  {
    const auto require_there = [](const std::string &file) {
      std::error_code error; // an inaccessible file is not damaged
      if (!fs::exists(file, error) && !error)
        throw Damaged(file + " is missing");
    };
    const std::string file = name(number) + manifest_file;
    require_there(file);
    const std::string text    = read_text_file(file);
    const auto        newline = std::min(text.find('\n'), text.size());
    const std::string content = text.substr(std::min(newline + 1, text.size()));
    if (text.substr(0, newline) != std::to_string(checksum(content)))
      throw Damaged(file + " has another checksum");
    const Summary json = Summary::parse(content);
    if (json.at("format") != format_version)
      throw FileError("--resume: the checkpoint " + name(number) +
                      " was written by version " +
                      json.value("version", std::string("?")) +
                      " of the program, and version " CREVASSE_VERSION
                      " cannot read it. Resume with the former, or start again "
                      "in another output directory.");
    CheckpointManifest manifest = as_manifest(json);
    for (const auto &[part, expected] : manifest.files)
      {
        const std::string file = name(number) + '/' + part;
        require_there(file);
        const FileCheck found = check_file(file);
        if (found.first != expected.first)
          throw Damaged(file + " has " + std::to_string(found.first) +
                        " bytes instead of " + std::to_string(expected.first));
        if (found != expected)
          throw Damaged(file + " has another checksum");
      }
    return manifest;
  }



  std::optional<CheckpointManifest>
  CheckpointFolder::newest(std::vector<std::string> &warnings) const
  {
    const std::vector<unsigned int> all = numbers();
    for (auto number = all.rbegin(); number != all.rend(); ++number)
      try
        {
          return read(*number);
        }
      catch (const Damaged &fault)
        {
          warnings.push_back("checkpoint " + name(*number) +
                             " is damaged and not used: " + fault.what());
        }
    return {};
  }



  void
  CheckpointFolder::require_tables(const CheckpointManifest &manifest) const
  {
    constexpr const char *advice =
      " Restore it, or start again without --resume, in another output "
      "directory.";
    for (const auto &[table, expected] : manifest.tables)
      {
        const std::size_t size = expected.first;
        const std::string name = directory + '/' + table;
        std::error_code   error;
        const auto        there = fs::file_size(name, error);
        if (!error && there < size)
          throw FileError(name + " has lost rows since checkpoint " +
                          std::to_string(manifest.number) +
                          " was written: it has " + std::to_string(there) +
                          " bytes instead of " + std::to_string(size) + '.' +
                          advice);
        if (!error && access(name.c_str(), W_OK) != 0)
          error = std::error_code(errno, std::generic_category());
        if (error)
          throw FileError(name + " cannot be continued (" + error.message() +
                          ")." + advice);
        if (check_file(name, size) != expected)
          throw FileError(name + " was changed since checkpoint " +
                          std::to_string(manifest.number) +
                          " was written: its first " + std::to_string(size) +
                          " bytes are not those that the run wrote." + advice);
      }
  }



  void
  CheckpointFolder::go_back_to(const CheckpointManifest &manifest) const
  {
    std::error_code error;
    for (const unsigned int other : numbers())
      if (other > manifest.number)
        {
          const std::string damaged = name(other) + ".damaged";
          fs::remove_all(damaged, error);
          fs::rename(name(other), damaged, error);
          throw_if(error, "Cannot rename " + name(other));
        }
    for (const auto &[table, check] : manifest.tables)
      {
        const std::string name = directory + '/' + table;
        fs::resize_file(name, check.first, error);
        throw_if(error, name + " cannot be continued");
      }
  }
} // namespace Crevasse
