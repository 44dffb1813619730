// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_space_h
#define crevasse_discretisation_space_h

#include <crevasse/discretisation/ring_mapping.h>
#include <crevasse/discretisation/singular_shapes.h>
#include <crevasse/grid/mesh.h>
#include <crevasse/lip/lip_basis.h>
#include <crevasse/parameters/boundary_roles.h>
#include <crevasse/parameters/selections.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/hp/q_collection.h>
#include <deal.II/lac/affine_constraints.h>

#include <cstdint>
#include <memory>
#include <optional>

namespace Crevasse
{
  template <int dim>
  class CellLoops;

  /**
   * Displacement space: Q1 or Q2 elements on a distributed mesh, with the
   * linear constraints of hanging nodes, clamped parts, symmetry planes and
   * fixed points. Displacement vectors hold zeros in their constrained entries;
   * constraints.distribute() fills these for output.
   *
   * Displacement vectors end with the unknowns of LipBasis and the coefficients
   * of singular functions at the crack tip, if any. The last rank owns these;
   * they are unknowns like the others.
   */
  template <int dim>
  class Space
  {
  public:
    /**
     * @throw SceneError with all problems, if a role names a boundary id that
     * no face has, or a fixed point is not a vertex.
     *
     * @param volumetric_strain mean with degree 1, and not in plane stress.
     * @param singular_functions Singular functions, in the plane only.
     * @param lips_closed Whether lips are kept closed, for comparison.
     */
    Space(std::shared_ptr<const Mesh<dim>>    mesh,
          const unsigned int                  degree,
          const BoundaryRoles                &roles,
          const std::vector<FixedPoint<dim>> &fixed_points,
          const VolumetricStrain   volumetric_strain  = VolumetricStrain::full,
          const SingularFunctions &singular_functions = {},
          const bool               lips_closed        = false);

    /** Space without singular functions on a coarser mesh of the same body, for
     * preconditioners. Fixed points that are no vertices there move to the
     * nearest vertices, different points to different vertices. Collective.
     *
     * @return null if they do not hold the body there. */
    std::shared_ptr<const Space>
    on_coarser(std::shared_ptr<const Mesh<dim>> coarser_mesh) const;

    const Mesh<dim> &
    mesh() const
    {
      return *triangulation;
    }

    // Members set by the constructor.

    /** Mesh; spaces that share it number their dofs alike. */
    const std::shared_ptr<const Mesh<dim>> triangulation;
    const dealii::FESystem<dim>            finite_element;
    dealii::DoFHandler<dim>                dof_handler;
    /** Mapping of the degree of the elements if cells have curved edges, else
     * linear. In bodies of revolution all weights have the factor x₁:
     * integrals are over a radian. */
    const RingMapping<dim>            mapping;
    dealii::AffineConstraints<double> constraints;
    /** Constraints of degrees of freedom alone: supports and hanging nodes. */
    dealii::AffineConstraints<double> supports_and_hanging;
    /** Nodes of the lips and the unknowns of their openings. */
    LipBasis<dim>       lip;
    const BoundaryRoles roles;
    /** Volumetric part of the strain D of displacements. */
    const VolumetricStrain volumetric_strain;

    /** Exponent of length in volumes: 3 for rings, too. */
    unsigned int
    measure_dimension() const
    {
      return roles.has_axis ? dim + 1 : dim;
    }

    MPI_Comm
    communicator() const
    {
      return triangulation->get_communicator();
    }

    /** Singular functions as shape functions, or null. */
    const SingularShapes *
    singular_shapes() const
    {
      return shapes.get();
    }

    /** Number of the coefficient of the k-th singular function in a
     * displacement vector. */
    dealii::types::global_dof_index
    singular_unknown(const unsigned int k) const
    {
      return dof_handler.n_dofs() + lip.n_unknowns + k;
    }

    /** Number of unknowns: degrees of freedom of the nodes, unknowns of the
     * lips and coefficients of singular functions. */
    dealii::types::global_dof_index
    n_unknowns() const
    {
      return singular_unknown(shapes == nullptr ? 0 : shapes->size());
    }

