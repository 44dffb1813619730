// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_missions_h
#define crevasse_periodic_missions_h

#include <crevasse/periodic/averaged_periods.h>

namespace Crevasse
{
  /**
   * Computes given missions, which are periods of the motion from rest, without
   * all the periods between them: by jumps of the AveragedBody, linearly
   * implicit in the number of periods. Two jumps of k periods, r₂, and one of
   * 2k, r₁, are extrapolated to 2 r₂ − r₁, of order 2; the stress of r₂ − r₁,
   * relative to the largest so far, is held below the tolerance by the choice
   * of k. The first ten periods are marched.
   */
  template <int dim>
  class Missions
  {
  public:
    /** @param missions numbers of periods, from 1, in increasing order. */
    Missions(ObservedPeriods<dim>            &periods,
             AveragedPeriods<dim>            &averaged,
             const std::vector<unsigned int> &missions,
             const double                     tolerance)
      : periods(periods)
      , averaged(averaged)
      , missions(missions)
      , tolerance(tolerance)
    {
    }

    /** Computes the missions. @param r viscous strain at the beginning of a
     * period; on return, at the end of the last period. */
    void
    run(Vector &r)
    {
      start = middle = whole = increment = r;
      const SerializationScope part(periods.checkpointer(),
                                    [&](StateArchive &archive) {
                                      archive.at_points(r);
                                      serialize(archive);
                                    });
      Vector                   step;
      for (;;)
        {
          if (next == missions.size())
            periods.end_search();
          step = in_pair ? middle : start;
          if (!periods.begins_another(step))
            return;
          r                     = step;
          const bool is_mission = !in_pair && done + 1 == missions[next];
          averaged.compute(r, is_mission);
          double       error   = std::numeric_limits<double>::quiet_NaN();
          unsigned int mission = 0;
          if (in_pair)
            error = end_pair();
          else if (is_mission)
            {
              mission = missions[next++];
              if (next < missions.size())
                continue_from_start();
            }
          else
            continue_from_start();
          periods.report(error, mission);
        }
    }

  private:
    /** Begins a pair of jumps after a period from the start, or marches on. */
    void
    continue_from_start()
    {
      // Parts that relax within few periods follow a jump to a third; those
      // that are marched after the last jump let them catch up.
      constexpr unsigned int n_marched = 10, n_last = 2, least = 4;
      increment               = periods.increment();
      on_lip                  = (*averaged).take(averaged.lip);
      const unsigned int left = missions[next] - 1 - done;
      if (done + 1 < n_marched || left < n_last + least)
        {
          start += increment;
          ++done;
          include_size();
          return;
        }
      const unsigned int most = (left - n_last) / 2;
      k = wished >= 2. * most ? most : round_number_below(wished / 2.);
      begin_pair();
    }

    void
    begin_pair()
    {
      whole = middle = start;
      whole += (*averaged).jump(increment, on_lip, 2 * k);
      middle += (*averaged).jump(increment, on_lip, k);
      in_pair = true;
    }

    /** Ends a pair of jumps after the period between them, or begins a shorter
     * one. @return the error. */
    double
    end_pair()
    {
      constexpr double safety = 0.8, least = 0.2, most = 4.;
      Vector           end = middle;
      end += (*averaged).jump(periods.increment(),
                              (*averaged).take(averaged.lip),
                              k);
      Vector difference = end;
      difference -= whole;
      const double error  = size > 0. ? size_of(difference) / size : 0.;
      const double factor = safety * std::sqrt(tolerance / error);
      wished              = 2. * k * std::clamp(factor, least, most);
      if (error > tolerance && k > 2)
        {
          k = round_number_below(wished / 2.);
          begin_pair();
          return error;
        }
      start = end;
      start += difference;
      done += 2 * k;
      in_pair = false;
      include_size();
      return error;
    }

    /** Largest of 2, 3, 4, 6, 8, 12, … up to a number. The double of each, for
     * the whole jump, is another one, whose factor serves again. */
    static unsigned int
    round_number_below(const double number)
    {
      unsigned int n = 2, next = 3;
      while (next <= number)
        n = std::exchange(next, 2 * n);
      return n;
    }

    /** Norm of the stress that a strain causes where the lip is held. */
    double
    size_of(const Vector &strain)
    {
      Vector bearing = strain;
      (*averaged).remove_compatible(bearing);
      return norm(bearing);
    }

    double
    norm(const Vector &strain)
    {
      Vector coordinates;
      averaged.energy.from_strain(strain, coordinates);
      return coordinates.l2_norm();
    }

    void
    include_size()
    {
      // The stress of a strain that causes none is rounding.
      constexpr double rounding = 1e-10;
      size = std::max({size, size_of(start), rounding * norm(start)});
    }

    void
    serialize(StateArchive &archive)
    {
      archive.section("missions");
      for (Vector *strain : {&start, &middle, &whole, &increment})
        archive.at_points(*strain);
      on_lip.serialize(archive);
      archive.common(done);
      archive.common(k);
      archive.common(wished);
      archive.common(next);
      archive.common(in_pair);
      archive.common(size);
      averaged.lip.serialize(archive);
    }

    ObservedPeriods<dim>           &periods;
    AveragedPeriods<dim>           &averaged;
    const std::vector<unsigned int> missions;
    const double                    tolerance;

    Vector            start;         ///< r after the periods that are done
    Vector            middle, whole; ///< r after jumps of k and of 2k
    Vector            increment;     ///< r(T) − r(0) from the start
    LipHistory::OnLip on_lip;        ///< of the period from the start
    unsigned int      done    = 0;   ///< periods of the motion
    unsigned int      k       = 2;   ///< periods of a jump
    double            wished  = 4.;  ///< periods of a pair of jumps
    std::size_t       next    = 0;   ///< place of the next mission in the list
    bool              in_pair = false; ///< whether the first jump is done
    double            size    = 0.;    ///< largest size_of() a start
  };
} // namespace Crevasse

#endif
