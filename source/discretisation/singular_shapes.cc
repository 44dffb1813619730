// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/singular_shapes.h>

#include <deal.II/base/function.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values_extractors.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/numerics/vector_tools.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {



    /** ψ in the coordinates of the mesh. */
    class GlobalField : public Function<2>
    {
    public:
      GlobalField(const CrackTip &tip, const PolarField &field)
        : Function<2>(2)
        , tip(tip)
        , field(field)
      {
      }

      void
      vector_value(const Point<2>         &point,
                   dealii::Vector<double> &values) const override
      {
        const Tensor<1, 2> psi =
          tip.global(field.displacement(tip.local(point)));
        for (unsigned int d = 0; d < 2; ++d)
          values[d] = psi[d];
      }

    private:
      const CrackTip   &tip;
      const PolarField &field;
    };
  } // namespace



  SingularShapes::SingularShapes(const SingularFunctions &functions,
                                 const Mapping<2>        &mapping,
                                 const DoFHandler<2>     &dof_handler)
    : singular_functions(functions)
  {
    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
    AffineConstraints<double> hanging_nodes(relevant);
    DoFTools::make_hanging_node_constraints(dof_handler, hanging_nodes);
    hanging_nodes.close();
    interpolated.reserve(functions.fields.size()); // copies lose ghost values
    for (const PolarField &field : functions.fields)
      {
        interpolated.emplace_back(dof_handler.locally_owned_dofs(),
                                  relevant,
                                  dof_handler.get_communicator());
        VectorTools::interpolate(mapping,
                                 dof_handler,
                                 GlobalField(functions.tip, field),
                                 interpolated.back());
        hanging_nodes.distribute(interpolated.back());
        interpolated.back().update_ghost_values();
      }
  }



  unsigned int
  SingularShapes::size() const
  {
    return singular_functions.fields.size();
  }



  void
  SingularShapes::values(const unsigned int         k,
                         const FEValuesBase<2>     &values,
                         std::vector<Tensor<1, 2>> &result) const
  {
    result.resize(values.n_quadrature_points);
    values[FEValuesExtractors::Vector(0)].get_function_values(interpolated[k],
                                                              result);
    const CrackTip &tip = singular_functions.tip;
    for (const unsigned int q : values.quadrature_point_indices())
      result[q] = tip.global(singular_functions.fields[k].displacement(
                    tip.local(values.quadrature_point(q)))) -
                  result[q];
  }



  void
  SingularShapes::gradients(const unsigned int         k,
                            const FEValuesBase<2>     &values,
                            std::vector<Tensor<2, 2>> &result) const
  {
    result.resize(values.n_quadrature_points);
    values[FEValuesExtractors::Vector(0)].get_function_gradients(
      interpolated[k], result);
    const CrackTip    &tip      = singular_functions.tip;
    const Tensor<2, 2> to_local = tip.to_local();
    for (const unsigned int q : values.quadrature_point_indices())
      result[q] = transpose(to_local) *
                    singular_functions.fields[k].gradient(
                      tip.local(values.quadrature_point(q))) *
                    to_local -
                  result[q];
  }
} // namespace Crevasse
