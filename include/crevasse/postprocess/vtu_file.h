// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_vtu_file_h
#define crevasse_postprocess_vtu_file_h

#include <cstdint>
#include <string>
#include <vector>

namespace Crevasse
{
  /** Numbers at the points of a grid. */
  struct PointArray
  {
    std::string name;
    /** 1, 3 of a vector, or 6 of a symmetric tensor: XX, YY, ZZ, XY, YZ, XZ. */
    unsigned int       n_components;
    std::vector<float> values;
  };

  /**
   * A grid for ParaView, on which any number of files are written. Cells may
   * share their points, so that files are a quarter (in space an eighth) of
   * those with points for each cell. They are compressed fast: zlib's level 9,
   * deal.II's default, takes twenty times as long for 5 % of the size.
   */
  class VtuGrid
  {
  public:
    /** @param points three coordinates of each.
     * @param corners of all cells, in VTK's order.
     * @param n_corners of a cell: 4 of a quadrilateral, 8 of a hexahedron.
     * @param materials of the cells, for "material_id". */
    VtuGrid(const std::vector<float>        &points,
            const std::vector<std::int32_t> &corners,
            const unsigned int               n_corners,
            const std::vector<std::int32_t> &materials);

    /** @throw FileError */
    void
    write(const std::string             &file_name,
          const double                   time,
          const std::vector<PointArray> &arrays) const;

  private:
    std::string text; ///< of points, cells and their materials
  };

  /** A .pvtu file, which makes one grid of those of all processes. The arrays'
   * names matter alone. @throw FileError */
  void
  write_pvtu(const std::string              &file_name,
             const std::vector<std::string> &pieces,
             const std::vector<PointArray>  &arrays);
} // namespace Crevasse

#endif
