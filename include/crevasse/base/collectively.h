// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

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
