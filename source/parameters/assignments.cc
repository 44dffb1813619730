// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/base/text_file.h>
#include <crevasse/parameters/assignments.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

namespace Crevasse
{
  namespace fs = std::filesystem;
  using Json   = nlohmann::ordered_json;

  namespace
  {
    /** Reads deal.II's .prm format. */
    class PrmReader
    {
    public:
      PrmReader(std::vector<Assignment> &assignments, Problems &problems)
        : assignments(assignments)
        , problems(problems)
      {
      }

      void
      read(const std::string &file_name)
      {
        std::istringstream text(read_text_file(file_name));
        File               file{{file_name, 0}, sections.size(), {}};
        std::error_code    unknown;
        files.push_back(fs::weakly_canonical(file_name, unknown));

        std::string  statement;
        unsigned int n_lines = 0;
        for (std::string line; std::getline(text, line);)
          {
            ++n_lines;
            if (statement.empty())
              file.origin.line = n_lines;
            // A comment ends with its line, even where the line continues.
            statement +=
              dealii::Utilities::trim(line.substr(0, line.find('#')));
            const bool continues =
              !statement.empty() && statement.back() == '\\';
            if (continues)
              statement.pop_back();
            if (continues &&
                text.peek() != std::istringstream::traits_type::eof())
              continue;
            read_statement(Text::squeeze(statement), file);
            statement.clear();
          }

        for (std::size_t i = file.depth; i < sections.size(); ++i)
          problems.add("the subsection \"" + Text::shorten(sections[i].first) +
                         "\" is never closed by an \"end\"",
                       sections[i].second);
        sections.resize(file.depth);
        files.pop_back();
      }

    private:
      /** State of reading one file, without the files that it includes. */
      struct File
      {
        Origin origin;
        /** Number of open sections of the including files. */
        std::size_t depth;
        /** First origin of each parameter "Section/Name" of the file. */
        std::map<std::string, std::string> first_places;
      };

      void
      read_statement(const std::string &statement, File &file)
      {
        const std::size_t space = statement.find(' ');
        const std::string rest =
          space == std::string::npos ? "" : statement.substr(space + 1);
        const auto begins_with = [&](const char *small, const char *capital) {
          const std::string word = statement.substr(0, space);
          return (word == small || word == capital) && !rest.empty();
        };

        if (statement.empty())
          return;
        if (begins_with("set", "SET") && rest[0] != '=' &&
            rest.find('=') != std::string::npos)
          set_parameter(rest, file);
        else if (begins_with("subsection", "SUBSECTION"))
          {
            sections.emplace_back(rest, file.origin);
            assignments.push_back({file.origin, section_path(), "", ""});
          }
        else if ((statement == "end" || statement == "END") &&
                 sections.size() > file.depth)
          sections.pop_back();
        else if (begins_with("include", "INCLUDE"))
          include_file(rest, file);
        else
          problems.add("\"" + Text::shorten(statement) +
                         "\" cannot be understood; a line must be \"set Name = "
                         "value\", \"subsection Name\", its \"end\", \"include "
                         "file\" or a comment after \"#\"",
                       file.origin);
      }

      void
      set_parameter(const std::string &text, File &file)
      {
        const std::size_t equals = text.find('=');
        const std::string name =
          dealii::Utilities::trim(text.substr(0, equals));
        const std::string section = section_path();
        const auto [first, is_new] =
          file.first_places.emplace(section + "/" + name, file.origin.text());
        if (is_new)
          assignments.push_back(
            {file.origin,
             section,
             name,
             dealii::Utilities::trim(text.substr(equals + 1))});
        else
          problems.add(Text::parameter(section, name) +
                         " is set a second time; it was set at " +
                         first->second,
                       file.origin);
      }

      void
      include_file(const std::string &name, const File &file)
      {
        const fs::path included =
          (fs::path(file.origin.source).parent_path() / name)
            .lexically_normal();
        std::error_code unknown;
        if (std::find(files.begin(),
                      files.end(),
                      fs::weakly_canonical(included, unknown)) != files.end())
          return problems.add("the file \"" + included.string() +
                                "\" includes itself",
                              file.origin);
        try
          {
            read(included.string());
          }
        catch (const FileError &error)
          {
            problems.add(error.what(), file.origin);
            problems.last_is_unreadable();
          }
      }

      std::string
      section_path() const
      {
        std::string path;
        for (const auto &[name, origin] : sections)
          path += (path.empty() ? "" : "/") + name;
        return path;
      }

