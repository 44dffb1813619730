// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text_file.h>
#include <crevasse/base/version.h>
#include <crevasse/checkpoint/checkpoint_folder.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <unistd.h>

namespace Crevasse
{
  namespace fs = std::filesystem;

  namespace
  {
    /** Of the files; what was written by another one cannot be read. */
    constexpr int format_version = 6;

    constexpr const char *manifest_file = "manifest.json";
    constexpr const char *being_written = ".new";
    constexpr const char *set_aside     = ".damaged";



    /** A checkpoint that may be in order, for another program. */
    struct OtherFormat : FileError
    {
      using FileError::FileError;
    };



    /** What must not be read is not damaged. @throw FileError */
    void
    require_readable(const std::string &folder)
    {
      std::vector<std::string> names = {folder};
      std::error_code          error;
      for (const auto &entry : fs::directory_iterator(folder, error))
        names.push_back(entry.path().string());
      for (const std::string &name : names)
        if (access(name.c_str(), R_OK) != 0)
          throw FileError("Cannot read " + name + " (" + std::strerror(errno) +
                          ").");
    }



    Summary
    as_json(const FileCheck &check)
    {
      return {{"bytes", check.bytes}, {"crc32", check.crc}};
    }



    FileCheck
    as_check(const Summary &json)
    {
      return {json.at("bytes").get<std::size_t>(),
              json.at("crc32").get<std::uint32_t>()};
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
      Summary json   = {{"format", format_version},
                        {"version", CREVASSE_VERSION},
                        {"written", now()},
                        {"number", manifest.number},
                        {"period", manifest.period},
                        {"step", manifest.step},
                        {"ranks", manifest.ranks}};
      json["common"] = as_json(manifest.common);
      for (const FieldFile &file : manifest.fields)
        {
          Summary entry       = as_json(file.check);
          entry["name"]       = file.name;
          entry["first_cell"] = file.first_cell;
          entry["cells"]      = file.n_cells;
          json["fields"].push_back(entry);
        }
      json["tables"]     = manifest.tables;
      json["scene_hash"] = checksum(manifest.scene.dump());
      json["scene"]      = manifest.scene;
      return json;
    }



    CheckpointManifest
    as_manifest(const Summary &json)
    {
      CheckpointManifest manifest;
      manifest.number = json.at("number");
      manifest.period = json.at("period");
      manifest.step   = json.at("step");
      manifest.ranks  = json.at("ranks");
      manifest.common = as_check(json.at("common"));
      for (const Summary &entry : json.at("fields"))
        manifest.fields.push_back({entry.at("name"),
                                   as_check(entry),
                                   entry.at("first_cell"),
                                   entry.at("cells")});
      manifest.tables = json.at("tables").get<decltype(manifest.tables)>();
      manifest.scene  = json.at("scene");
      return manifest;
    }
  } // namespace



  CheckpointFolder::CheckpointFolder(const std::string &directory)
    : directory(directory)
    , path(directory + "/checkpoint")
  {
  }



  std::string
  CheckpointFolder::name(const unsigned int number) const
  {
    return path + '/' + std::to_string(number);
  }



  std::string
  CheckpointFolder::file(const unsigned int number,
                         const std::string &name) const
  {
    return this->name(number) + '/' + name;
  }



  std::string
  CheckpointFolder::new_file(const unsigned int number,
                             const std::string &name) const
  {
    return this->name(number) + being_written + '/' + name;
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
    if (error && error != std::errc::no_such_file_or_directory)
      throw FileError("Cannot look for checkpoints in " + path + " (" +
                      error.message() + ").");
    std::sort(found.begin(), found.end());
    return found;
  }



  unsigned int
  CheckpointFolder::begin() const
  {
    const std::vector<unsigned int> there = numbers();
    const unsigned int number = there.empty() ? 1 : there.back() + 1;
    const std::string  folder = name(number) + being_written;
    std::error_code    error;
    fs::remove_all(folder, error);
    fs::create_directories(folder, error);
    if (error)
      throw FileError("Cannot make " + folder + " (" + error.message() + ").");
    return number;
  }



  bool
  CheckpointFolder::has_any() const
  {
    return !numbers().empty();
  }



