// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_temperature_vtk_xml_file_h
#define crevasse_temperature_vtk_xml_file_h

#include <boost/property_tree/ptree.hpp>
#include <string>
#include <vector>

namespace Crevasse
{
  /**
   * A file of VTK in XML (.vtu, .pvtu, .pvd): its elements, and the numbers in
   * its arrays, whichever way they are encoded: as text, or binary within their
   * element or appended to the file, in base64 or raw, compressed or not.
   */
  class VtkXmlFile
  {
  public:
    using Element = boost::property_tree::ptree;

    /** @throw SceneError, that begins with the name of the file, if it cannot
     * be read or is not such a file. */
    explicit VtkXmlFile(const std::string &file_name);

    /** What the file says it is: UnstructuredGrid, Collection, ... */
    std::string
    type() const;

    /** The element within VTKFile that has the name of the type.
     * @throw SceneError if there is none. */
    const Element &
    content() const;

    /** The value of an attribute, or nothing. */
    static std::string
    attribute(const Element &element, const std::string &name);

    /** The numbers of a DataArray, which must be @p n_numbers.
     * @throw SceneError */
    std::vector<double>
    numbers(const Element &array, const std::size_t n_numbers) const;

    /** A file that an element names, next to this one. */
    std::string
    neighbour(const std::string &other_file_name) const;

    [[noreturn]] void
    refuse(const std::string &reason) const;

  private:
    void
    parse(std::string text);

    void
    check_encoding() const;

    std::string
    bytes(const Element &array, const std::size_t n_bytes) const;

    const std::string file_name;
    Element           root;
    std::string       appended;
  };
} // namespace Crevasse

#endif