      std::vector<Assignment> &assignments;
      Problems                &problems;
      /** Open sections: name and origin. */
      std::vector<std::pair<std::string, Origin>> sections;
      /** Open files, each included by the previous one. */
      std::vector<fs::path> files;
    };



    /** Text of a JSON value; numbers keep all their digits. */
    std::optional<std::string>
    to_text(const Json &value)
    {
      if (value.is_string())
        return Text::squeeze(value.get<std::string>());
      if (value.is_number() || value.is_boolean())
        return value.dump();
      if (!value.is_array())
        return {};

      std::vector<std::string> numbers;
      for (const Json &element : value)
        if (element.is_number())
          numbers.push_back(element.dump());
        else
          return {};
      return Text::join(numbers, ", ");
    }



    /** Parses JSON and reports duplicate names, which the resulting object no
     * longer shows.
     * @throw Json::exception */
    Json
    parse_json(const std::string &text,
               const Origin      &origin,
               Problems          &problems)
    {
      std::vector<std::set<std::string>> levels;
      return Json::parse(
        text, [&](int, const Json::parse_event_t event, const Json &parsed) {
          if (event == Json::parse_event_t::object_start)
            levels.emplace_back();
          else if (event == Json::parse_event_t::object_end)
            levels.pop_back();
          else if (event == Json::parse_event_t::key)
            if (const auto name = parsed.get<std::string>();
                !levels.back().insert(name).second)
              problems.add("\"" + Text::shorten(name) + "\" occurs twice",
                           origin);
          return true;
        });
    }



    /** Reads parameters and nested sections of a JSON object for a section. */
    void
    read_object(const Json              &object,
                const std::string       &section,
                const Origin            &origin,
                std::vector<Assignment> &assignments,
                Problems                &problems)
    {
      for (const auto &[name, value] : object.items())
        if (section.empty() && name == "$schema")
          continue; // used by editors
        else if (value.is_object() &&
                 (!value.contains("value") || value.at("value").is_object()))
          {
            const std::string path =
              section.empty() ? name : section + "/" + name;
            assignments.push_back({origin, path, "", ""});
            // Sections do not nest: a nested section is reported as unknown,
            // and its contents do not matter.
            if (section.empty())
              read_object(value, path, origin, assignments, problems);
          }
        else if (const auto text =
                   to_text(value.is_object() ? value.at("value") : value))
          assignments.push_back({origin, section, name, *text});
        else
          problems.add(Text::parameter(section, name) +
                         ": must be a number, true or false, a text, or an "
                         "array of numbers",
                       origin);
    }



    void
    read_json(const std::string       &file_name,
              std::vector<Assignment> &assignments,
              Problems                &problems)
    {
      const Origin      origin{file_name};
      const std::string text = read_text_file(file_name);
      try
        {
          const Json scene = parse_json(text, origin, problems);
          if (scene.is_object())
            read_object(scene, "", origin, assignments, problems);
          else
            problems.add("must be one JSON object, {...}", origin);
        }
      catch (const Json::exception &error)
        {
          // The message begins with the library's error number in brackets.
          const std::string message = error.what();
          problems.add("is not valid JSON: " +
                         message.substr(message.find(' ') + 1),
                       origin);
        }
    }



    void
    read_override(const std::string       &text,
                  std::vector<Assignment> &assignments,
                  Problems                &problems)
    {
      const Origin      origin{"--set \"" + Text::shorten(text) + "\""};
      const std::size_t equals = text.find('=');
      const std::string path   = text.substr(0, equals);
      const std::size_t slash  = path.rfind('/');
      const std::string name   = Text::squeeze(path.substr(slash + 1));
      if (equals == std::string::npos || name.empty())
        return problems.add(
          "must have the form \"Section/Name=value\", or "
          "\"Name=value\" for the top level",
          origin);
      assignments.push_back(
        {origin,
         slash == std::string::npos ? "" : Text::squeeze(path.substr(0, slash)),
         name,
         Text::squeeze(text.substr(equals + 1))});
    }
  } // namespace



  std::vector<Assignment>
  read_assignments(const std::string              &file_name,
                   const std::vector<std::string> &overrides,
                   Problems                       &problems)
  {
    std::vector<Assignment> assignments;
    const fs::path          extension = fs::path(file_name).extension();
    if (extension == ".prm")
      PrmReader(assignments, problems).read(file_name);
    else if (extension == ".json")
      read_json(file_name, assignments, problems);
    else
      {
        read_text_file(file_name); // a missing file is the more important error
        problems.add("the name of a scene file must end in .prm or .json",
                     {file_name});
      }
    for (const std::string &text : overrides)
      read_override(text, assignments, problems);
    return assignments;
  }
} // namespace Crevasse
