// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/base/text_file.h>
#include <crevasse/parameters/prm_reader.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    class PrmReader
    {
    public:
      PrmReader(std::vector<Assignment> &assignments, Problems &problems)
        : assignments(assignments)
        , problems(problems)
      {
      }

      void
      read(const std::string &file_name);

    private:
      struct OpenSection
      {
        std::string name;
        std::string place;
      };

      /** What belongs to one file, not to those that it includes. */
      struct File
      {
        std::string  name;
        unsigned int line = 0;
        /** Sections that the including files have opened. */
        std::size_t depth = 0;
        /** "Section/Name" and the place where it was set first. */
        std::map<std::string, std::string> first_places;
      };

      void
      read_statement(const std::string &statement, File &file);

      void
      open_section(const std::string &name, const File &file);

      void
      close_section(const File &file);

      void
      set_parameter(const std::string &text, File &file);

      void
      include_file(const std::string &name, const File &file);

      void
      report_open_sections(const File &file);

      std::string
      section_path() const;

      static std::string
      place(const File &file)
      {
        return file.name + ":" + std::to_string(file.line);
      }

      std::vector<Assignment> &assignments;
      Problems                &problems;
      std::vector<OpenSection> sections;
      /** The files being read, each included by the one before. */
      std::vector<std::string> files;
    };



    /** One name for one file, so that a file that includes itself is seen. */
    std::string
    canonical(const std::string &file_name)
    {
      std::error_code error;
      const auto path = std::filesystem::weakly_canonical(file_name, error);
      return error ? file_name : path.string();
    }



    void
    PrmReader::read(const std::string &file_name)
    {
      std::istringstream text(read_text_file(file_name));

      File file;
      file.name  = file_name;
      file.depth = sections.size();
      files.push_back(canonical(file_name));

      std::string  statement;
      unsigned int n_lines = 0;
      for (std::string line; std::getline(text, line);)
        {
          ++n_lines;
          if (statement.empty())
            file.line = n_lines;
          // A comment ends with its line, even where the line continues.
          statement += Utilities::trim(
            line.substr(0, std::min(line.find('#'), line.size())));
          if (!statement.empty() && statement.back() == '\\')
            {
              statement.pop_back();
              continue;
            }
          read_statement(Text::squeeze(statement), file);
          statement.clear();
        }
      read_statement(Text::squeeze(statement), file);

      report_open_sections(file);
      files.pop_back();
    }



    void
    PrmReader::read_statement(const std::string &statement, File &file)
    {
      const std::size_t end_of_word = statement.find(' ');
      const std::string word        = statement.substr(0, end_of_word);
      const std::string rest        = end_of_word == std::string::npos
                                        ? ""
                                        : statement.substr(end_of_word + 1);

      if (statement.empty())
        return;
      else if ((word == "set" || word == "SET") && !rest.empty())
        set_parameter(rest, file);
      else if ((word == "subsection" || word == "SUBSECTION") && !rest.empty())
        open_section(rest, file);
      else if ((word == "end" || word == "END") && rest.empty())
        close_section(file);
      else if ((word == "include" || word == "INCLUDE") && !rest.empty())
        include_file(rest, file);
      else
        problems.add(place(file) + ": \"" + Text::shorten(statement) +
                     "\" cannot be understood; a line must be \"set Name = "
                     "value\", \"subsection Name\", \"end\", \"include "
                     "file\" or a comment after \"#\"");
    }



    void
    PrmReader::open_section(const std::string &name, const File &file)
    {
      sections.push_back({name, place(file)});
      assignments.push_back({place(file), section_path(), "", ""});
    }



    void
    PrmReader::close_section(const File &file)
    {
      if (sections.size() > file.depth)
        sections.pop_back();
      else
        problems.add(place(file) +
                     ": \"end\" without a \"subsection\" before it");
    }



    void
    PrmReader::set_parameter(const std::string &text, File &file)
    {
      const std::size_t equals = text.find('=');
      const std::string name   = Utilities::trim(text.substr(0, equals));
      if (equals == std::string::npos || name.empty())
        {
          problems.add(place(file) + ": \"set " + Text::shorten(text) +
                       "\" must have the form \"set Name = value\"");
          return;
        }

      const std::string section = section_path();
      const auto [first, is_new] =
        file.first_places.emplace(section + "/" + name, place(file));
      if (is_new)
        assignments.push_back({place(file),
                               section,
                               name,
                               Utilities::trim(text.substr(equals + 1))});
      else
        problems.add(place(file) + ": " + Text::parameter(section, name) +
                     " is set a second time; it was set at " + first->second);
    }



    void
    PrmReader::include_file(const std::string &name, const File &file)
    {
      namespace fs = std::filesystem;

      const fs::path included =
        (fs::path(file.name).parent_path() / name).lexically_normal();
      if (std::find(files.begin(), files.end(), canonical(included.string())) !=
          files.end())
        {
          problems.add(place(file) + ": the file \"" + included.string() +
                       "\" includes itself");
          return;
        }

      try
        {
          read(included.string());
        }
      catch (const FileError &error)
        {
          problems.add_unreadable(place(file) + ": " + error.what());
        }
    }



    void
    PrmReader::report_open_sections(const File &file)
    {
      for (std::size_t i = file.depth; i < sections.size(); ++i)
        problems.add(sections[i].place + ": the subsection \"" +
                     Text::shorten(sections[i].name) +
                     "\" is never closed by an \"end\"");
      sections.resize(file.depth);
    }



    std::string
    PrmReader::section_path() const
    {
      std::vector<std::string> names;
      for (const OpenSection &section : sections)
        names.push_back(section.name);
      return Text::join(names, "/");
    }
  } // namespace



  void
  read_prm(const std::string       &file_name,
           std::vector<Assignment> &assignments,
           Problems                &problems)
  {
    PrmReader(assignments, problems).read(file_name);
  }
} // namespace Crevasse
