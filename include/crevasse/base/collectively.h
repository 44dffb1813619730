// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_collectively_h
#define crevasse_base_collectively_h

#include <deal.II/base/mpi.h>

#include <functional>

namespace Crevasse
{
  /**
   * Calls @p f on each rank. If it throws on some of them, all ranks throw what
   * the lowest of these has thrown, with its type (SceneError, NumericalError,
   * FileError or another std::exception): an error that one rank alone knew of
   * would leave the others waiting at the next communication. Collective; @p f
   * must not communicate.
   */
  void
  collectively(const MPI_Comm communicator, const std::function<void()> &f);
} // namespace Crevasse

#endif
