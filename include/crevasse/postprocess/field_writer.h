// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_field_writer_h
#define crevasse_postprocess_field_writer_h

#include <crevasse/base/log.h>
#include <crevasse/discretisation/contact_boundary.h>
#include <crevasse/discretisation/space.h>
#include <crevasse/discretisation/stress_recovery.h>
#include <crevasse/time/observer.h>
#include <crevasse/time/step_list.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace Crevasse
{
  /** Instants within the period; the nearest steps are taken. */
  struct FieldTimes
  {
    const StepList            &steps;
    const std::vector<double> &times;
  };

  /**
   * Fields for ParaView at chosen instants of the last period and at the end
   * of the run. Which period is the last is known only after it, so that the
   * states are kept in memory and written by summarise().
   *
   * Point data, named as here: displacement; stress_11, …, the components of
   * the recovered stress; viscous_strain_11, …, those of the tensor r (the
   * shear component r_12 is half the engineering shear strain 2 r_12);
   * principal_stress_1, … and principal_direction_1, … in the plane of the
   * mesh, the largest first; second_deviator_invariant; contact_pressure.
   */
  template <int dim>
  class FieldWriter : public Observer
  {
  public:
    FieldWriter(const Space<dim>           &space,
                const StressRecovery<dim>  &recovery,
                const ContactBoundary<dim> &lip,
                const FieldTimes           &times,
                const std::string          &directory,
                Log                        &log);

    void
    observe(const Sample &sample) override;

    void
    serialize(StateArchive &archive) override;

    /** Writes the fields. @throw FileError */
    void
    summarise(Summary &) override;

  private:
    /** Writes solution_<n>.vtu, .pvtu and solution.pvd; returns the number of
     * instants. Collective. @throw FileError */
    unsigned int
    write() const;

    struct Snapshot
    {
      double time;
      State  state;
      Vector viscous_strain;
    };

    void
    write(const Snapshot &snapshot, const unsigned int number) const;

    const Space<dim>           &space;
    const StressRecovery<dim>  &recovery;
    const ContactBoundary<dim> &lip;
    const std::string           directory;
    Log                        &log;

    /** By instant, so that a period replaces the one before. */
    std::map<double, Snapshot> snapshots;
    std::set<double>           wanted;
  };
} // namespace Crevasse

#endif
