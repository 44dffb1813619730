// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_kernels_cell_kernels_h
#define crevasse_kernels_cell_kernels_h

#include <cstddef>

namespace Crevasse
{
  /** Properties of the elements that a kernel is compiled for. */
  struct CellKind
  {
    unsigned int dim;
    unsigned int degree;   ///< degree 1 or 2
    unsigned int n_points; ///< Gauss points in each direction
    bool         mean_volume;
    bool rings; ///< whether plane cells are rings of a body of revolution
  };

  /** Geometry of a batch of cells: ∂ξ_d/∂x_e of the unit cell's coordinates ξ,
   * the ratio of volumes and, for rings, 1/x₁. The numbers of the lanes are
   * adjacent. */
  struct BatchGeometry
  {
    enum class Shape
    {
      brick,          ///< only ∂ξ_d/∂x_d, constant in a cell
      parallelepiped, ///< ∂ξ_d/∂x_e constant in a cell
      other           ///< ∂ξ_d/∂x_e at each point
    };

    std::size_t start; ///< offset in the numbers of all batches
    Shape       shape;
  };

  /** Cells of one kind in batches, with one cell in each lane of a batch. */
  template <typename Real>
  struct CellBatches
  {
    unsigned int n_cells;

    /** Index of the first component in a vector for each node of each cell, x
     * fastest; lanes without a cell repeat the last cell. */
    const unsigned int  *first_indices;
    const BatchGeometry *geometries;
    const Real          *geometry_values;
  };

  /** Moduli K at the points of batches of cells. */
  template <typename Real>
  struct BatchModuli
  {
    bool is_isotropic; ///< values: λ and μ; otherwise the lower triangle of K
    std::size_t per_batch; ///< stride between batches; 0: one K for all
    std::size_t per_point; ///< stride between points; 0: one K for a cell
    const Real *values;    ///< moduli, with the numbers of the lanes adjacent
  };

  /**
   * Loops over batches of cells, with one cell in each lane of the CPU's
   * registers and sum factorisation (Kronbichler and Kormann, Computers &
   * Fluids 63, 2012). The caller applies constraints.
   *
   * There is a set of kernels for each width of registers, compiled with the
   * instructions for this width; the widest that the CPU has is chosen when the
   * program runs. None of these instructions gets into other parts of the
   * program: a file compiled with them includes this header and those of the
   * loops, whose functions are all in an unnamed namespace. This header has no
   * inline function with external linkage, of which the linker would keep one
   * copy for the whole program. For the same reason the lanes of deal.II are
   * not used: their width is part of the types of its headers.
   */
  template <typename Real>
  struct CellKernels
  {
    unsigned int n_lanes;

    /** Multiplies by the stiffness: result += ∫ DᵀK D v */
    void (*multiply)(const CellBatches<Real> &cells,
                     const BatchModuli<Real> &moduli,
                     const Real              *v,
                     Real                    *result);

    /** strains = D v of one batch: for each point and component the lanes. */
    void (*strains)(const CellBatches<Real> &cells,
                    const Real              *v,
                    Real                    *strains);

    /** force += ∫ Dᵀ s of one batch, for stresses in the layout of strains. */
    void (*add_transpose)(const CellBatches<Real> &cells,
                          const Real              *stresses,
                          Real                    *force);
  };

  /** Whether there are kernels for registers of so many bytes (16, 32 or 64)
   * and this CPU can execute them. */
  bool
  has_lane_width(const unsigned int bytes);

  /** Sets the register width in bytes of kernels that are chosen later. The
   * default is the widest that the CPU has, at most the environment variable
   * CREVASSE_LANE_BYTES. */
  void
  set_lane_width(const unsigned int bytes);

  /** Kernels for a kind of element with the current register width. */
  template <typename Real>
  CellKernels<Real>
  cell_kernels(const CellKind &kind);

  /** Kernels for a register width, defined in a file for each width. */
  template <unsigned int bytes, typename Real>
  CellKernels<Real>
  kernels_of_width(const CellKind &kind);

#define CREVASSE_DECLARE_KERNELS(bytes)                                      \
  template <>                                                                \
  CellKernels<double> kernels_of_width<bytes, double>(const CellKind &kind); \
  template <>                                                                \
  CellKernels<float> kernels_of_width<bytes, float>(const CellKind &kind)

  CREVASSE_DECLARE_KERNELS(16);
  CREVASSE_DECLARE_KERNELS(32);
  CREVASSE_DECLARE_KERNELS(64);

#undef CREVASSE_DECLARE_KERNELS
} // namespace Crevasse

#endif
