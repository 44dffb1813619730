// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_tip_uncertainty_h
#define crevasse_postprocess_tip_uncertainty_h

#include <crevasse/base/csv_table.h>
#include <crevasse/base/log.h>
#include <crevasse/base/summary.h>
#include <crevasse/discretisation/stress_estimator.h>
#include <crevasse/model/elastic_displacement.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/postprocess/crack_tip_analysis.h>
#include <crevasse/postprocess/lip_closure.h>

#include <deal.II/grid/grid_tools.h>

namespace Crevasse
{
  /** Of each cell, the square of the relative error of the energy norm, of the
   * elastic body at the extreme loads. Collective. */
  inline dealii::Vector<float>
  elastic_error_squares(const Scene           &scene,
                        const Body<2>         &body,
                        ContactSystemCache<2> &systems,
                        const StepList        &steps)
  {
    StressEstimator<2> estimator(body.space,
                                 body.points,
                                 body.lip,
                                 scene.loads);
    look_at_elastic_states(body,
                           systems,
                           instants_of_extreme_loads(body, steps),
                           estimator);
    return estimator.squares();
  }



  /** Of the elastic energy, in the cells around the tip that touch no other
   * material: what the mesh leaves. Collective.
   * @param squares elastic_error_squares() */
  inline double
  relative_energy_error(const CrackTipAnalysis      &analysis,
                        const dealii::Vector<float> &squares)
  {
    double sum = 0.;
    for (const auto &cell : owned_cells(analysis.body.space.mesh()))
      {
        const unsigned int i            = cell->active_cell_index();
        const auto [begin, end_of_cell] = analysis.intensity.region.reach(i);
        if (begin == 0. || end_of_cell < analysis.intensity.largest_radius())
          sum += squares(i);
      }
    return dealii::Utilities::MPI::sum(sum, analysis.body.space.communicator());
  }



  /** Prints the range of K in the last period, its error, and what K_I < 0
   * means.
   * @param title "crack tip: K_I" */
  inline void
  log_intensity(const std::string &title,
                const CrackMode    mode,
                const double       least,
                const double       largest,
                const double       error,
                Log               &log)
  {
    const double size = std::max(std::abs(least), std::abs(largest));
    log.line(
      Text::format("%s from %.5g to %.5g in the last period, estimated error "
                   "%.1g (%.2g %%)",
                   title.c_str(),
                   least,
                   largest,
                   error,
                   size > 0. ? 100. * error / size : 0.));
    if (least < -10. * error && mode == CrackMode::opening)
      log.line(
        "    negative: the stress ahead of the tip is compressive, as "
        "creep leaves it");
  }



  /** Warns if K is uncertain.
   * @param name "K_I" or what else is uncertain.
   * @param size the largest |K| of the last period, with an error.
   * @param energy the largest strain energy of the last period. */
  inline void
  warn_of_uncertainty(const CrackTipAnalysis              &analysis,
                      const std::string                   &name,
                      const StressIntensity::ModeEstimate &largest,
                      const double                         energy,
                      Summary                             &summary,
                      Log                                 &log)
  {
    // A crack that stays closed has an intensity of rounding: the density of
    // the energy tells of which size others of its length would be.
    constexpr double large = 0.1, negligible = 1e-3;
    const double     density =
      energy /
      dealii::GridTools::volume(static_cast<const dealii::Triangulation<2> &>(
        analysis.body.space.mesh()));
    const double usual =
      std::sqrt(analysis.body.law.stiffness_factor(0.) *
                analysis.intensity.elasticity(0.).modulus() * density *
                analysis.intensity.largest_radius());
    const auto [size, error] = largest;
    if (error <= large * size || size <= negligible * usual)
      return;
    const std::string warning =
      "[Crack tip] Stress intensity: " + name + " is uncertain by about " +
      Text::from_number(std::round(100. * error / size)) +
      " %; refine the mesh ([Refinement])" +
      (analysis.intensity.region.tip.two_lips
         ? ""
         : " or use [Discretisation] Singular functions");
    summary["warnings"].push_back(warning);
    log.line("  warning: " + warning);
  }



  /** What tables of K at a tip work with. */
  class TipTable : public Observer
  {
  public:
    /** References must outlive this object. Collective.
     *
     * @param error_squares elastic_error_squares()
     * @param flow none: none was found.
     * @param table with the columns(). */
    TipTable(const CrackTipAnalysis           &analysis,
             const dealii::Vector<float>      &error_squares,
             const StepList                   &steps,
             const std::optional<SecularFlow> &flow,
             CsvTable                        &&table,
             Log                              &log)
      : analysis(analysis)
      , steps(steps)
      , flow(flow)
      , log(log)
      , table(std::move(table))
      , relative_error(relative_energy_error(analysis, error_squares))
    {
    }

    /** Of the lips; null without contact. Must outlive this object. */
    const LipClosure<2> *closure = nullptr;

  protected:
    /** What lives are computed from, of a history of K.
     * @param title of the line in the log. */
    void
    summarise_closure(const TipHistory  &history,
                      const std::string &title,
                      Summary           &tip) const
    {
      Crevasse::summarise_closure(history,
                                  closure == nullptr
                                    ? nullptr
                                    : &closure->steps_of_lip_at(
                                        analysis.intensity.region.tip.position),
                                  title,
                                  tip,
                                  log);
    }

    const CrackTipAnalysis           &analysis;
    const StepList                   &steps;
    const std::optional<SecularFlow> &flow;
    Log                              &log;
    CsvTable                          table;
    const double                      relative_error; ///< of the elastic energy
  };
} // namespace Crevasse

#endif
