// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/text.h>
#include <crevasse/material/voigt_matrix.h>
#include <crevasse/parameters/effects.h>
#include <crevasse/simulation/common_errors.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Least dilatation of a body under uniaxial stress, as a part of its
     * strain in that direction: 1 − 2ν if isotropic.
     * @param compliances Strains, or rates of strain, of unit stresses. */
    template <int dim>
    double
    least_dilatation(const std::vector<VoigtMatrix<dim>> &compliances)
    {
      double least = 1.;
      for (const VoigtMatrix<dim> &S : compliances)
        for (unsigned int i = 0; i < 3; ++i)
          if (S[i][i] > 0.)
            least = std::min(least, (S[i][0] + S[i][1] + S[i][2]) / S[i][i]);
      return least;
    }



    /** Warns of elements that lock, since they cannot keep the volume of all of
     * their points. On coarse meshes halved cells are then as stiff. */
    template <int dim>
    void
    find_locking(const Run<dim> &run, std::vector<CommonError> &all)
    {
      const Scene &scene = run.scene;
      if (scene.discretisation.volumetric_strain == VolumetricStrain::mean ||
          (dim == 2 && scene.material.plane_state == PlaneState::plane_stress))
        return;
      // With ν = 0.48, K on 8 x 8 linear cells is a quarter too small, and its
      // error three halves of the bar; with 0.49 thrice.
      constexpr double              almost_none = 0.04;
      const auto                    material    = run.body.material.at(0.);
      std::vector<VoigtMatrix<dim>> elastic, viscous;
      for (const VoigtMatrix<dim> &K : material.stiffness->distinct())
        elastic.push_back(inverse<dim>(K));
      for (const auto &fluidity : material.fluidity)
        viscous.insert(viscous.end(),
                       fluidity->distinct().begin(),
                       fluidity->distinct().end());
      const MPI_Comm communicator = run.body.space.communicator();
      const bool is_rubber = Utilities::MPI::min(least_dilatation<dim>(elastic),
                                                 communicator) < almost_none;
      // A spring of this part of the stiffness keeps ν = 0.3 below 0.48.
      constexpr double enough = 0.09;
      const bool       flows  = scene.material.creep_law() != nullptr ||
                         (material.spring < enough &&
                          Utilities::MPI::min(least_dilatation<dim>(viscous),
                                              communicator) < almost_none);
      if (!flows && !(is_rubber && scene.discretisation.degree == 1))
        return;
      all.push_back(
        {"mesh",
         "elements lock; take Volumetric strain = mean",
         (flows ? "[Material] Viscosity = " + name_of(scene.material.viscosity)
                : "[Material]: the elastic strain nearly") +
           " preserves volume, so that elements lock: set [Discretisation] "
           "Volumetric strain = mean and Degree = 1" +
           (flows ? "" : ", or Degree = 2")});
    }



    /** A formula of the material that jumps within a cell at t = 0, or null:
     * between the corners or the centre, and still where the line between them
     * has been halved until smooth formulas do not change. */
    template <int dim>
    const Expression *
    formula_that_jumps(
      const std::vector<Expression>                               &formulas,
      const typename Triangulation<dim>::active_cell_iterator     &cell,
      const Mapping<dim>                                          &mapping,
      const std::function<double(const Expression &, Point<dim>)> &value)
    {
      constexpr double inside = 0.05, jump = 1e-3, bisections = 30;
      Point<dim>       centre;
      for (unsigned int d = 0; d < dim; ++d)
        centre[d] = 0.5;
      for (const Expression &formula : formulas)
        for (const unsigned int v : cell->vertex_indices())
          {
            Point<dim> a = centre;
            Point<dim> b =
              centre + (1. - 2. * inside) *
                         (GeometryInfo<dim>::unit_cell_vertex(v) - centre);
            const auto at = [&](const Point<dim> &unit) {
              return value(formula,
                           mapping.transform_unit_to_real_cell(cell, unit));
            };
            double     at_a = at(a), at_b = at(b);
            const auto jumps = [&]() {
              return std::abs(at_a - at_b) >
                     jump * std::max(std::abs(at_a), std::abs(at_b));
            };
            for (unsigned int k = 0; k < bisections && jumps(); ++k)
              {
                const Point<dim> middle    = a + 0.5 * (b - a);
                const double     at_middle = at(middle);
                const bool       before =
                  std::abs(at_middle - at_a) > std::abs(at_middle - at_b);
                (before ? b : a)       = middle;
                (before ? at_b : at_a) = at_middle;
              }
            if (jumps())
              return &formula;
          }
      return nullptr;
    }



    /** Warns of materials that jump within cells: quadrature puts the interface
     * somewhere else in each mesh, and by chance two meshes agree. */
    template <int dim>
    void
    find_jumps_in_cells(const Run<dim> &run, std::vector<CommonError> &all)
    {
      std::vector<Expression> formulas;
      for (const Expression &formula : material_formulas(run.scene.material))
        for (const char *variable : {"x", "y", "z", "theta"})
          if (formula.can_jump_with(variable))
            {
              formulas.push_back(formula);
              break;
            }
      const Space<dim> &space = run.body.space;
      std::string       here;
      if (!formulas.empty())
        collectively(space.communicator(), [&]() {
          for (const auto &cell : owned_cells(space.mesh()))
            if (const Expression *formula = formula_that_jumps<dim>(
                  formulas,
                  cell,
                  space.mapping,
                  [&](const Expression &f, const Point<dim> &point) {
                    return f.value(
                      Place<dim>{point,
                                 0.,
                                 run.body.temperature.value(point, 0.),
                                 cell->material_id()});
                  });
                formula != nullptr)
              {
                here = formula->parameter() + " jumps within the cell around " +
                       Text::from_point(cell->center());
                break;
              }
        });
      for (const std::string &where :
           Utilities::MPI::all_gather(space.communicator(), here))
        if (!where.empty())
          {
            all.push_back({"mesh",
                           "material jumps within cells; let cells end there",
                           where +
                             ": each mesh shifts the interface by another part "
                             "of a cell. Let cells end there, by Subdivisions "
                             "or a mesh file"});
            return;
          }
    }



    const std::string steps_miss = "steps miss a part of the loads; take more";



    template <int dim>
    void
    find_missed_loads(const Run<dim> &run, std::vector<CommonError> &all)
    {
      constexpr double      too_much = 0.5;
      const StepControlType control  = run.scene.time_integration.step_control;
      if (run.magnitudes.missed_load > too_much &&
          control != StepControlType::adaptive)
        all.push_back(
          {"time",
           steps_miss,
           Text::Message()
             << "[Time integration]: within a step the loads differ by "
             << std::lround(100. * run.magnitudes.missed_load)
             << " % of their largest value from a straight line between its "
                "ends; steps that are too few, or that end at zeros of a load, "
             << (run.integrator == nullptr ? "show" : "compute with")
             << " another load than that of the scene. "
             << (control == StepControlType::list ? "Add instants to Steps"
                                                  : "Raise Steps per period")});
    }
  } // namespace



  template <int dim>
  std::vector<CommonError>
  common_errors(const Run<dim> &run)
  {
    std::vector<CommonError> all;
    find_locking(run, all);
    find_jumps_in_cells(run, all);
    find_missed_loads(run, all);
    return all;
  }



  template <int dim>
  std::vector<CommonError>
  missed_rows(const Run<dim> &run)
  {
    std::vector<CommonError> all;
    for (const auto &[name, table] : *run.scene.tables.functions)
      {
        constexpr double    negligible = 0.01;
        TableFunction::Miss miss;
        if (table.is_called && table.is_of_time())
          miss = run.steps.missed(table);
        if (miss.difference > negligible)
          all.push_back(
            {"time",
             steps_miss,
             Text::Message()
               << "[Tables] Files = " << table.file << ": steps miss up to "
               << Text::from_number(100. * miss.difference, 3)
               << " % of the range of " << name << ", at t = " << miss.x
               << ". Raise [Time integration] Steps per period, let steps end "
                  "at rows by a column step, or set Step control = adaptive"});
      }
    return all;
  }



  template decltype(common_errors<2>) common_errors<2>;
  template decltype(common_errors<3>) common_errors<3>;
  template decltype(missed_rows<2>)   missed_rows<2>;
  template decltype(missed_rows<3>)   missed_rows<3>;
} // namespace Crevasse
