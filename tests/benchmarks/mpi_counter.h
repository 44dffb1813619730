/* ---------------------------------------------------------------------
 *
 * Copyright (C) 2026 by the Crevasse authors
 *
 * This file is part of Crevasse. It is free software; you can use it,
 * redistribute it and/or modify it under the terms of the GNU Lesser
 * General Public License as published by the Free Software Foundation;
 * either version 2.1 of the License, or (at your option) any later version.
 *
 * ---------------------------------------------------------------------
 *
 * What the two parts of the counter of MPI calls share. */

#ifndef mpi_counter_h
#define mpi_counter_h

#include <mpi.h>

extern double collectives, collective_bytes;

double
bytes_of(int count, MPI_Datatype type);

#endif