    /** Unknowns owned by this rank, and unknowns of the cells that it sees. */
    dealii::IndexSet locally_owned_unknowns;
    dealii::IndexSet locally_relevant_unknowns;

    /** Number of unknowns without the degrees of freedom that LipBasis
     * replaces, as a measure of the work. */
    dealii::types::global_dof_index
    n_independent_unknowns() const
    {
      return n_unknowns() - lip.combinations.size();
    }

    /** Degrees of freedom of a cell, followed by the unknowns of the singular
     * functions, which are global. Constraints add those of the lips. */
    void
    get_unknowns(
      const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
      std::vector<dealii::types::global_dof_index> &indices) const;

    /** Vector of zeros for all unknowns, with ghosts for the cells that this
     * rank sees. */
    Vector
    ghosted_vector() const
    {
      return Vector(partitioner);
    }

    /** Values of a displacement at all nodes, with constraints resolved and
     * ghost values set. */
    Vector
    nodal_values(const Vector &displacement) const;

    /** Largest displacement component at the nodes, where singular functions
     * vanish. Collective. */
    double
    largest_component(const Vector &displacement) const
    {
      return nodal_values(displacement).linfty_norm();
    }

    /** Inverse of nodal_values(); constrained entries are 0. Collective. */
    Vector
    from_nodal_values(const Vector &values) const;

    /** Quadrature rules of the stiffness, at whose points the viscous strain
     * lives. The first is that of most cells: Gauss with degree + 1 points a
     * direction, with singular functions one more. Only singular functions
     * need the others: Gauss with 5 points near the tip and, for each vertex
     * of a cell, a rule for a tip there (Duffy's transformation). */
    dealii::hp::QCollection<dim> quadratures;

    /** Number of the quadrature rule of a cell. */
    unsigned int
    rule(const typename dealii::Triangulation<dim>::active_cell_iterator &cell)
      const
    {
      return rule_of_cell.empty() ? 0 : rule_of_cell[cell->active_cell_index()];
    }

    /** Quadrature rule of a cell. */
    const dealii::Quadrature<dim> &
    quadrature(const typename dealii::Triangulation<dim>::active_cell_iterator
                 &cell) const
    {
      return quadratures[rule(cell)];
    }
    const dealii::Quadrature<dim - 1> &
    face_quadrature() const
    {
      return face_rule;
    }

    /** Loops over the cells with the first rule; made when first used, and
     * shared. Collective. */
    std::shared_ptr<const CellLoops<dim>>
    cell_loops() const;

  private:
    void
    check_roles() const;
    void
    make_supports();
    void
    hold_axis();
    /** Holds clamped and displaced boundaries. */
    void
    hold_boundaries();
    void
    make_constraints(const bool lips_closed);
    /** Whether a support or hanging node makes a dof depend on others. */
    bool
    is_tied(const dealii::types::global_dof_index dof) const
    {
      const auto *entries = supports_and_hanging.get_constraint_entries(dof);
      return entries != nullptr && !entries->empty();
    }
    /** Moves fixed points to the nearest vertices whose unknowns are not tied,
     * different points to different vertices; omits points without such a
     * vertex. */
    std::vector<FixedPoint<dim>>
    at_vertices(const std::vector<FixedPoint<dim>> &fixed_points) const;
    /** Vertex nearest to a fixed point at which its components are not tied.
     * Collective. */
    std::optional<dealii::Point<dim>>
    nearest_free_vertex(const FixedPoint<dim>                 &fixed_point,
                        const std::vector<dealii::Point<dim>> &taken) const;
    void
    number_unknowns();
    void
    choose_rules();
    void
    constrain(const FixedPoint<dim> &fixed_point);

    const dealii::QGauss<dim - 1>      face_rule;
    const std::vector<FixedPoint<dim>> supports;

    std::unique_ptr<const SingularShapes> shapes; ///< singular functions
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner>
                              partitioner;  ///< layout of ghosted vectors
    std::vector<std::uint8_t> rule_of_cell; ///< rules, unless first

    mutable std::shared_ptr<const CellLoops<dim>> loops; ///< made on demand
  };
} // namespace Crevasse

#endif
