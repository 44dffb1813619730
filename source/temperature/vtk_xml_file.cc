// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/base/text_file.h>
#include <crevasse/temperature/vtk_data.h>
#include <crevasse/temperature/vtk_xml_file.h>

#include <algorithm>
#include <boost/property_tree/xml_parser.hpp>
#include <filesystem>
#include <sstream>

namespace Crevasse
{
  namespace
  {
    std::string
    read_file(const std::string &file_name)
    {
      try
        {
          return read_text_file(file_name);
        }
      catch (const FileError &error)
        {
          // It has the name of the file as well.
          const std::string what = error.what();
          throw SceneError(
            file_name + ": " +
            what.substr(std::min(what.find("cannot be read"), what.size())));
        }
    }



    /** A parser that calls itself for each element within another one would
     * not survive thousands of them, of which a damaged or hostile file may
     * have any number. */
    bool
    nests_too_deep(const std::string &text)
    {
      constexpr int deepest = 100;

      int depth = 0;
      for (std::size_t tag = text.find('<');
           tag != std::string::npos && depth <= deepest;
           tag = text.find('<', tag + 1))
        {
          const char        next = text[tag + 1]; // a string ends with '\0'
          const std::size_t end  = text.find_first_of("<>", tag + 1);
          const bool        is_closed =
            end != std::string::npos && text[end - 1] == '/';
          if (next == '/')
            --depth;
          else if (next != '?' && next != '!' && !is_closed)
            ++depth;
        }
      return depth > deepest;
    }
  } // namespace



  VtkXmlFile::VtkXmlFile(const std::string &file_name)
    : file_name(file_name)
  {
    parse(read_file(file_name));
    check_encoding();
  }



  void
  VtkXmlFile::refuse(const std::string &reason) const
  {
    throw SceneError(file_name + ": " + reason);
  }



  void
  VtkXmlFile::parse(std::string text)
  {
    if (text.find_first_not_of(" \t\r\n") == std::string::npos)
      refuse("is empty.");

    // What is appended need not be XML, and is nothing that a parser of XML
    // should look at.
    const std::size_t begin = text.find("<AppendedData");
    if (begin != std::string::npos)
      {
        const std::size_t tag_end = text.find('>', begin);
        const std::size_t first   = text.find('_', tag_end);
        const std::size_t end     = text.rfind("</AppendedData");
        if (first == std::string::npos || end == std::string::npos ||
            end < first)
          refuse("breaks off within its element AppendedData.");
        appended = text.substr(first + 1, end - first - 1);
        text.replace(tag_end + 1, end - tag_end - 1, "");
      }

    if (nests_too_deep(text))
      refuse("has elements within elements, more than a file of VTK has.");
    Element            document;
    std::istringstream stream(text);
    try
      {
        read_xml(stream, document);
      }
    catch (const boost::property_tree::xml_parser_error &error)
      {
        refuse("is not XML, or breaks off: line " +
               std::to_string(error.line()) + ": " + error.message() + ".");
      }
    const auto file = document.get_child_optional("VTKFile");
    if (!file)
      refuse("has no element VTKFile; only VTK's files in XML can be read.");
    root = *file;
  }



  void
  VtkXmlFile::check_encoding() const
  {
    if (attribute(root, "byte_order") == "BigEndian")
      refuse(
        "has the byte order BigEndian; save it on a machine that is "
        "LittleEndian, or with the data as text (ASCII) and "
        "byte_order=\"LittleEndian\".");
    const std::string compressor = attribute(root, "compressor");
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
      refuse("is compressed by " + Text::shorten(compressor) +
             "; save it with the compressor ZLib, or without.");
    const std::string header = attribute(root, "header_type");
    if (!header.empty() && header != "UInt32" && header != "UInt64")
      refuse("has the header_type " + Text::shorten(header) +
             "; allowed are UInt32 and UInt64.");
  }



  std::string
  VtkXmlFile::type() const
  {
    return attribute(root, "type");
  }



  const VtkXmlFile::Element &
  VtkXmlFile::content() const
  {
    const auto place = root.find(type());
    if (place == root.not_found())
      refuse("has no element " + Text::shorten(type()) +
             ", which is its type.");
    return place->second;
  }



  std::string
  VtkXmlFile::attribute(const Element &element, const std::string &name)
  {
    return element.get("<xmlattr>." + name, "");
  }



  std::string
  VtkXmlFile::neighbour(const std::string &other_file_name) const
  {
    return (std::filesystem::path(file_name).parent_path() / other_file_name)
      .string();
  }



  std::vector<double>
  VtkXmlFile::numbers(const Element &array, const std::size_t n_numbers) const
  {
    const std::string name =
      "its array \"" + Text::shorten(attribute(array, "Name")) + "\" ";
    const std::string type = attribute(array, "type");
    if (VtkData::size_of(type) == 0)
      refuse(name + "has the type \"" + Text::shorten(type) +
             "\"; allowed are Float32, Float64, Int8 to Int64 and UInt8 to "
             "UInt64.");

    std::vector<double> numbers;
    try
      {
        const std::string format = attribute(array, "format");
        numbers                  = format.empty() || format == "ascii"
                                     ? VtkData::from_text(array.data())
                                     : VtkData::from_bytes(
                        bytes(array, n_numbers * VtkData::size_of(type)), type);
      }
    catch (const VtkData::Corrupted &error)
      {
        refuse(name + error.reason + "; it must have " +
               std::to_string(n_numbers) + " numbers.");
      }
    if (numbers.size() != n_numbers)
      refuse(name + "has " + std::to_string(numbers.size()) +
             " numbers; it must have " + std::to_string(n_numbers) + ".");
    return numbers;
  }



  std::string
  VtkXmlFile::bytes(const Element &array, const std::size_t n_bytes) const
  {
    VtkData::Encoding encoding;
    encoding.is_compressed = !attribute(root, "compressor").empty();
    encoding.has_long_head = attribute(root, "header_type") == "UInt64";

    const std::string format = attribute(array, "format");
    if (format == "binary")
      {
        std::string text = array.data();
        text.erase(std::remove_if(text.begin(), text.end(), Text::is_space),
                   text.end());
        return VtkData::decode(text, encoding, n_bytes);
      }
    if (format != "appended")
      throw VtkData::Corrupted{"has the format \"" + Text::shorten(format) +
                               "\"; allowed are ascii, binary and appended"};

    const auto offset = Text::to_number(attribute(array, "offset"));
    if (!offset || *offset < 0. || *offset >= appended.size())
      throw VtkData::Corrupted{"has an offset that is not within AppendedData"};
    encoding.is_base64 =
      root.get("AppendedData.<xmlattr>.encoding", "base64") != "raw";
    return VtkData::decode(std::string_view(appended).substr(*offset),
                           encoding,
                           n_bytes);
  }
} // namespace Crevasse
