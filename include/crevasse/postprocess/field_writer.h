// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_field_writer_h
#define crevasse_postprocess_field_writer_h

#include <crevasse/base/log.h>
#include <crevasse/model/body.h>
#include <crevasse/postprocess/field_grid.h>
#include <crevasse/time/observer.h>
#include <crevasse/time/step_list.h>

namespace Crevasse
{
  /** Instants of a period at which a FieldWriter keeps the state. */
  struct FieldInstants
  {
    bool             all = false; ///< whether to keep all steps
    std::set<double> chosen;      ///< instants of steps or end of period
    /** Quantities of a sample, nan for none: states are kept at the largest
     * value of each quantity in the period. */
    std::vector<std::function<double(const Sample &)>> followed;
  };

  /**
   * Writes fields for ParaView at chosen instants of the last period and at the
   * end of the run. The last period is known only after it, so that states are
   * kept in memory and written by finish().
   *
   * Names of point data: displacement; stress, recovered, and viscous_strain,
   * the tensor r (the shear component r_12 is half the engineering shear strain
   * 2 r_12), as symmetric tensors; principal_stress_1, … and
   * principal_direction_1, … in the plane of the mesh, the largest first;
   * second_deviator_invariant; von_mises_stress; contact_pressure and opening;
   * temperature, recovered like the stress. Cell data: material_id.
   */
  template <int dim>
  class FieldWriter : public Observer
  {
  public:
    /** References must outlive the FieldWriter. */
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
    finish() override;

  private:
    struct Snapshot
    {
      double time;
      State  state;
      Vector viscous_strain;
    };

    /** Updates the extremes and deletes snapshots that they no longer need.
     * @return whether to keep the sample. */
    bool
    follow(const Sample &sample);

    std::vector<PointArray>
    arrays_of(const double          instant,
              const Snapshot       &snapshot,
              const FieldGrid<dim> &grid) const;

    /** Temperature at quadrature points, as the first component of a stress. */
    Vector
    temperature(const double t) const;

    const Body<dim>           &body;
    const StressRecovery<dim> &recovery;
    const StepList            &steps;
    FieldInstants              wanted;
    const std::string          directory;
    Log                       &log;

    /** States by instant, so that a period replaces the period before. */
    std::map<double, Snapshot> snapshots;

    /** Largest value of a followed quantity in the period so far, its largest
     * absolute value, and the instant of the largest value; -1: none. */
    struct Extreme
    {
      double value = std::numeric_limits<double>::lowest(), size = 0.,
             instant = -1.;
    };
    std::vector<Extreme> extremes;
  };
} // namespace Crevasse

#endif
