// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_vtu_file_h
#define crevasse_postprocess_vtu_file_h

#include <cstdint>
#include <string>
#include <vector>

namespace Crevasse
{
  /** Values at the points of a grid. */
  struct PointArray
  {
    std::string name;
    /** Components: 1, a vector's 3, or a tensor's XX, YY, ZZ, XY, YZ, XZ. */
    unsigned int       n_components;
    std::vector<float> values;
  };

  /**
   * A grid for ParaView, for any number of files. Cells share points, which
   * tell readers what hangs together, also at a closed crack. deal.II's DataOut
   * gives each cell points of its own, in files 1.3 to 1.4 times as large, and
   * has no symmetric tensor of a plane body with the component 33. Files are
   * compressed fast: zlib's level 9 takes twenty times as long for 5 % of the
   * size.
   */
  class VtuGrid
  {
  public:
    /** @param points three coordinates of each point.
     * @param corners points of all cells, in VTK's order.
     * @param n_corners of a cell: 4 of a quadrilateral, 8 of a hexahedron.
     * @param materials of the cells, for "material_id". */
    VtuGrid(const std::vector<float>        &points,
            const std::vector<std::int32_t> &corners,
            const unsigned int               n_corners,
            const std::vector<std::int32_t> &materials);

    /** Writes a .vtu file with the arrays. @throw FileError */
    void
    write(const std::string             &file_name,
          const double                   time,
          const std::vector<PointArray> &arrays) const;

  private:
    std::string text; ///< points, cells and materials
  };

  /** Writes a .pvtu file, which joins the grids of all processes. Only the
   * names of @p arrays matter. @throw FileError */
  void
  write_pvtu(const std::string              &file_name,
             const std::vector<std::string> &pieces,
             const std::vector<PointArray>  &arrays);
} // namespace Crevasse

#endif
