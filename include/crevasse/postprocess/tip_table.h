// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_tip_table_h
#define crevasse_postprocess_tip_table_h

#include <crevasse/base/csv_table.h>
#include <crevasse/base/series_extremes.h>
#include <crevasse/crack_tip/growth_direction.h>
#include <crevasse/parameters/units.h>
#include <crevasse/postprocess/crack_tip_analysis.h>
#include <crevasse/postprocess/lip_closure.h>
#include <crevasse/postprocess/mission_table.h>
#include <crevasse/postprocess/tip_errors.h>
#include <crevasse/time/period_observer.h>

namespace Crevasse
{
  /** Objects common to the tables of all tips of a run. */
  struct TipContext
  {
    const StepList                   &steps;
    const std::optional<SecularFlow> &flow;    ///< flow, if found
    LipClosure<2>                    *closure; ///< closure, or null
    const Units                       units;
    Log                              &log;
  };

  /** Results at a crack tip at an instant. Those of mode II and the directions
   * of growth are 0 for a tip with one lip. */
  struct TipValues
  {
    /** Values for modes I and II. */
    std::array<double, 2> intensity, error, of_singular_functions;
    double                of_stress; ///< StressIntensity::Estimate::of_stress
    double                release_rate;
    double                energy;       ///< strain energy of the body
    double                growth_angle; ///< growth direction in degrees
    /** K_I or, for two lips, TipElasticity::equivalent(). */
    double equivalent;
    double t_stress, t_stress_error;
    double angle_of_release; ///< direction of largest G in degrees
    double temperature;
    double contact_zone; ///< StressIntensity::Estimate::contact_zone
  };

  /**
   * crack_tip.csv, or crack_tip_N.csv of the N-th tip with two lips: K and
   * quantities derived from it at each accepted step, and the summary of the
   * tip.
   *
   * K_I_singular and K_II_singular are the coefficients of the singular
   * functions of an elastic body. The errors are those of
   * StressIntensity::Estimate or, if larger, those of MeshErrors; that of K_I
   * up to four times this if integral and fit differ by more. They are not
   * bounds.
   */
  class TipTable : public PeriodObserver
  {
  public:
    /** References must outlive the TipTable. Collective.
     *
     * @param mesh_errors of the tip.
     * @param table with the columns(). */
    TipTable(const CrackTipAnalysis &analysis,
             const MeshErrors       &mesh_errors,
             const TipContext       &context,
             CsvTable              &&table);

    static std::vector<std::string>
    columns(const CrackTipAnalysis &analysis);

    void
    observe(const Sample &sample) override;

    void
    between(const Sample &sample) override;

    /** Adds "crack_tip", or an entry of "crack_tips", to the summary, and a few
     * lines to the log. */
    void
    summarise(Summary &summary) override;

    void
    serialize(StateArchive &archive) override
    {
      archive.section("crack tip");
      PeriodObserver::serialize(archive);
      archive.common_list(of_last_period);
    }

    /** K and growth of the last period. @param number of the tip, after the
     * names; or none. */
    std::vector<PeriodNumber>
    period_numbers(const std::string &number) const
    {
      const auto K = [](const TipValues &v) { return v.intensity[0]; };
      const CrackTipParameters &law = analysis.scene.crack_tip;
      std::vector<PeriodNumber> all = {
        {"K_I_largest" + number, [this, K] { return largest(K); }},
        {"K_I_smallest" + number, [this, K] { return range(K).first; }}};
      // The lip is only looked at in the last period.
      if (law.growth_law != GrowthLawType::none &&
          law.growth_range == GrowthRange::whole &&
          law.creep_parameter != CreepParameter::C_of_t)
        all.emplace_back("da_dN" + number, [this, &law] {
          return growth_over_period(law, history()).total();
        });
      return all;
    }

    /** Intensities at the tip at the last observed sample. */
    const TipValues &
    latest() const
    {
      return of_last_period.back();
    }

