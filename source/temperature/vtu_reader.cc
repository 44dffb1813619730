// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/temperature/vtk_xml_file.h>
#include <crevasse/temperature/vtu_reader.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    using Element = VtkXmlFile::Element;

    /** Which corners of VTK's are deal.II's, in the order of the latter. */
    using Corners = std::vector<unsigned int>;



    /** The kinds of cells of a dimension by their numbers in VTK; all begin
     * with their corners. */
    const std::map<unsigned int, Corners> &
    kinds_of_cells(const unsigned int dim)
    {
      static const Corners line{0, 1}, triangle{0, 1, 2}, square{0, 1, 3, 2},
        pixel{0, 1, 2, 3}, tetrahedron{0, 1, 2, 3},
        cube{0, 1, 3, 2, 4, 5, 7, 6}, voxel{0, 1, 2, 3, 4, 5, 6, 7};
      // Linear, then quadratic, then of any degree.
      static const std::vector<std::map<unsigned int, Corners>> kinds{
        {{1, {0}}},
        {{3, line}, {21, line}, {68, line}},
        {{5, triangle},
         {8, pixel},
         {9, square},
         {22, triangle},
         {23, square},
         {28, square},
         {34, triangle},
         {69, triangle},
         {70, square}},
        {{10, tetrahedron},
         {11, voxel},
         {12, cube},
         {24, tetrahedron},
         {25, cube},
         {29, cube},
         {71, tetrahedron},
         {72, cube}}};
      return kinds[dim];
    }



    const Element &
    child(const VtkXmlFile &file, const Element &element, const char *name)
    {
      const auto place = element.find(name);
      if (place == element.not_found())
        file.refuse(std::string("has a piece without the element ") + name +
                    ".");
      return place->second;
    }



    unsigned int
    count(const VtkXmlFile &file, const Element &piece, const std::string &name)
    {
      const std::string value = VtkXmlFile::attribute(piece, name);
      const auto        n     = Text::to_unsigned(value);
      if (!n)
        file.refuse("has a piece with " + name + " = \"" +
                    Text::shorten(value) + "\", which is no number of them.");
      return *n;
    }



    std::string
    lower_case(std::string text)
    {
      for (char &character : text)
        character = std::tolower(static_cast<unsigned char>(character));
      return text;
    }



    std::string
    quote_all(const std::vector<std::string> &names)
    {
      return names.empty() ? "none" : '"' + Text::join(names, "\", \"") + '"';
    }



    /** The array at points that must be the temperature. */
    const Element &
    choose_array(const VtkXmlFile &file, const Element &piece)
    {
      std::map<std::string, const Element *> scalars;
      std::vector<std::string>               names, others;
      const auto                             points = piece.find("PointData");
      if (points != piece.not_found())
        for (const auto &[kind, array] : points->second)
          if (kind == "DataArray")
            {
              const std::string name = VtkXmlFile::attribute(array, "Name");
              const std::string n_components =
                VtkXmlFile::attribute(array, "NumberOfComponents");
              const bool is_scalar =
                n_components.empty() || n_components == "1";
              (is_scalar ? names : others).push_back(Text::shorten(name));
              if (is_scalar)
                scalars.emplace(lower_case(name), &array);
            }
      for (const char *name : {"theta", "temperature", "t"})
        if (scalars.count(name) > 0)
          return *scalars[name];
      if (names.size() == 1)
        return *scalars.begin()->second;
      file.refuse(
        "one array at its points must be a scalar with the name theta, "
        "temperature or T. Its scalars at points: " +
        quote_all(names) + "; others: " + quote_all(others) +
        ". Values in cells are not read (ParaView: Cell Data to Point Data).");
    }



    /** The coordinates of a piece; in the plane, all must have the same z. */
    template <int dim>
    std::vector<Point<dim>>
    read_points(const VtkXmlFile  &file,
                const Element     &piece,
                const unsigned int n)
    {
      const Element &array =
        child(file, child(file, piece, "Points"), "DataArray");
      const auto coordinates = file.numbers(array, 3 * std::size_t(n));
      std::vector<Point<dim>> points(n);
      double                  extent = 0., height = 0.;
      for (std::size_t p = 0; p < n; ++p)
        {
          for (unsigned int d = 0; d < dim; ++d)
            points[p][d] = coordinates[3 * p + d];
          if (!std::all_of(&coordinates[3 * p],
                           &coordinates[3 * p] + 3,
                           [](const double x) { return std::isfinite(x); }))
            file.refuse("its point " + std::to_string(p) +
                        " has a coordinate that is not finite.");
          extent = std::max(extent, points[p].distance(points[0]));
          height =
            std::max(height, std::abs(coordinates[3 * p + 2] - coordinates[2]));
        }
      if (dim == 2 && height > 1e-6 * extent)
        file.refuse(
          "its points differ in z; with Dimension = 2 the mesh must "
          "lie in a plane z = const.");
      return points;
    }



    /** Integers from 0 to below @p bound. */
    std::vector<std::size_t>
    read_integers(const VtkXmlFile  &file,
                  const Element     &cells,
                  const std::string &name,
                  const std::size_t  n,
                  const double       bound)
    {
      for (const auto &[kind, array] : cells)
        if (kind == "DataArray" && VtkXmlFile::attribute(array, "Name") == name)
          {
            std::vector<std::size_t> integers;
            for (const double number : file.numbers(array, n))
              if (number >= 0. && number < bound &&
                  number == std::floor(number))
                integers.push_back(number);
              else
                file.refuse("its array \"" + name + "\" has the entry " +
                            Text::from_number(number) +
                            "; allowed are integers from 0 to " +
                            Text::from_number(bound - 1.) + ".");
            return integers;
          }
      file.refuse("has a piece without the array \"" + name + "\" in Cells.");
    }



    template <int dim>
    void
    read_cells(const VtkXmlFile  &file,
               const Element     &piece,
               const unsigned int n_points,
               const unsigned int n_cells,
               CellMesh<dim>     &mesh)
    {
      const Element &cells = child(file, piece, "Cells");
      const auto     types = read_integers(file, cells, "types", n_cells, 256.);
      const auto ends = read_integers(file, cells, "offsets", n_cells, 1e12);
      const auto nodes =
        read_integers(file, cells, "connectivity", ends.back(), n_points);
      const std::size_t first_vertex = mesh.vertices.size() - n_points;
      for (std::size_t cell = 0; cell < n_cells; ++cell)
        {
          unsigned int dimension = 0;
          while (dimension <= dim &&
                 kinds_of_cells(dimension).count(types[cell]) == 0)
            ++dimension;
          if (dimension > dim)
            file.refuse("has cells of VTK's type " +
                        std::to_string(types[cell]) + "; allowed are " +
                        (dim == 2 ? "triangles (5) and quadrilaterals (9)"
                                  : "tetrahedra (10) and hexahedra (12)") +
                        ", linear or quadratic.");
          const std::size_t begin   = cell == 0 ? 0 : ends[cell - 1];
          const Corners    &corners = kinds_of_cells(dimension).at(types[cell]);
          if (ends[cell] > nodes.size() || ends[cell] < begin + corners.size())
            file.refuse("its array \"offsets\" has the wrong entry " +
                        std::to_string(ends[cell]) + " for cell " +
                        std::to_string(cell) + ".");
          if (dimension < dim)
            continue;
          for (const unsigned int corner : corners)
            mesh.corners.push_back(first_vertex + nodes[begin + corner]);
          mesh.begins.push_back(mesh.corners.size());
        }
    }



    template <int dim>
    void
    read_piece(const VtkXmlFile &file,
               const Element    &piece,
               VertexField<dim> &field)
    {
      const unsigned int n_points = count(file, piece, "NumberOfPoints");
      const unsigned int n_cells  = count(file, piece, "NumberOfCells");
      if (n_points == 0 || n_cells == 0)
        return; // a process that had nothing to write

      const Element    &array        = choose_array(file, piece);
      const auto        values       = file.numbers(array, n_points);
      const auto        points       = read_points<dim>(file, piece, n_points);
      const std::size_t first_corner = field.mesh.corners.size();
      auto             &mesh         = field.mesh;
      mesh.vertices.insert(mesh.vertices.end(), points.begin(), points.end());
      field.values.insert(field.values.end(), values.begin(), values.end());
      read_cells(file, piece, n_points, n_cells, mesh);
      for (std::size_t c = first_corner; c < mesh.corners.size(); ++c)
        if (const unsigned int vertex = mesh.corners[c];
            !std::isfinite(field.values[vertex]))
          file.refuse("its array \"" +
                      Text::shorten(VtkXmlFile::attribute(array, "Name")) +
                      "\" is not finite at the point " +
                      Text::from_point(mesh.vertices[vertex]) + ".");
    }
  } // namespace



  template <int dim>
  void
  read_vtu(const std::string &file_name, VertexField<dim> &field)
  {
    const VtkXmlFile file(file_name);
    const bool       is_parallel = file.type() == "PUnstructuredGrid";
    if (!is_parallel && file.type() != "UnstructuredGrid")
      file.refuse("its type is \"" + Text::shorten(file.type()) +
                  "\"; it must be UnstructuredGrid (ParaView: Append "
                  "Datasets).");
    for (const auto &[name, piece] : file.content())
      if (name == "Piece")
        {
          if (!is_parallel)
            {
              read_piece(file, piece, field);
              continue;
            }
          const VtkXmlFile part(
            file.neighbour(VtkXmlFile::attribute(piece, "Source")));
          if (part.type() != "UnstructuredGrid")
            part.refuse("its type must be UnstructuredGrid, not \"" +
                        Text::shorten(part.type()) + "\".");
          for (const auto &[part_name, part_piece] : part.content())
            if (part_name == "Piece")
              read_piece(part, part_piece, field);
        }
  }



  template void
  read_vtu<2>(const std::string &, VertexField<2> &);
  template void
  read_vtu<3>(const std::string &, VertexField<3> &);
} // namespace Crevasse
