// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_state_transfer_h
#define crevasse_discretisation_state_transfer_h

#include <crevasse/discretisation/cell_polynomials.h>
#include <crevasse/discretisation/quadrature_field.h>
#include <crevasse/discretisation/space.h>

#include <deal.II/dofs/dof_handler.h>

#include <vector>

namespace Crevasse
{
  /** What says whether a field at quadrature points has come over well. */
  template <int dim>
  struct FieldNorms
  {
    double           l2 = 0.;  ///< the root of ∫ |field|²
    VoigtVector<dim> integral; ///< of the sum over all branches
  };

  /** Collective. */
  template <int dim>
  FieldNorms<dim>
  field_norms(const Space<dim>           &space,
              const QuadratureField<dim> &points,
              const Vector               &field,
              const unsigned int          n_branches);

  /**
   * Takes displacement and viscous strain over to the mesh that another one
   * becomes. The viscous strain goes as the polynomials of its cells: divided
   * cells have the same one, joined cells the nearest one to those of their
   * parts, which conserves the integral over each cell. The displacement, from
   * which the next solution only starts, is that of the nodes; coefficients of
   * singular functions start at 0.
   */
  template <int dim>
  class StateTransfer
  {
  public:
    /** @param mesh of the space, which may be flagged already.
     * @param displacement zero in constrained entries, as everywhere.
     * @param viscous_strain of @p n_branches branches. */
    StateTransfer(Mesh<dim>                  &mesh,
                  const Space<dim>           &space,
                  const QuadratureField<dim> &points,
                  const Vector               &displacement,
                  const Vector               &viscous_strain,
                  const unsigned int          n_branches);

    /** Changes the mesh as its flags say. Whatever else depends on it must be
     * gone by then. Collective. */
    void
    adapt();

    /** The fields on the new mesh, or on another one with the same cells on
     * each rank; the displacement is zero in constrained entries. Both must be
     * zero, with the layouts of their spaces. */
    void
    take(const Space<dim>           &space,
         const QuadratureField<dim> &points,
         Vector                     &displacement,
         Vector                     &viscous_strain) const;

  private:
    Vector
    displacement_vector() const;

    Mesh<dim>              &mesh;
    CellPolynomials<dim>    polynomials;
    dealii::DoFHandler<dim> displacement_dofs;
    Vector                  nodal;
    std::vector<Vector>     branches; ///< coefficients
  };
} // namespace Crevasse

#endif
