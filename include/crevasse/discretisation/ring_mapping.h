// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_ring_mapping_h
#define crevasse_discretisation_ring_mapping_h

#include <deal.II/fe/mapping_q.h>

namespace Crevasse
{
  /** MappingQ that, for bodies of revolution, multiplies all weights JxW by x₁,
   * the radius: integrals with a space's mapping extend over one radian of the
   * body. Only this class implements the factor. */
  template <int dim>
  class RingMapping : public dealii::MappingQ<dim>
  {
  public:
    RingMapping(const unsigned int degree, const bool has_axis)
      : dealii::MappingQ<dim>(degree)
      , has_axis(has_axis)
    {
    }

    std::unique_ptr<dealii::Mapping<dim>>
    clone() const override
    {
      return std::make_unique<RingMapping>(*this);
    }

  protected:
    using Base = dealii::MappingQ<dim>;
    using Cell = typename dealii::Triangulation<dim>::cell_iterator;
    using Data = typename dealii::Mapping<dim>::InternalDataBase;
    using Output =
      dealii::internal::FEValuesImplementation::MappingRelatedData<dim, dim>;

    dealii::UpdateFlags
    requires_update_flags(const dealii::UpdateFlags flags) const override
    {
      return Base::requires_update_flags(
        has_axis && (flags & dealii::update_JxW_values) != 0
          ? flags | dealii::update_quadrature_points
          : flags);
    }

    dealii::CellSimilarity::Similarity
    fill_fe_values(const Cell                              &cell,
                   const dealii::CellSimilarity::Similarity similarity,
                   const dealii::Quadrature<dim>           &quadrature,
                   const Data                              &data,
                   Output &output) const override
    {
      // Equal cells at different radii have different rings.
      const auto found =
        Base::fill_fe_values(cell,
                             has_axis ? dealii::CellSimilarity::none
                                      : similarity,
                             quadrature,
                             data,
                             output);
      multiply_by_radius(output);
      return found;
    }

    using Base::fill_fe_face_values;

    void
    fill_fe_face_values(const Cell                             &cell,
                        const unsigned int                      face,
                        const dealii::hp::QCollection<dim - 1> &quadrature,
                        const Data                             &data,
                        Output &output) const override
    {
      Base::fill_fe_face_values(cell, face, quadrature, data, output);
      multiply_by_radius(output);
    }

    void
    fill_fe_subface_values(const Cell                        &cell,
                           const unsigned int                 face,
                           const unsigned int                 subface,
                           const dealii::Quadrature<dim - 1> &quadrature,
                           const Data                        &data,
                           Output &output) const override
    {
      Base::fill_fe_subface_values(
        cell, face, subface, quadrature, data, output);
      multiply_by_radius(output);
    }

  private:
    void
    multiply_by_radius(Output &output) const
    {
      if (has_axis)
        for (unsigned int q = 0; q < output.JxW_values.size(); ++q)
          output.JxW_values[q] *= output.quadrature_points[q][0];
    }

    const bool has_axis;
  };
} // namespace Crevasse

#endif
