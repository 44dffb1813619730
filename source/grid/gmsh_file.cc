// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/grid/cut_cracks.h>
#include <crevasse/grid/gmsh_file.h>

#include <algorithm>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <gmsh.h>
#include <sys/wait.h>
#include <unistd.h>

namespace Crevasse
{
  namespace
  {
    /** Reads the middle nodes of the edges of an element of second order. If
     * several nodes have the same position, as where lips with separate nodes
     * meet at a front, one of them is stored: only its position matters. */
    void
    read_middles(const MeshElement              &element,
                 const std::vector<std::size_t> &all_nodes,
                 GmshMesh                       &mesh)
    {
      // Vertices of each edge, in Gmsh's order of the middle nodes.
      const std::size_t n    = element.nodes.size();
      const std::string ends = n == 2   ? "01"
                               : n == 4 ? "01122330"
                                        : "010304121523263745475667";
      for (std::size_t e = 0; 2 * e < ends.size(); ++e)
        {
          const std::size_t middle = all_nodes[n + e];
          const EdgeNodes   edge =
            std::minmax(element.nodes[ends[2 * e] - '0'],
                        element.nodes[ends[2 * e + 1] - '0']);
          const auto &place = mesh.nodes.at(middle);
          const auto &other =
            mesh.nodes.at(mesh.middles.emplace(edge, middle).first->second);
          const double length =
            mesh.nodes.at(edge.first).distance(mesh.nodes.at(edge.second));
          if (place.distance(other) > 1e-6 * length)
            throw SceneError("element " + std::to_string(element.number) +
                             ": between the nodes " +
                             std::to_string(edge.first) + " and " +
                             std::to_string(edge.second) +
                             " another element has a different node, at " +
                             Text::from_point(other) + " instead of " +
                             Text::from_point(place));
        }
    }



    /** Initialises and finalises Gmsh: silent, without the user's options. */
    class GmshSession
    {
    public:
      GmshSession()
      {
        gmsh::initialize(0, nullptr, false);
        gmsh::option::setNumber("General.Terminal", 0);
      }

      GmshSession(const GmshSession &) = delete;

      ~GmshSession()
      {
        gmsh::finalize();
      }
    };



    /** Checks the head and the counts of a Gmsh file. Gmsh runs a file without
     * this head as a program of its language, and in format 4 overruns its
     * arrays if a file has more nodes or elements than it announces.
     * @throw SceneError */
    void
    check_head_and_counts(const std::string &file_name)
    {
      std::ifstream file(file_name);
      std::string   line;
      double        format    = 0.;
      int           is_binary = 0;
      std::getline(file, line);
      if (line.rfind("$MeshFormat", 0) != 0)
        throw SceneError("it does not begin with \"$MeshFormat\"");
      file >> format >> is_binary;
      if (format < 4. || is_binary != 0)
        return;
      while (std::getline(file, line))
        {
          const bool is_nodes = line.rfind("$Nodes", 0) == 0;
          if (!is_nodes && line.rfind("$Elements", 0) != 0)
            continue;
          std::size_t n_blocks = 0, n_announced = 0, n_found = 0;
          file >> n_blocks >> n_announced;
          std::getline(file, line);
          for (std::size_t block = 0; block < n_blocks && file; ++block)
            {
              int         skipped;
              std::size_t n = 0;
              file >> skipped >> skipped >> skipped >> n;
              n_found += n;
              // In format 4.1 numbers and coordinates have separate lines.
              const std::size_t n_lines = is_nodes && format > 4. ? 2 * n : n;
              for (std::size_t i = 0; i <= n_lines && file; ++i)
                std::getline(file, line);
            }
          if (file && n_found != n_announced)
            throw SceneError("there are " + std::to_string(n_found) +
                             (is_nodes ? " nodes" : " elements") + ", but " +
                             std::to_string(n_announced) + " are announced");
        }
    }



    /** Name of an entity of Gmsh in messages. */
    std::string
    name_of(const std::pair<int, int> &entity)
    {
      return (entity.first == 1   ? "curve "
              : entity.first == 2 ? "surface "
                                  : "volume ") +
             std::to_string(entity.second);
    }



    /** Physical group of an entity; 0 if it is in none. */
    unsigned int
    group_of(const std::pair<int, int> &entity)
    {
      std::vector<int> groups;
      gmsh::model::getPhysicalGroupsForEntity(entity.first,
                                              entity.second,
                                              groups);
      const std::string what = name_of(entity);
      if (groups.size() > 1)
        throw SceneError(what + " belongs to the physical groups " +
                         std::to_string(groups[0]) + " and " +
                         std::to_string(groups[1]) +
                         "; it must belong to at most one");
      if (!groups.empty() && groups[0] < 0)
        throw SceneError(what + " belongs to the physical group " +
                         std::to_string(groups[0]) +
                         "; groups must be numbered from 0");
      return groups.empty() ? 0 : groups[0];
    }



    /** Number of vertices of the element type of an entity.
     * @throw SceneError if the type is not allowed in this dimension. */
    int
    require_allowed(const std::vector<int> &types,
                    const int               element_dim,
                    const unsigned int      dim)
    {
      int n_vertices = 0;
      for (const int type : types)
        {
          std::string         name;
          int                 its_dim, order, n_nodes;
          std::vector<double> coordinates;
          gmsh::model::mesh::getElementProperties(
            type, name, its_dim, order, n_nodes, coordinates, n_vertices);
          if (n_vertices != 1 << element_dim)
            throw SceneError(only_hypercubes(dim));
          if (order > 2 || element_dim > int(dim))
            throw SceneError(
              "the element type " + std::to_string(type) + " (" + name +
              ") is not allowed with Dimension = " + std::to_string(dim) +
              "; allowed are points, lines, quadrilaterals" +
              (dim == 3 ? ", hexahedra" : "") +
              " of one order (Gmsh: Mesh.ElementOrder = 1 or 2)");
        }
      return n_vertices;
    }



