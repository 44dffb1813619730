// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_imposed_displacement_h
#define crevasse_discretisation_imposed_displacement_h

#include <crevasse/discretisation/nodal_functions.h>
#include <crevasse/discretisation/quadrature_field.h>
#include <crevasse/parameters/load_parameters.h>

namespace Crevasse
{
  /**
   * Displacements imposed on boundaries. The displacement is u = w + q: vectors
   * hold w, which vanishes where displacements are imposed, as at other
   * supports. q has the given values at the nodes of these boundaries and 0 at
   * all others; hanging nodes are interpolated. Its strain, which differs from
   * 0 in the cells at these boundaries only, acts as the strain −ε(q) without
   * stress. The velocity β of the secular flow likewise consists of what
   * vectors hold, and of the Displacement rate at these nodes.
   */
  template <int dim>
  class ImposedDisplacement
  {
  public:
    /** Finds nodes and strains. Collective. The space must outlive it.
     * @throw SceneError if a contact node has an imposed component along its
     * normal, or an inclined plane of symmetry has an imposed node. */
    ImposedDisplacement(const Space<dim>           &space,
                        const QuadratureField<dim> &points,
                        const LoadParameters       &loads);

    /** Values at all nodes in the cells that this rank sees. */
    using Values = std::vector<double>;

    /** Values of q + time β at an instant within the period. Collective.
     * @throw SceneError if a formula has no finite value. */
    Values
    values(const double t, const double time = 0.) const;

    /** Adds the strain of values times a factor to strains at the points of
     * this rank. */
    void
    add_strains(const Values                  &values,
                const double                   factor,
                std::vector<VoigtVector<dim>> &strains) const;

    /** Adds values to those at all nodes (Space::nodal_values()). */
    void
    add_values(const Values &values, Vector &nodal) const;

    // Value of q + time β, and of β, at a place with these parts of functions.
    double
    value(const typename NodalFunctions<dim>::Parts &parts,
          const double                               t,
          const double                               time) const;
    double
    rate(const typename NodalFunctions<dim>::Parts &parts) const;

    bool   is_on  = false; ///< whether a boundary is displaced
    bool   varies = false; ///< whether q depends on time
    bool   flows  = false; ///< whether a rate is not 0
    Values rates;          ///< β at all nodes

    /** Shape functions of the nodes; null if no boundary is displaced. */
    std::unique_ptr<const NodalFunctions<dim>> functions;

  private:
    void
    require_free_normals(const Space<dim> &space) const;
    void
    require_straight_planes(const Space<dim> &space) const;
    void
    find_strains(const Space<dim> &space, const QuadratureField<dim> &points);

    double
    value(const unsigned int node, const double t, const double time) const
    {
      return nodes[node].displacement.value(nodes[node].point, t) +
             time * rates[node];
    }

    struct Node
    {
      dealii::Point<dim> point;
      Expression         displacement;
    };

    /** Strain at a point of a displacement 1 at a node. */
    struct Strain
    {
      std::size_t      point;
      unsigned int     node;
      VoigtVector<dim> strain;
    };

    const MPI_Comm      communicator;
    std::vector<Node>   nodes;
    std::vector<Strain> strains;
    /** This rank's degrees of freedom where functions are not 0. */
    std::vector<std::pair<dealii::types::global_dof_index,
                          typename NodalFunctions<dim>::Parts>>
      places;
  };
} // namespace Crevasse

#endif
