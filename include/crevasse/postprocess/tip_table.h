// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_tip_table_h
#define crevasse_postprocess_tip_table_h

#include <crevasse/base/csv_table.h>
#include <crevasse/base/format.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/stress_estimator.h>
#include <crevasse/model/elastic_displacement.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/postprocess/crack_tip_analysis.h>
#include <crevasse/postprocess/lip_closure.h>

#include <deal.II/grid/grid_tools.h>

namespace Crevasse
{
  /** Squared relative error of the energy norm of each cell, for the elastic
   * body at the extreme loads. Collective. */
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



  /** Relative error of the elastic energy by the mesh, in the cells around the
   * tip that touch no other material. Collective.
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



  /** Objects common to the tables of all tips of a run. */
  struct TipContext
  {
    const StepList                   &steps;
    const std::optional<SecularFlow> &flow;    ///< flow, if found
    LipClosure<2>                    *closure; ///< closure, or null
    Log                              &log;
  };



  /** A table of K at a tip with a row for each accepted step, and the summary
   * of the tip.
   *
   * @tparam Values numbers of a step, with the strain energy. */
  template <typename Values>
  class TipTable : public Observer
  {
  public:
    /** References must outlive the TipTable. Collective.
     *
     * @param error_squares elastic_error_squares()
     * @param table with the columns(). */
    TipTable(const CrackTipAnalysis      &analysis,
             const dealii::Vector<float> &error_squares,
             const TipContext            &context,
             CsvTable                   &&table)
      : analysis(analysis)
      , context(context)
      , table(std::move(table))
      , relative_error(relative_energy_error(analysis, error_squares))
    {
    }

    void
    observe(const Sample &sample) override
    {
      if (sample.step == 0)
        instants.clear(), of_last_period.clear();
      before_jump(sample);
      std::vector<double> row = numbers_of(of_last_period.back());
      row.insert(row.begin(), sample.time);
      table.add_row(row);
    }

    /** Stores the values before a jump, without a row in the table. */
    void
    before_jump(const Sample &sample) override
    {
      instants.push_back(sample.instant);
      of_last_period.push_back(evaluate(sample));
    }

    /** Values at the last observed sample. */
    const Values &
    latest() const
    {
      return of_last_period.back();
    }

    void
    serialize(StateArchive &archive) override
    {
      archive.section("crack tip");
      archive.common(instants);
      archive.common_list(of_last_period);
    }

  protected:
    virtual Values
    evaluate(const Sample &sample) const = 0;

    /** Adds the instants within steps at which the lip opens or closes: K has
     * kinks there. Collective. */
    void
    add_changes_of_lip()
    {
      if (context.closure == nullptr || !context.closure->failure.empty())
        return;
      const std::vector<LipMoment> lip =
        context.closure->lip_at(analysis.intensity.region.tip.position);
      for (std::size_t i = 1; i + 1 < lip.size(); ++i)
        if (const auto next = std::lower_bound(instants.begin(),
                                               instants.end(),
                                               lip[i].instant);
            *next != lip[i].instant && (lip[i].status != lip[i - 1].status ||
                                        lip[i].status != lip[i + 1].status))
          {
            of_last_period.insert(
              of_last_period.begin() + (next - instants.begin()),
              evaluate(context.closure->sample_at(lip[i].instant)));
            instants.insert(next, lip[i].instant);
          }
    }

    /** Numbers of a row of the table after t. */
    virtual std::vector<double>
    numbers_of(const Values &values) const = 0;

    /** Least and largest value of a function over the last period. */
    template <typename Function>
    std::pair<double, double>
    range(const Function &f) const
    {
      std::vector<double> all;
      for (const Values &values : of_last_period)
        all.push_back(f(values));
      const auto [least, most] = std::minmax_element(all.begin(), all.end());
      return {*least, *most};
    }

    template <typename Function>
    double
    largest(const Function &f) const
    {
      return range(f).second;
    }

    /** Extremes of a function over the last period, for the summary. */
    template <typename Function>
    Summary
    extremes(const Function &f) const
    {
      const auto [least, most] = range(f);
      return {{"largest", most}, {"smallest", least}};
    }

    /** Adds K of a mode and its error to the summary and the log. */
    template <typename Intensity, typename Error>
    void
    summarise_intensity(const CrackMode    mode,
                        const std::string &title,
                        const Intensity   &intensity,
                        const Error       &error_of,
                        Summary           &tip) const
    {
      const std::string name   = mode == CrackMode::opening ? "K_I" : "K_II";
      const auto [least, most] = range(intensity);
      const double error       = largest(error_of);
      const double size        = std::max(std::abs(least), std::abs(most));
      tip[name]                = extremes(intensity);
      tip[name + "_error"]     = error;
      context.log.line(
        title + name +
        Text::format(" from %.5g to %.5g in the last period, estimated "
                     "error %.1g (%.2g %%)",
                     least,
                     most,
                     error,
                     size > 0. ? 100. * error / size : 0.));
      if (least < -10. * error && mode == CrackMode::opening)
        context.log.line(
          "    K_I < 0: the load, or residual stress from creep, compresses "
          "the "
          "body ahead of the tip");
    }

