// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/grid/coincident_faces.h>
#include <crevasse/grid/cut_cracks.h>
#include <crevasse/grid/gmsh_elements.h>
#include <crevasse/grid/gmsh_file.h>
#include <crevasse/grid/split_cells.h>
#include <crevasse/parameters/parameters.h>

#include <algorithm>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <gmsh.h>
#include <limits>
#include <sys/wait.h>
#include <unistd.h>

namespace Crevasse
{
  namespace
  {
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
     * @return the format.
     * @throw SceneError */
    double
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
        return format;
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
      return format;
    }



    /** Groups by their role. */
    std::vector<std::set<unsigned int>>
    uses_of(const BoundaryRoles &roles)
    {
      std::vector<std::set<unsigned int>> uses;
      for (const BoundaryRole &role : boundary_role_table)
        uses.push_back(roles.*role.ids);
      return uses;
    }



    /** Checks that a plane mesh lies in a plane z = const. @throw SceneError */
    void
    require_plane(const GmshMesh &mesh)
    {
      double low = std::numeric_limits<double>::max(), high = -low, size = 0.;
      for (const MeshElement &cell : mesh.cells)
        for (const std::size_t node : cell.nodes)
          {
            const auto &point = mesh.nodes.at(node);
            low               = std::min(low, point[2]);
            high              = std::max(high, point[2]);
            size              = std::max(size, point.norm());
          }
      if (high - low > 1e-6 * size)
        throw SceneError("its cells extend from z = " + Text::from_number(low) +
                         " to " + Text::from_number(high) +
                         "; turn the mesh into the plane x-y, or set "
                         "Dimension = 3 for a body in space");
    }



    GmshMesh
    read(const std::string &file_name,
         const double       format,
         const unsigned int dim,
         const NamedGroups &named)
    {
      const GmshSession session;
      // In format 2 an element has a group and an entity, which other programs
      // may not fill in; Gmsh otherwise gives entities the groups of all their
      // elements.
      gmsh::option::setNumber("Mesh.SwitchElementTags", 1);
      gmsh::open(file_name);

      GmshMesh mesh;
      mesh.entities_are_groups = format < 3.;
      std::vector<std::size_t> numbers;
      std::vector<double>      coordinates, parametric;
      gmsh::model::mesh::getNodes(numbers, coordinates, parametric);
      for (std::size_t i = 0; i < numbers.size(); ++i)
        mesh.nodes[numbers[i]] = {coordinates[3 * i],
                                  coordinates[3 * i + 1],
                                  coordinates[3 * i + 2]};
      if (dim == 2)
        read_gmsh_elements(3, dim, {}, mesh); // reports volume elements
      std::vector<std::set<unsigned int>> materials;
      for (const unsigned int material : named.materials)
        materials.push_back({material});
      mesh.cells = read_gmsh_elements(dim, dim, materials, mesh);
      if (dim == 2)
        require_plane(mesh);
      mesh.boundary =
        read_gmsh_elements(dim - 1, dim, uses_of(named.roles), mesh);
      return mesh;
    }



    /** Checks that Gmsh does not crash on a damaged file, as on 2 of 100 with
     * random changes: a child process reads the file first, silently.
     * @throw SceneError if the child crashes. */
    void
    require_that_gmsh_survives(const std::string &file_name,
                               const double       format,
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
              read(file_name, format, dim, {});
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



  GmshMesh
  read_gmsh_file(const std::string &file_name,
                 const unsigned int dim,
                 const NamedGroups &named)
  {
    const double format = check_head_and_counts(file_name);
    require_that_gmsh_survives(file_name, format, dim);
    GmshMesh mesh;
    try
      {
        mesh = read(file_name, format, dim, named);
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
        (dim == 2 ? "triangles or quadrilaterals"
                  : "tetrahedra, wedges or hexahedra") +
        ", which are the cells with Dimension = " + std::to_string(dim) +
        (mesh.boundary.empty()
           ? ""
           : std::string(". Gmsh saves only physical groups if there are any: "
                         "put the body into one too, as by Physical ") +
               (dim == 2 ? "Surface" : "Volume") + "(\"body\", 1) = {1}"));
    std::set<unsigned int> with_role;
    for (const std::set<unsigned int> &groups : uses_of(named.roles))
      with_role.insert(groups.begin(), groups.end());
    for (const std::string &remark :
         {split_cells(dim, mesh), find_coincident_faces(with_role, mesh)})
      if (!remark.empty())
        mesh.remarks.push_back(remark);
    std::set<unsigned int> cracks = named.roles.crack;
    cracks.insert(named.roles.open.begin(), named.roles.open.end());
    cut_cracks(cracks, mesh);
    check_faces(mesh.cells, with_role, mesh.boundary);
    return mesh;
  }
} // namespace Crevasse
