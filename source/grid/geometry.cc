// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/grid/cell_quality.h>
#include <crevasse/grid/curved_edges.h>
#include <crevasse/grid/geometry.h>
#include <crevasse/grid/gmsh_file.h>
#include <crevasse/parameters/automatic.h>
#include <crevasse/parameters/built_in_boundary.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <boost/serialization/map.hpp>
#include <boost/serialization/vector.hpp>
#include <cmath>
#include <numeric>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    std::vector<double>
    equal_steps(const double length, const unsigned int n)
    {
      return std::vector<double>(n, length / n);
    }



    /** Sizes of cells along the crack plane, with the tip at a vertex. */
    std::vector<double>
    steps_through_tip(const GeometryParameters &parameters,
                      const unsigned int        n)
    {
      const double width      = parameters.width;
      const double tip        = tip_abscissa(parameters);
      const double cells_left = n * tip / width;
      const auto   n_left     = static_cast<unsigned int>(
        std::clamp(std::round(cells_left), 1., n - 1.));
      if (std::abs(cells_left - n_left) < 1e-10 * n)
        return equal_steps(width, n);

      std::vector<double>       steps = equal_steps(tip, n_left);
      const std::vector<double> right = equal_steps(width - tip, n - n_left);
      steps.insert(steps.end(), right.begin(), right.end());
      return steps;
    }



    /** Sets the boundary ids from deal.II's ids, two for each axis in turn. */
    template <int dim>
    void
    set_boundary_ids(const GeometryParameters &parameters,
                     Triangulation<dim>       &mesh)
    {
      const double tip = tip_abscissa(parameters);
      for (const auto &face : mesh.active_face_iterators())
        if (face->at_boundary())
          {
            const types::boundary_id id = face->boundary_id();
            if (id == 4 || id == 5)
              face->set_boundary_id(id == 4 ? BoundaryIds::front
                                            : BoundaryIds::back);
            else if (traits(parameters.shape).has_crack &&
                     id == BoundaryIds::ligament &&
                     (face->center()[0] > tip) ==
                       (parameters.shape == Shape::edge_crack))
              face->set_boundary_id(BoundaryIds::lip);
          }
    }



    template <int dim>
    void
    make_plate(const GeometryParameters &parameters, Triangulation<dim> &mesh)
    {
      const std::vector<unsigned int>  n = subdivisions(parameters, dim);
      std::vector<std::vector<double>> steps(dim);
      steps[0] = traits(parameters.shape).has_crack
                   ? steps_through_tip(parameters, n[0])
                   : equal_steps(parameters.width, n[0]);
      steps[1] = equal_steps(parameters.height, n[1]);
      if (dim == 3)
        steps[dim - 1] = equal_steps(parameters.thickness, n[dim - 1]);

      // GridGenerator requires that the far corner equals the sum of the steps
      // exactly.
      Point<dim> corner;
      for (unsigned int d = 0; d < dim; ++d)
        corner[d] = std::accumulate(steps[d].begin(), steps[d].end(), 0.);
      GridGenerator::subdivided_hyper_rectangle(
        mesh, steps, Point<dim>(), corner, true);

      set_boundary_ids(parameters, mesh);
    }



    /** Message of a deal.II exception, without the line of its source. */
    std::string
    reason(const std::exception &error)
    {
      const auto *exception = dynamic_cast<const ExceptionBase *>(&error);
      if (exception == nullptr)
        return error.what();
      std::ostringstream text;
      exception->print_info(text);
      const std::string info = Text::squeeze(text.str());
      return info == "(none)" ? "its format is not known" : info;
    }



    /** Checks that no cell folds over. deal.II could check this while it
     * creates a triangulation, but not for triangles or curved edges.
     * @return the quality of the cells, as text. */
    template <int dim>
    std::string
    require_convex_cells(const Triangulation<dim> &mesh,
                         const std::string        &where)
    {
      if (!mesh.all_reference_cells_are_hyper_cube())
        throw SceneError(
          where + "in this format only " +
          (dim == 2 ? "quadrilaterals" : "hexahedra") +
          " are allowed; the program divides other cells of a Gmsh file.");
      const std::vector<double> qualities = scaled_jacobians(mesh);
      double                    worst     = 1.;
      Point<dim>                place;
      for (const auto &cell : mesh.active_cell_iterators())
        {
          const double quality = qualities[cell->active_cell_index()];
          if (!(quality > 1e-9))
            throw SceneError(where + "the cell around " +
                             Text::from_point<dim>(cell->center()) +
                             " has an angle of 180 degrees or more" +
                             (has_curved_edges(mesh) ? ", or folds over" : "") +
                             "; every cell must be convex" +
                             (dim == 2 ? ", in the plane x-y." : "."));
          if (quality < worst)
            {
              worst = quality;
              place = cell->center();
            }
        }
      return Text::format("smallest scaled Jacobian %.2f (1: right angles)",
                          worst) +
             (worst < 1. ? ", in the cell around " + Text::from_point(place)
                         : "");
    }



    /** Coarse mesh in the form from which deal.II creates a triangulation. */
    template <int dim>
    struct CoarseMesh
    {
      std::vector<Point<dim>>        vertices;
      std::vector<CellData<dim>>     cells;
      std::vector<CellData<dim - 1>> boundary;
      EdgeMiddles<dim>               middles;
      std::vector<std::string>       remarks;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &vertices &cells &boundary &middles &remarks;
      }
    };



    /** Elements of a mesh file with deal.II's order of vertices. */
    template <int structdim>
    std::vector<CellData<structdim>>
    cell_data(const std::vector<MeshElement>            &elements,
              const std::map<std::size_t, unsigned int> &vertex_of)
    {
      std::vector<CellData<structdim>> all(elements.size());
      for (std::size_t i = 0; i < elements.size(); ++i)
        {
          for (const unsigned int v : GeometryInfo<structdim>::vertex_indices())
            all[i].vertices[GeometryInfo<structdim>::ucd_to_deal[v]] =
              vertex_of.at(elements[i].nodes[v]);
          all[i].material_id = elements[i].group; // or boundary_id: a union
        }
      return all;
    }



    template <int dim>
    CoarseMesh<dim>
    read_gmsh(const std::string &file_name, const NamedGroups &named)
    {
      const GmshMesh mesh     = read_gmsh_file(file_name, dim, named);
      const auto     point_of = [&](const std::size_t number) {
        Point<dim> point;
        for (unsigned int d = 0; d < dim; ++d)
          point[d] = mesh.nodes.at(number)[d];
        return point;
      };
      std::map<std::size_t, unsigned int> vertex_of;
      for (const MeshElement &cell : mesh.cells)
        for (const std::size_t node : cell.nodes)
          vertex_of[node] = 0;
      CoarseMesh<dim> coarse;
      for (auto &[number, vertex] : vertex_of)
        {
          vertex = coarse.vertices.size();
          coarse.vertices.push_back(point_of(number));
        }
      coarse.cells    = cell_data<dim>(mesh.cells, vertex_of);
      coarse.boundary = cell_data<dim - 1>(mesh.boundary, vertex_of);
      // Vertices are in the order of the nodes.
      for (const auto &[ends, middle] : mesh.middles)
        coarse.middles[{vertex_of.at(ends.first), vertex_of.at(ends.second)}] =
          point_of(middle);
      coarse.remarks = mesh.remarks;
      return coarse;
    }



    /** Creates the triangulation from a coarse mesh like deal.II's GridIn. */
    template <int dim>
    void
    create(CoarseMesh<dim> mesh, Triangulation<dim> &triangulation)
    {
      SubCellData sub_cells;
      if constexpr (dim == 2)
        sub_cells.boundary_lines = mesh.boundary;
      else
        sub_cells.boundary_quads = mesh.boundary;
      GridTools::invert_cells_with_negative_measure(mesh.vertices, mesh.cells);
      GridTools::consistently_order_cells(mesh.cells);
      triangulation.create_triangulation(mesh.vertices, mesh.cells, sub_cells);
      set_curved_edges(mesh.middles, triangulation);
    }



    /** Reads a mesh file into a serial triangulation: a distributed one does
     * not survive triangles. Collective; one rank reads a Gmsh file for all.
     * @return remarks for the log. */
    template <int dim>
    std::vector<std::string>
    read_mesh(const GeometryParameters &parameters,
              const NamedGroups        &named,
              const MPI_Comm            communicator,
              Triangulation<dim>       &triangulation)
    {
      const std::string &file_name = parameters.file_to_read();
      const std::string  where =
        "[Geometry] Mesh file = " + parameters.mesh_file + ": ";
      const bool is_gmsh = Text::suffix(file_name) == ".msh";
      const bool is_reader =
        Utilities::MPI::this_mpi_process(communicator) == 0;
      CoarseMesh<dim> mesh;
      try
        {
          collectively(communicator, [&]() {
            if (is_gmsh && is_reader)
              mesh = read_gmsh<dim>(file_name, named);
            else if (!is_gmsh)
              try
                {
                  GridIn<dim>(triangulation).read(file_name);
                }
              catch (const std::exception &)
                {
                  throw SceneError(
                    "deal.II knows no format with this file name extension, or "
                    "the file has another format; convert it to a Gmsh file: "
                    "crevasse mesh " +
                    file_name + " mesh.msh.");
                }
          });
          mesh = Utilities::MPI::broadcast(communicator, mesh);
          if (is_gmsh)
            create(mesh, triangulation);
        }
      catch (const std::exception &error)
        {
          throw SceneError(
            where + "cannot be read as a mesh: " + reason(error) +
            "\nAllowed: " +
            (dim == 2 ? "triangles and quadrilaterals in the plane x-y"
                      : "tetrahedra, wedges and hexahedra") +
            ", of first or second order, in a Gmsh file (.msh) or in one of "
            "another program (.inp, .unv, .med, .e, .exo, .vtk, .vtu).");
        }
      mesh.remarks.push_back(require_convex_cells(triangulation, where));
      return mesh.remarks;
    }



    template <int dim>
    double
    n_cells_of_plate(const GeometryParameters &parameters)
    {
      double n = 1.;
      for (const unsigned int n_along : subdivisions(parameters, dim))
        n *= n_along;
      return n;
    }
  } // namespace



  template <int dim>
  void
  make_mesh(const GeometryParameters                      &parameters,
            Triangulation<dim>                            &mesh,
            const std::function<void(const CellCounts &)> &on_cell_count,
            const NamedGroups                             &named)
  {
    const bool               is_file = parameters.shape == Shape::mesh_file;
    Triangulation<dim>       from_file;
    std::vector<std::string> remarks;
    if (is_file)
      remarks =
        read_mesh(parameters, named, mesh.get_communicator(), from_file);
    if (on_cell_count)
      {
        const double n = is_file ? from_file.n_active_cells()
                                 : n_cells_of_plate<dim>(parameters);
        on_cell_count(
          {n, n * std::pow(2., dim * parameters.refinements), remarks});
      }
    if (is_file)
      mesh.copy_triangulation(from_file);
    else
      {
        make_plate(parameters, mesh);
        // deal.II's colours of the parts are not materials.
        for (const auto &cell : mesh.cell_iterators())
          cell->set_material_id(0);
      }
    mesh.refine_global(parameters.refinements);
  }



  template decltype(make_mesh<2>) make_mesh<2>;
  template decltype(make_mesh<3>) make_mesh<3>;
} // namespace Crevasse