  void
  CheckpointFolder::finish(const CheckpointManifest &manifest) const
  {
    const std::string content = as_json(manifest).dump(2);
    const std::string folder  = name(manifest.number) + being_written;
    CheckedFile       file(folder + '/' + manifest_file);
    const std::string text = std::to_string(checksum(content)) + '\n' + content;
    file.write(text.data(), text.size());
    file.finish();
    write_through(folder);

    std::error_code error;
    fs::rename(folder, name(manifest.number), error);
    if (error)
      throw FileError("Cannot rename " + folder + " (" + error.message() +
                      ").");
    write_through(path);
    write_through(directory);
    for (const unsigned int other : numbers())
      if (other + 1 < manifest.number)
        fs::remove_all(name(other), error); // a nuisance at most if it stays
  }



  void
  CheckpointFolder::abandon(const unsigned int number) const
  {
    std::error_code error; // told already is what went wrong
    fs::remove_all(name(number) + being_written, error);
  }



  CheckpointManifest
  CheckpointFolder::read(const unsigned int number) const
  {
    const std::string text    = read_text_file(file(number, manifest_file));
    const auto        newline = std::min(text.find('\n'), text.size());
    const std::string content = text.substr(std::min(newline + 1, text.size()));
    if (text.substr(0, newline) != std::to_string(checksum(content)))
      throw FileError(file(number, manifest_file) + " has another checksum");
    const Summary json = Summary::parse(content);
    if (json.at("format") != format_version)
      throw OtherFormat(
        "--resume: the checkpoint " + name(number) +
        " was written by version " + json.value("version", std::string("?")) +
        " of the program, whose checkpoints this one, " CREVASSE_VERSION
        ", cannot read. Resume with that version, or begin anew in another "
        "output directory.");
    const CheckpointManifest manifest = as_manifest(json);
    std::string              fault;
    read_checked(file(number, common_file), manifest.common, fault);
    for (const FieldFile &fields : manifest.fields)
      if (fault.empty())
        read_checked(file(number, fields.name), fields.check, fault);
    if (!fault.empty())
      throw FileError(fault);
    return manifest;
  }



  std::optional<CheckpointManifest>
  CheckpointFolder::newest(std::vector<std::string> &warnings) const
  {
    const std::vector<unsigned int> all = numbers();
    for (auto number = all.rbegin(); number != all.rend(); ++number)
      {
        const auto warn = [&](const std::exception &fault) {
          warnings.push_back("checkpoint " + name(*number) +
                             " is damaged and not used: " + fault.what());
        };
        // Whatever else is thrown is no fault of the checkpoint.
        try
          {
            return read(*number);
          }
        catch (const OtherFormat &)
          {
            throw;
          }
        catch (const FileError &fault)
          {
            require_readable(name(*number));
            warn(fault);
          }
        catch (const Summary::exception &fault)
          {
            warn(fault);
          }
      }
    return {};
  }



  void
  CheckpointFolder::set_aside_after(const unsigned int number) const
  {
    for (const unsigned int other : numbers())
      {
        if (other <= number)
          continue;
        const std::string damaged = name(other) + set_aside;
        std::error_code   error;
        fs::remove_all(damaged, error);
        fs::rename(name(other), damaged, error);
        if (error)
          throw FileError("Cannot rename " + name(other) + " (" +
                          error.message() + ").");
      }
  }



  std::map<std::string, std::size_t>
  CheckpointFolder::measure_tables(const std::vector<std::string> &names) const
  {
    std::map<std::string, std::size_t> sizes;
    for (const std::string &table : names)
      {
        const std::string name = directory + '/' + table;
        std::error_code   error;
        if (!fs::exists(name, error))
          continue;
        write_through(name);
        sizes[table] = fs::file_size(name, error);
        if (error)
          throw FileError("Cannot tell the size of " + name + " (" +
                          error.message() + ").");
      }
    return sizes;
  }



  void
  CheckpointFolder::require_tables(const CheckpointManifest &manifest) const
  {
    constexpr const char *advice =
      " Restore it, or begin anew without --resume, in another output "
      "directory.";
    for (const auto &[table, size] : manifest.tables)
      {
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
      }
  }



  void
  CheckpointFolder::cut_tables(const CheckpointManifest &manifest) const
  {
    for (const auto &[table, size] : manifest.tables)
      {
        const std::string name = directory + '/' + table;
        std::error_code   error;
        fs::resize_file(name, size, error);
        if (error)
          throw FileError(name + " cannot be continued (" + error.message() +
                          ").");
      }
  }
} // namespace Crevasse