    /** Warns if K is uncertain.
     * @param name "K_I" or another uncertain quantity.
     * @param size_of its size at a step, and @p error_of its error. */
    template <typename Size, typename Error>
    void
    warn_of_uncertainty(const std::string &name,
                        const Size        &size_of,
                        const Error       &error_of,
                        Summary           &summary) const
    {
      // A crack that stays closed has an intensity of rounding: the energy
      // density gives the usual intensity of cracks of its length.
      constexpr double                large = 0.1, negligible = 1e-3;
      const dealii::Triangulation<2> &mesh = analysis.body.space.mesh();
      const double density = largest([](const Values &v) { return v.energy; }) /
                             dealii::GridTools::volume(mesh);
      const double usual =
        std::sqrt(analysis.body.law.stiffness_factor(0.) *
                  analysis.intensity.elasticity(0.).modulus() * density *
                  analysis.intensity.largest_radius());
      const double size = largest(size_of), error = largest(error_of);
      if (error <= large * size || size <= negligible * usual)
        return;
      warn("[Crack tip] Stress intensity: " + name + " is uncertain by about " +
             Text::from_number(std::round(100. * error / size)) +
             " %; refine the mesh ([Refinement])" +
             (analysis.intensity.region.tip.two_lips
                ? ""
                : " or use [Discretisation] Singular functions"),
           summary);
    }

    void
    warn(const std::string &warning, Summary &summary) const
    {
      summary["warnings"].push_back(warning);
      context.log.line("  warning: " + warning);
    }

    /** Adds ΔK, K_op, ΔK_eff, C* and growth to the summary.
     *
     * @param opening K_I of Values.
     * @param intensity of Values, which drives growth by creep.
     * @param equivalent maps a range of K_I to the range of one intensity that
     * is equivalent to it and the ranges of other modes. */
    template <typename Opening, typename Intensity, typename Equivalent>
    void
    summarise_growth(const Opening     &opening,
                     const Intensity   &intensity,
                     const Equivalent  &equivalent,
                     const std::string &title,
                     Summary           &tip) const
    {
      const auto [least, most] = range(opening);
      tip["Delta_K"]           = equivalent(most - least);
      context.log.line(title + "Delta K " +
                       Text::from_number(equivalent(most - least), 6) +
                       (context.closure != nullptr && instants.size() > 1
                          ? summarise_closure(opening, equivalent, tip)
                          : ""));
      TipHistory history;
      history.instants = instants;
      for (const Values &values : of_last_period)
        history.intensity.push_back(intensity(values));
      history.range  = equivalent(std::max(most, 0.) - std::max(least, 0.));
      history.c_star = analysis.c_star(context.flow);
      analysis.summarise_growth(history, title, tip, context.log);
    }

    /** Adds the opening intensity K_op (Elber, ASTM STP 486, 1971), ΔK_eff, and
     * the fraction of the period with a closed lip. Returns the end of a line
     * for the log. Collective. */
    template <typename Opening, typename Equivalent>
    std::string
    summarise_closure(const Opening    &opening,
                      const Equivalent &equivalent,
                      Summary          &tip) const
    {
      const std::vector<LipMoment> lip =
        context.closure->lip_at(analysis.intensity.region.tip.position);
      const auto [wholly, partly] = closed_parts(lip);
      const auto   worst          = std::max_element(of_last_period.begin(),
                                          of_last_period.end(),
                                          [&](const auto &a, const auto &b) {
                                            return opening(a) < opening(b);
                                          });
      const double most           = opening(*worst);
      LipOpening   opens =
        last_opening(lip, instants[worst - of_last_period.begin()]);
      if (opens.why_not.empty())
        opens.why_not = context.closure->failure;
      tip["K_opening"] = tip["opening_ratio"] = Summary();
      tip["Delta_K_eff"] = wholly + partly == 0. ? tip["Delta_K"] : Summary();
      tip["closed_part"] = {{"wholly", wholly}, {"partly", partly}};
      std::string line   = ", no K_op: " + opens.why_not;
      if (opens.why_not.empty())
        {
          const auto at =
            std::find(instants.begin(), instants.end(), opens.instant);
          const double K_op = opening(of_last_period[at - instants.begin()]);
          const double effective = equivalent(most - K_op);
          tip["K_opening"]       = K_op;
          tip["Delta_K_eff"]     = effective;
          if (most > 0.)
            tip["opening_ratio"] = K_op / most;
          line = Text::format(", Delta K_eff %.6g, K_op %.4g", effective, K_op);
        }
      else
        tip["no_K_opening"] = opens.why_not;
      line += Text::format("; lip wholly closed for %.1f %% of the period",
                           100. * wholly);
      return partly < 5e-4 // prints as 0.0 %
               ? line
               : line + Text::format(", partly for %.1f %%", 100. * partly);
    }

    /** Position, method and radius of a tip for the summary. */
    Summary
    place_and_method() const
    {
      Summary tip   = place_of(analysis.intensity.region.tip);
      tip["method"] = analysis.intensity.method();
      tip["radius"] = analysis.intensity.radius();
      return tip;
    }

    const CrackTipAnalysis &analysis;
    const TipContext        context;
    CsvTable                table;
    const double            relative_error; ///< error of elastic energy
    std::vector<double>     instants;       ///< instants of last period
    std::vector<Values>     of_last_period;
  };
} // namespace Crevasse

#endif
