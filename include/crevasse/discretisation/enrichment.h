// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_enrichment_h
#define crevasse_discretisation_enrichment_h

#include <crevasse/discretisation/quadrature_field.h>

#include <algorithm>

namespace Crevasse
{
  /**
   * What singular functions add to the strain operator: their strains at all
   * points, stored, and the cells near the tip, whose many points are none of
   * CellLoops and whose shape functions are stored.
   *
   * It keeps the nodal part and the coefficients of the displacement that is
   * read, or those of the force that is gathered.
   */
  class Enrichment
  {
  public:
    /** @param space must outlive this object. */
    Enrichment(const Space<2> &space, const QuadratureField<2> &points);

    /** Takes a displacement with set ghost values apart. */
    void
    read(const Vector &displacement);

    /** The values at the nodes that were read, or the forces there. */
    Vector &
    nodal_part()
    {
      return nodal;
    }

    /** Σ c_k Dφ_k for the coefficients that were read. */
    VoigtVector<2>
    strain(const std::size_t offset) const;

    /** Begins with forces of zero. */
    void
    begin_transpose();

    /** Adds ∫ Dφ_k · s of one point to the forces on the coefficients. */
    void
    add_stress(const std::size_t offset, const VoigtVector<2> &stress);

    /** Adds the forces gathered to @p force, and compresses it. */
    void
    end_transpose(Vector &force);

    /** The strain of the nodal part in the special cells: calls
     * `f(offset, strain)`. */
    template <typename Function>
    void
    for_each_special_strain(const Function &f);

    /** Adds ∫ Dᵀ s of the special cells to the nodal part. */
    template <typename Function>
    void
    add_special_transpose(const Function &stress_at);

  private:
    /** A cell whose rule is not that of most cells. */
    struct SpecialCell
    {
      std::size_t                                  offset;
      std::vector<dealii::types::global_dof_index> indices;
      /** Of each point: its weight and, for each dof, the gradient. */
      std::vector<double>               weights;
      std::vector<dealii::Tensor<1, 2>> gradients;
    };

    const Space<2>           &space;
    std::vector<unsigned int> components; ///< of the dofs of a cell
    std::vector<SpecialCell>  special_cells;
    std::vector<std::vector<VoigtVector<2>>> strains; ///< of φ_k, by point
    std::vector<double>                      weights; ///< of the points

    std::vector<double> coefficients;

    Vector              nodal; ///< with the layout of CellLoops' vectors
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
