/* SPDX-License-Identifier: LGPL-2.1-or-later
 * Copyright (C) 2026 by the Crevasse authors
 *
 * What the two parts of the counter of MPI calls share. */

#ifndef mpi_counter_h
#define mpi_counter_h

#include <mpi.h>

extern double collectives, collective_bytes;

double
bytes_of(int count, MPI_Datatype type);

#endif
