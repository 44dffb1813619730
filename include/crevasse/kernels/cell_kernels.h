// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_kernels_cell_kernels_h
#define crevasse_kernels_cell_kernels_h

#include <cstddef>

namespace Crevasse
{
  /** Which elements a kernel is for. */
  struct CellKind
  {
    unsigned int dim;
    unsigned int degree;   ///< 1 or 2
    unsigned int n_points; ///< of Gauss's rule, in each direction
    bool         mean_volume;
    bool         rings; ///< in the plane, of bodies of revolution
  };

  /** The geometry of a batch of cells: for each lane, side by side,
   * ∂ξ_d/∂x_e of the unit cell's coordinates ξ, and the volume ratio; of rings
   * 1/x₁ besides. */
  struct BatchGeometry
  {
    enum class Shape
    {
      brick,          ///< only ∂ξ_d/∂x_d, the same at all points
      parallelepiped, ///< the same at all points
      other           ///< point by point
    };

    std::size_t start; ///< among the numbers of all batches
    Shape       shape;
  };

  /** Cells of the same kind; batches of as many as there are lanes. */
  template <typename Real>
  struct CellBatches
  {
    unsigned int n_cells;

    /** For the nodes of each cell, x fastest, the index of the first component
     * in a vector; those of the last cell again for lanes without a cell. */
    const unsigned int  *first_indices;
    const BatchGeometry *geometries;
    const Real          *geometry_values;
  };

  /** K at the points of batches of cells. */
  template <typename Real>
  struct BatchModuli
  {
    bool        is_isotropic; ///< λ and μ, else the lower triangle of K
    std::size_t per_batch;    ///< numbers to the next one, 0: one K for all
    std::size_t per_point;    ///< 0: one K for a cell
    const Real *values;       ///< those of all lanes side by side
  };

  /**
   * Loops over batches of cells, in each lane of the CPU's registers one
   * cell, with sum factorisation (Kronbichler and Kormann, Computers & Fluids
   * 63, 2012). Constraints are the caller's affair.
   *
   * There are several sets of them, for registers of different width; each is
   * compiled with the instructions that these need, and the widest that the CPU
   * has is chosen when the program runs. None of these instructions gets into
   * other parts of the program: a file compiled with them includes this header
   * and those of the loops, whose functions are all in an unnamed namespace. It
   * has no inline function with external linkage, of which the linker would
   * keep one copy for the whole program. That is also why deal.II's own lanes,
   * whose width is part of the types of its headers, are not used.
   */
  template <typename Real>
  struct CellKernels
  {
    unsigned int n_lanes;

    /** result += ∫ DᵀK D v */
    void (*multiply)(const CellBatches<Real> &cells,
                     const BatchModuli<Real> &moduli,
                     const Real              *v,
                     Real                    *result);

    /** D v of one batch: for each point and component the lanes. */
    void (*strains)(const CellBatches<Real> &cells,
                    const Real              *v,
                    Real                    *strains);

    /** force += ∫ Dᵀ s of one batch, for stresses laid out likewise. */
    void (*add_transpose)(const CellBatches<Real> &cells,
                          const Real              *stresses,
                          Real                    *force);
  };

  /** Whether there are kernels for registers of so many bytes (16, 32 or 64)
   * and this CPU can execute them. */
  bool
  has_lane_width(const unsigned int bytes);

  /** What cells that are set up from now on use; at first the widest, or the
   * widest of at most so many bytes as the environment variable
   * CREVASSE_LANE_BYTES says. */
  void
  set_lane_width(const unsigned int bytes);

  /** With the width that is set. */
  template <typename Real>
  CellKernels<Real>
  cell_kernels(const CellKind &kind);

  /** Those of each width, in a file of its own. */
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
