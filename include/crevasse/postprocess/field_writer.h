// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_field_writer_h
#define crevasse_postprocess_field_writer_h

#include <crevasse/base/log.h>
#include <crevasse/model/body.h>
#include <crevasse/postprocess/field_grid.h>
#include <crevasse/time/observer.h>


namespace Crevasse
{
  /** Nodal contact pressure: g / weight, that of a neighbour at held nodes
   * (see ContactBoundary), zero off the lip. */
  template <int dim>
  Vector
  contact_pressure(const Space<dim>           &space,
                   const StressRecovery<dim>  &recovery,
                   const ContactBoundary<dim> &lip,
                   const std::vector<double>  &contact_forces);

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
    /** @param instants those of steps within the period, its end included. */
    FieldWriter(const Body<dim>           &body,
                const StressRecovery<dim> &recovery,
                const std::set<double>    &instants,
                const std::string         &directory,
                Log                       &log)
      : space(body.space)
      , recovery(recovery)
      , lip(body.lip)
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

    std::vector<PointArray>
    arrays_of(const Snapshot &snapshot, const FieldGrid<dim> &grid) const;

    const Space<dim>           &space;
    const StressRecovery<dim>  &recovery;
    const ContactBoundary<dim> &lip;
    std::set<double>            wanted;
    const std::string           directory;
    Log                        &log;

    /** By instant, so that a period replaces the one before. */
    std::map<double, Snapshot> snapshots;
  };
} // namespace Crevasse

#endif
