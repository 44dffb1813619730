// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_lip_faces_h
#define crevasse_discretisation_lip_faces_h

#include <deal.II/base/point.h>
#include <deal.II/base/types.h>

#include <array>
#include <string>
#include <vector>

namespace Crevasse
{
  template <int dim>
  class Space;

  /** A face of the lips, with what its nodes contribute to them. */
  template <int dim>
  struct LipFace
  {
    struct Node
    {
      dealii::types::global_dof_index first; ///< of its degrees of freedom
      dealii::Point<dim>              point;
      double                          area; ///< ∫φ over the face
      dealii::Tensor<1, dim>          load; ///< ∫φ n, into the body
      /** The load or, on an axis, where that vanishes for quadratic φ, what it
       * is without the factor r. */
      dealii::Tensor<1, dim> inward;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &first &point &area &load &inward;
      }
    };

    /** That of the cell and the number of the face, which do not depend on how
     * many ranks there are. */
    std::array<unsigned int, 5> id;
    dealii::Point<dim>          centre;
    double                      size;
    bool                        is_crack; ///< it has a partner
    std::vector<Node>           nodes;

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &id &centre &size &is_crack &nodes;
    }

    /** The node at a place, or null. */
    const Node *
    node_at(const dealii::Point<dim> &point) const
    {
      for (const Node &node : nodes)
        if (node.point.distance(point) < tolerance * size)
          return &node;
      return nullptr;
    }

    /** Of the size of a face: as exact as coordinates in files are. */
    static constexpr double tolerance = 1e-6;
  };

  /** The lip's active faces of all ranks, in the order of their ids.
   * Collective. */
  template <int dim>
  std::vector<LipFace<dim>>
  find_lip_faces(const Space<dim> &space);

  /** Which of the points are at the same place: for each the number of its
   * partner, its own if it has none.
   * @param sizes within a millionth of which places are the same. */
  template <int dim>
  std::vector<unsigned int>
  find_partners(const std::vector<dealii::Point<dim>> &points,
                const std::vector<double>             &sizes);

  /** For an error: that the face at this place has no partner. */
  template <int dim>
  std::string
  describe_unmatched(const dealii::Point<dim> &centre);
} // namespace Crevasse

#endif
