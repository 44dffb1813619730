// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_enrichment_h
#define crevasse_discretisation_enrichment_h

#include <crevasse/discretisation/quadrature_field.h>

#include <algorithm>

namespace Crevasse
{
  /**
   * Part of the strain operator for singular functions: their strains at all
   * points, stored, and the special cells near the tip, which have many points,
   * are not in CellLoops, and whose shape functions are stored.
   *
   * Keeps the nodal part and the coefficients of the displacement that is read,
   * or of the force that is gathered.
   */
  class Enrichment
  {
  public:
    /** Computes the strains of singular functions. @p space must stay alive. */
    Enrichment(const Space<2> &space, const QuadratureField<2> &points);

    /** Splits a displacement with ghosts into nodal part and coefficients. */
    void
    read(const Vector &displacement);

    /** Displacement read at the nodes, or force at the nodes. */
    Vector &
    nodal_part()
    {
      return nodal;
    }

    /** Strain Σ c_k Dφ_k for the coefficients that were read. */
    VoigtVector<2>
    strain(const std::size_t offset) const;

    /** Sets nodal forces and forces on coefficients to zero. */
    void
    begin_transpose();

    /** Adds ∫ Dφ_k · s of one point to the forces on the coefficients. */
    void
    add_stress(const std::size_t offset, const VoigtVector<2> &stress);

    /** Adds the gathered forces to @p force, and compresses it. */
    void
    end_transpose(Vector &force);

    /** Computes the strain of the nodal part in the special cells: calls
     * `f(offset, strain)`. */
    template <typename Function>
    void
    for_each_special_strain(const Function &f);

    /** Adds ∫ Dᵀ s of the special cells to the nodal part. */
    template <typename Function>
    void
    add_special_transpose(const Function &stress_at);

  private:
    /** A cell near the tip with a quadrature rule other than the first. */
    struct SpecialCell
    {
      std::size_t                                  offset;
      std::vector<dealii::types::global_dof_index> indices;
      /** Weight of each point and, for each point and dof, the gradient. */
      std::vector<double>               weights;
      std::vector<dealii::Tensor<1, 2>> gradients;
    };

    const Space<2>           &space;
    std::vector<unsigned int> components; ///< components of the dofs of a cell
    std::vector<SpecialCell>  special_cells;
    std::vector<std::vector<VoigtVector<2>>> strains; ///< strains of φ_k
    std::vector<double>                      weights; ///< quadrature weights

    std::vector<double> coefficients;

    Vector              nodal; ///< layout of CellLoops
    std::vector<double> local_values;
  };



  template <typename Function>
  void
  Enrichment::for_each_special_strain(const Function &f)
  {
    const unsigned int n = components.size();
    nodal.update_ghost_values();
    for (const SpecialCell &cell : special_cells)
      {
        space.constraints.get_dof_values(nodal,
                                         cell.indices.begin(),
                                         local_values.begin(),
                                         local_values.end());
        for (unsigned int q = 0; q < cell.weights.size(); ++q)
          {
            VoigtVector<2> strain;
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int d = 0; d < 2; ++d)
                strain[voigt_index<2>(components[i], d)] +=
                  local_values[i] * cell.gradients[q * n + i][d];
            f(cell.offset + q * n_stress_components<2>, strain);
          }
      }
  }



  template <typename Function>
  void
  Enrichment::add_special_transpose(const Function &stress_at)
  {
    const unsigned int n = components.size();
    for (const SpecialCell &cell : special_cells)
      {
        std::fill(local_values.begin(), local_values.end(), 0.);
        for (unsigned int q = 0; q < cell.weights.size(); ++q)
          {
            const VoigtVector<2> stress =
              cell.weights[q] *
              stress_at(cell.offset + q * n_stress_components<2>);
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int d = 0; d < 2; ++d)
                local_values[i] += stress[voigt_index<2>(components[i], d)] *
                                   cell.gradients[q * n + i][d];
          }
        space.constraints.distribute_local_to_global(local_values.begin(),
                                                     local_values.end(),
                                                     cell.indices.begin(),
                                                     nodal);
      }
  }
} // namespace Crevasse

#endif
