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
   * Caches tangents of nonlinear creep, each at the stress of an instant of the
   * period, and their contact systems. From period to period the stress changes
   * little: the tangent of the nearest instant is used until Newton's method
   * converges too slowly and requests a new one.
   */
  template <int dim>
  class KeptTangents
  {
  public:
    using System = ContactSystem<dim>;
    using Moduli = PointValues<VoigtMatrix<dim>>;

    /** Functions that provide material and system of a tangent. */
    struct Makers
    {
      std::function<const MaterialState<dim> &(const double t)>    material;
      std::function<std::shared_ptr<System>(const Moduli &moduli)> system;
    };

    struct Kept
    {
      double                  c = 0.;
      Vector                  stress, known; ///< r̂
      Moduli                  moduli{VoigtMatrix<dim>()};
      std::shared_ptr<System> system;
    };

    /** The arguments must outlive the KeptTangents. */
    KeptTangents(const Body<dim> &body,
                 const double     period,
                 InstantMemory   &memory,
                 const Makers    &makers);

    /** The tangent of the nearest instant; null if there is none. */
    const Kept *
    nearest(const double t) const;

    /** Creates the tangent at a stress at @p t for r = r̂ + c ṙ. It replaces
     * the nearest tangent if there is no memory for more. Collective. */
    const Kept &
    renew(const double  t,
          const double  c,
          const Vector &stress,
          const Vector &known);

    /** Statistics of all tangents, past ones included. */
    SolverStatistics
    statistics() const;

    /** Serialises the tangents and the state of their contact solvers. */
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

    Tangents         tangents; ///< tangents by instant
    SolverStatistics of_the_past;
  };
} // namespace Crevasse

#endif