    /** Reads all elements of a dimension with their vertices.
     * @param mesh Has the nodes, and gets the middles of edges.
     * @throw SceneError if there are elements other than lines, quadrilaterals
     * or hexahedra of first or second order. */
    std::vector<MeshElement>
    read_elements(const int element_dim, const unsigned int dim, GmshMesh &mesh)
    {
      std::vector<MeshElement>         all;
      std::vector<std::pair<int, int>> entities;
      gmsh::model::getEntities(entities, element_dim);
      for (const auto &entity : entities)
        {
          std::vector<int>                      types;
          std::vector<std::vector<std::size_t>> numbers, nodes;
          gmsh::model::mesh::getElements(
            types, numbers, nodes, entity.first, entity.second);
          if (types.empty())
            continue;
          const int n_vertices = require_allowed(types, element_dim, dim);
          // With mixed orders Gmsh returns one of them, but counts all.
          std::vector<std::size_t> all_numbers, no_nodes;
          gmsh::model::mesh::preallocateElementsByType(
            types[0], true, false, all_numbers, no_nodes, entity.second);
          if (all_numbers.size() > numbers[0].size())
            throw SceneError(name_of(entity) +
                             " has elements of first and of second order; all "
                             "must have one (Gmsh: Mesh.ElementOrder = 1 or "
                             "2)");
          const unsigned int group = group_of(entity);
          const std::size_t  n     = nodes[0].size() / numbers[0].size();
          for (std::size_t i = 0; i < numbers[0].size(); ++i)
            {
              const auto begin = nodes[0].begin() + i * n;
              all.push_back(
                {numbers[0][i], group, {begin, begin + n_vertices}});
              if (std::set<std::size_t>(begin, begin + n).size() < n)
                throw SceneError("element " + std::to_string(numbers[0][i]) +
                                 ": a node occurs twice");
              if (n > all.back().nodes.size())
                read_middles(all.back(), {begin, begin + n}, mesh);
            }
        }
      std::stable_sort(all.begin(),
                       all.end(),
                       [](const MeshElement &a, const MeshElement &b) {
                         return a.number < b.number;
                       });
      return all;
    }



    GmshMesh
    read(const std::string &file_name, const unsigned int dim)
    {
      const GmshSession session;
      gmsh::open(file_name);

      GmshMesh                 mesh;
      std::vector<std::size_t> numbers;
      std::vector<double>      coordinates, parametric;
      gmsh::model::mesh::getNodes(numbers, coordinates, parametric);
      for (std::size_t i = 0; i < numbers.size(); ++i)
        mesh.nodes[numbers[i]] = {coordinates[3 * i],
                                  coordinates[3 * i + 1],
                                  coordinates[3 * i + 2]};
      if (dim == 2)
        read_elements(3, dim, mesh); // reports volume elements
      mesh.cells    = read_elements(dim, dim, mesh);
      mesh.boundary = read_elements(dim - 1, dim, mesh);
      return mesh;
    }



    /** Checks that Gmsh does not crash on a damaged file, as on 2 of 100 with
     * random changes: a child process reads the file first, silently.
     * @throw SceneError if the child crashes. */
    void
    require_that_gmsh_survives(const std::string &file_name,
                               const unsigned int dim)
    {
      const pid_t child = fork();
      if (child == 0)
        {
          for (const int sign : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
            std::signal(sign, SIG_DFL); // MPI would print the stack
          dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
          try
            {
              read(file_name, dim);
            }
          catch (...) // the parent reports it
            {
            }
          _exit(0);
        }
      int status = 0;
      if (child > 0 && waitpid(child, &status, 0) == child &&
          WIFSIGNALED(status))
        throw SceneError(
          "Gmsh crashes while it reads the file, which is probably damaged: "
          "write it again");
    }
  } // namespace



  std::string
  only_hypercubes(const unsigned int dim)
  {
    return Text::format(
      "the mesh has %s are allowed (Gmsh: Mesh.SubdivisionAlgorithm = %u).",
      dim == 2 ? "triangles; only quadrilaterals"
               : "tetrahedra or other cells; only hexahedra",
      dim - 1);
  }



  GmshMesh
  read_gmsh_file(const std::string            &file_name,
                 const unsigned int            dim,
                 const std::set<unsigned int> &cracks)
  {
    check_head_and_counts(file_name);
    require_that_gmsh_survives(file_name, dim);
    GmshMesh mesh;
    try
      {
        mesh = read(file_name, dim);
      }
    catch (const std::string &message) // Gmsh throws strings
      {
        throw SceneError("Gmsh says: " + message);
      }
    catch (const std::bad_alloc &)
      {
        throw SceneError(
          "it announces more nodes or elements than memory holds");
      }
    if (mesh.cells.empty())
      throw SceneError(
        std::string("there are no ") +
        (dim == 2 ? "quadrilaterals" : "hexahedra") +
        ", which are the cells with Dimension = " + std::to_string(dim) +
        (mesh.boundary.empty()
           ? ""
           : std::string(". Gmsh saves only physical groups if there are any: "
                         "put the body into one too, as by Physical ") +
               (dim == 2 ? "Surface" : "Volume") + "(\"body\", 1) = {1}"));
    cut_cracks(cracks, mesh);
    check_faces(mesh.cells, mesh.boundary);
    return mesh;
  }
} // namespace Crevasse
