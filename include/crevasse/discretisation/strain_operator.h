// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_strain_operator_h
#define crevasse_discretisation_strain_operator_h

#include <crevasse/discretisation/cell_loops.h>
#include <crevasse/discretisation/enrichment.h>

namespace Crevasse
{
  /**
   * The strain operator D of the paper (formula (2) without e⁰) and its
   * transpose, the equilibrium operator, between displacements and values at
   * quadrature points. Both are matrix-free; the operation at a point is a
   * function argument, so that a field is read or written once per sweep.
   *
   * With VolumetricStrain::mean, the trace of the strain at each point is the
   * mean over its cell, and a third of the difference goes to each of the
   * components 11, 22 and 33. The transpose gives a point the mean pressure of
   * the cell instead of its own.
   *
   * With singular functions, displacements contain their coefficients, and the
   * cells near the tip are not in CellLoops: see Enrichment. Because of its
   * work space, only one thread at a time may apply the operator.
   */
  template <int dim>
  class StrainOperator
  {
  public:
    /** Makes D and Dᵀ for a space, which must outlive them. */
    StrainOperator(const Space<dim> &space, const QuadratureField<dim> &points);

    /** Gives @p displacement the layout that D reads, all zero. */
    void
    initialize(Vector &displacement) const;

    /**
     * Computes strains: calls `f(offset, strain)` for each point, with its
     * offset in a QuadratureField and the strain D q. Constrained entries of
     * @p displacement are not read but resolved.
     */
    template <typename Function>
    void
    for_each_strain(const Vector &displacement, const Function &f) const;

    /** Applies Dᵀ: force += ∫ Dᵀ s for the stress `s(offset)` at each point. */
    template <typename Function>
    void
    add_transpose(Vector &force, const Function &stress_at) const;

  private:
    static constexpr unsigned int n_components = n_stress_components<dim>;

    /** Numbers in a batch of cells: one for each lane, component and point. */
    static constexpr unsigned int most_numbers =
      8 * n_components * (dim == 2 ? 16 : 27);
    using BatchField = std::array<double, most_numbers>;

    template <typename Function>
    void
    strain_sweep(const Vector &displacement, const Function &f) const;

    template <typename Function>
    void
    transpose_sweep(Vector &force, const Function &stress_at) const;

    /** Calls f(place, offset) for the points of the cells of a batch: first
     * index of their components in a BatchField and in a QuadratureField. */
    template <typename Function>
    void
    for_each_point(const unsigned int batch, const Function &f) const;

    const Space<dim>           &space;
    const unsigned int          n_cell_points;
    std::unique_ptr<Enrichment> enrichment; ///< singular functions, or null
    const std::shared_ptr<const CellLoops<dim>> loops;
    const CellKernels<double>                  &kernels;

    std::vector<std::size_t> offsets; ///< first points of the cells
  };



  template <int dim>
  template <typename Function>
  void
  StrainOperator<dim>::for_each_strain(const Vector   &displacement,
                                       const Function &f) const
  {
    if constexpr (dim == 2)
      if (enrichment != nullptr)
        {
          displacement.update_ghost_values();
          enrichment->read(displacement);
          displacement.zero_out_ghost_values();
          const auto enriched = [&](const std::size_t       offset,
                                    const VoigtVector<dim> &strain) {
            f(offset, strain + enrichment->strain(offset));
          };
          strain_sweep(enrichment->nodal_part(), enriched);
          enrichment->for_each_special_strain(enriched);
          return;
        }
    strain_sweep(displacement, f);
  }



  template <int dim>
  template <typename Function>
  void
  StrainOperator<dim>::add_transpose(Vector         &force,
                                     const Function &stress_at) const
  {
    if constexpr (dim == 2)
      if (enrichment != nullptr)
        {
          enrichment->begin_transpose();
          const auto enriched = [&](const std::size_t offset) {
            const VoigtVector<dim> stress = stress_at(offset);
            enrichment->add_stress(offset, stress);
            return stress;
          };
          transpose_sweep(enrichment->nodal_part(), enriched);
          enrichment->add_special_transpose(enriched);
          enrichment->end_transpose(force);
          return;
        }
    transpose_sweep(force, stress_at);
  }



  template <int dim>
  template <typename Function>
  void
  StrainOperator<dim>::for_each_point(const unsigned int batch,
                                      const Function    &f) const
  {
    const unsigned int first = batch * kernels.n_lanes;
    const unsigned int end =
      std::min(first + kernels.n_lanes, loops->n_cells());
    for (unsigned int cell = first; cell < end; ++cell)
      for (unsigned int q = 0; q < n_cell_points; ++q)
        f(q * n_components * kernels.n_lanes + cell - first,
          offsets[cell] + q * n_components);
  }



  template <int dim>
  template <typename Function>
  void
  StrainOperator<dim>::strain_sweep(const Vector   &displacement,
                                    const Function &f) const
  {
    const typename CellLoops<dim>::template ResolvedValues<double> resolved(
      *loops, displacement);
    alignas(64) BatchField strains;
    for (unsigned int batch = 0; batch * kernels.n_lanes < loops->n_cells();
         ++batch)
      {
        kernels.strains(loops->template batches<double>(batch, 1),
                        displacement.begin(),
                        strains.data());
        for_each_point(batch,
                       [&](const unsigned int place, const std::size_t offset) {
                         VoigtVector<dim> strain;
                         for (unsigned int c = 0; c < n_components; ++c)
                           strain[c] = strains[place + c * kernels.n_lanes];
                         f(offset, strain);
                       });
      }
  }



  template <int dim>
  template <typename Function>
  void
  StrainOperator<dim>::transpose_sweep(Vector         &force,
                                       const Function &stress_at) const
  {
    alignas(64) BatchField stresses{};
    for (unsigned int batch = 0; batch * kernels.n_lanes < loops->n_cells();
         ++batch)
      {
        for_each_point(batch,
                       [&](const unsigned int place, const std::size_t offset) {
                         const VoigtVector<dim> stress = stress_at(offset);
                         for (unsigned int c = 0; c < n_components; ++c)
                           stresses[place + c * kernels.n_lanes] = stress[c];
                       });
        kernels.add_transpose(loops->template batches<double>(batch, 1),
                              stresses.data(),
                              force.begin());
      }
    loops->distribute(force);
  }
} // namespace Crevasse

#endif