  private:
    using Number = std::function<double(const TipValues &)>;

    void
    clear() override
    {
      of_last_period.clear();
    }

    void
    insert(const Sample &sample, const std::size_t k) override
    {
      of_last_period.insert(of_last_period.begin() + k, evaluate(sample));
    }

    TipValues
    evaluate(const Sample &sample) const;

    /** Least and largest value of a number over the last period, also between
     * its instants. */
    std::pair<double, double>
    range(const Number &number) const;

    /** Largest of the values of a number at the instants, such as an error. */
    double
    largest_value(const Number &number) const;

    double
    largest(const Number &number) const
    {
      return range(number).second;
    }

    /** Extremes of a number over the last period, for the summary. */
    Summary
    extremes(const Number &number) const
    {
      const auto [least, most] = range(number);
      return {{"largest", most}, {"smallest", least}};
    }

    /** Adds K of a mode and its error to the summary and the log. */
    void
    summarise_intensity(const unsigned int mode, Summary &tip) const;

    /** Adds T to the summary. */
    void
    summarise_t_stress(Summary &tip) const;

    /** Adds what only tips between two materials have to the summary of the
     * tip, and their contact zone to the log. */
    void
    summarise_interface(const InterfaceTip &interface,
                        Summary            &summary,
                        Summary            &tip) const;

    /** Adds what only tips with two lips have to the summary. */
    void
    summarise_two_modes(Summary &tip) const;

    /** Warns if K is uncertain. */
    void
    warn_of_uncertainty(Summary &summary) const;

    /** Warns if K_II/K_I changes over the period: then the range of no single
     * intensity is equivalent. */
    void
    warn_of_turning(Summary &summary) const;

    /** Range of one intensity that is equivalent to this range of K_I and the
     * range of K_II. */
    double
    equivalent_range(const double of_opening) const
    {
      const auto [left, right] =
        range([](const TipValues &v) { return v.intensity[1]; });
      return analysis.intensity.elasticity(0.).equivalent(of_opening,
                                                          right - left);
    }

    /** What growth depends on in the last period, except C(t). */
    TipHistory
    history() const
    {
      TipHistory history;
      history.instants = instants;
      for (const TipValues &values : of_last_period)
        history.intensity.push_back(values.equivalent);
      const auto [least, most] =
        range([](const TipValues &v) { return v.intensity[0]; });
      const auto worst = SeriesExtremes(instants, history.intensity).largest;
      history.largest  = std::max(worst.value, 0.);
      if (analysis.has_temperature)
        {
          for (const TipValues &values : of_last_period)
            history.temperatures.push_back(values.temperature);
          history.temperature =
            analysis.temperature(context.steps.within_period(worst.instant));
        }
      history.range =
        equivalent_range(std::max(most, 0.) - std::max(least, 0.));
      history.effective_range = history.range;
      history.c_star          = analysis.c_star(context.flow);
      return history;
    }

    /** Adds ΔK, K_op, ΔK_eff, C* and growth to the summary. */
    void
    summarise_growth(Summary &summary, Summary &tip) const;

    /** Adds the time until creep is steady, and warns if the crack grows far
     * meanwhile, so that C* does not describe its growth. */
    void
    judge_transition(const TipHistory &history,
                     Summary          &summary,
                     Summary          &tip) const;

    /** Adds the opening intensity K_op (Elber, ASTM STP 486, 1971), ΔK_eff, and
     * the fraction of the period with a closed lip, and sets ΔK_eff of the
     * history. Returns the end of a line for the log. Collective. */
    std::string
    summarise_closure(TipHistory &history, Summary &tip) const;

    const CrackTipAnalysis &analysis;
    const TipContext        context;
    const CrackTip         &place;
    const std::string       title; ///< beginning of lines in the log
    const MeshErrors        mesh_errors;
    CsvTable                table;
    std::vector<TipValues>  of_last_period;
  };
} // namespace Crevasse

#endif
