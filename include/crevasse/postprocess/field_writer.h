// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_field_writer_h
#define crevasse_postprocess_field_writer_h

#include <crevasse/base/log.h>
#include <crevasse/model/body.h>
#include <crevasse/postprocess/field_grid.h>
#include <crevasse/postprocess/lip_opening.h>
#include <crevasse/time/observer.h>
#include <crevasse/time/step_list.h>

namespace Crevasse
{
  /** Where in a period a FieldWriter keeps the state. */
  struct FieldInstants
  {
    bool             all = false; ///< steps
    std::set<double> chosen;      ///< of steps, the end of the period included
    /** Numbers of the sample that is observed, nan for none: its state is kept
     * where one of them is largest in the period. */
    std::vector<std::function<double(const Sample &)>> followed;
  };

  /**
   * Fields for ParaView at chosen instants of the last period and at the end
   * of the run. Which period is the last is known only after it, so that the
   * states are kept in memory and written by summarise().
   *
   * Point data, named as here: displacement; stress, recovered, and
   * viscous_strain, the tensor r (the shear component r_12 is half the
   * engineering shear strain 2 r_12), as symmetric tensors; principal_stress_1,
   * … and principal_direction_1, … in the plane of the mesh, the largest first;
   * second_deviator_invariant; von_mises_stress; contact_pressure and opening;
   * temperature, recovered like the stress. Cell data: material_id.
   */
  template <int dim>
  class FieldWriter : public Observer
  {
  public:
    /** References must outlive this object. */
    FieldWriter(const Body<dim>           &body,
                const StressRecovery<dim> &recovery,
                const StepList            &steps,
                const FieldInstants       &instants,
                const std::string         &directory,
                Log                       &log)
      : body(body)
      , recovery(recovery)
      , steps(steps)
      , wanted(instants)
      , directory(directory)
      , log(log)
    {
    }

    void
    observe(const Sample &sample) override;

    void
    serialize(StateArchive &archive) override;

    /** Writes solution_<n>.vtu, .pvtu and solution.pvd. @throw FileError */
    void
    summarise(Summary &) override;

  private:
    struct Snapshot
    {
      double time;
      State  state;
      Vector viscous_strain;
    };

    /** Whether the sample is kept; forgets those that no longer are. */
    bool
    is_wanted(const Sample &sample);

    std::vector<PointArray>
    arrays_of(const double          instant,
              const Snapshot       &snapshot,
              const FieldGrid<dim> &grid) const;

    /** At quadrature points, in the place of the first component of a stress.
     */
    Vector
    temperature(const double t) const;

    const Body<dim>           &body;
    const StressRecovery<dim> &recovery;
    const StepList            &steps;
    FieldInstants              wanted;
    const std::string          directory;
    Log                       &log;

    /** By instant, so that a period replaces the one before. */
    std::map<double, Snapshot> snapshots;

    /** The largest value of a followed number in the period so far, its largest
     * absolute value, and the instant of the former; -1: none. */
    struct Extreme
    {
      double value = std::numeric_limits<double>::lowest(), size = 0.,
             instant = -1.;
    };
    std::vector<Extreme> extremes;
  };
} // namespace Crevasse

#endif
