// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_model_kept_tangents_h
#define crevasse_model_kept_tangents_h

#include <crevasse/model/body.h>
#include <crevasse/model/contact_system.h>
#include <crevasse/model/instant_cache.h>

namespace Crevasse
{
  class StateArchive;

  /**
   * The tangents of creep by a power law that were made so far, each of the
   * stress at an instant of the period, with their contact systems. From period
   * to period the stress of an instant changes little: the nearest one serves
   * until Newton's method finds it too slow and has one made for its instant.
   */
  template <int dim>
  class KeptTangents
  {
  public:
    using System = ContactSystem<dim>;
    using Moduli = PointValues<VoigtMatrix<dim>>;

    /** What it takes to make one. */
    struct Makers
    {
      std::function<const MaterialState<dim> &(const double t)>    material;
      std::function<std::shared_ptr<System>(const Moduli &moduli)> system;
    };

    struct Kept
    {
      double                  c = 0.;
      Vector                  stress;
      Moduli                  moduli{VoigtMatrix<dim>()};
      std::shared_ptr<System> system;
    };

    /** All arguments must outlive this object. */
    KeptTangents(const Body<dim> &body,
                 const double     period,
                 InstantMemory   &memory,
                 const Makers    &makers);

    /** The one whose instant is nearest; null if there is none. */
    const Kept *
    nearest(const double t) const;

    /** Makes that of a stress at @p t for r = r̂ + c ṙ. It takes the place of
     * the nearest one if there is no memory for more. Collective. */
    const Kept &
    renew(const double t, const double c, const Vector &stress);

    /** Of all that there were. */
    SolverStatistics
    statistics() const;

    /** Shows of what they are made, and the state of their contact solvers. */
    void
    serialize(StateArchive &archive);

  private:
    static constexpr std::size_t most = 64;

    using Tangents = std::map<double, Kept>;

    typename Tangents::const_iterator
    nearest_entry(const double t) const;

    const Body<dim> &body;
    const double     period;
    InstantMemory   &memory;
    const Makers     makers;

    Tangents         tangents; ///< by their instants
    SolverStatistics of_the_past;
  };
} // namespace Crevasse

#endif
