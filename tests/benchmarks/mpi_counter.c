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
 * Counts the messages of a program through MPI's profiling interface, without
 * a change to it:
 *
 *   mpirun -x LD_PRELOAD=libmpi_counter.so -x MPI_COUNTER_FILE=counts.csv ...
 *
 * writes a row for each rank: messages to one other rank, their bytes, calls
 * that involve all ranks, and the bytes that the rank gives to those. What
 * Fortran libraries send is not seen. */

#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>

static double messages, message_bytes, collectives, collective_bytes;

static double
bytes_of(int count, MPI_Datatype type)
{
  int size;
  MPI_Type_size(type, &size);
  return (double)count * size;
}

static void
count_message(int count, MPI_Datatype type, int receiver)
{
  if (receiver == MPI_PROC_NULL)
    return;
  messages += 1;
  message_bytes += bytes_of(count, type);
}

static void
count_collective(int count, MPI_Datatype type)
{
  collectives += 1;
  collective_bytes += bytes_of(count, type);
}

#define SEND(name)                                                     \
  int MPI_##name(const void  *data,                                    \
                 int          count,                                   \
                 MPI_Datatype type,                                    \
                 int          receiver,                                \
                 int          tag,                                     \
                 MPI_Comm     comm)                                    \
  {                                                                    \
    count_message(count, type, receiver);                              \
    return PMPI_##name(data, count, type, receiver, tag, comm);        \
  }
SEND(Send)
SEND(Ssend)
SEND(Rsend)
SEND(Bsend)

#define START(name)                                                    \
  int MPI_##name(const void  *data,                                    \
                 int          count,                                   \
                 MPI_Datatype type,                                    \
                 int          receiver,                                \
                 int          tag,                                     \
                 MPI_Comm     comm,                                    \
                 MPI_Request *request)                                 \
  {                                                                    \
    count_message(count, type, receiver);                              \
    return PMPI_##name(data, count, type, receiver, tag, comm, request); \
  }
START(Isend)
START(Issend)
START(Irsend)

int
MPI_Allreduce(const void  *send,
              void        *receive,
              int          count,
              MPI_Datatype type,
              MPI_Op       operation,
              MPI_Comm     comm)
{
  count_collective(count, type);
  return PMPI_Allreduce(send, receive, count, type, operation, comm);
}

int
MPI_Reduce(const void  *send,
           void        *receive,
           int          count,
           MPI_Datatype type,
           MPI_Op       operation,
           int          root,
           MPI_Comm     comm)
{
  count_collective(count, type);
  return PMPI_Reduce(send, receive, count, type, operation, root, comm);
}

int
MPI_Bcast(void *data, int count, MPI_Datatype type, int root, MPI_Comm comm)
{
  count_collective(count, type);
  return PMPI_Bcast(data, count, type, root, comm);
}

int
MPI_Barrier(MPI_Comm comm)
{
  count_collective(0, MPI_BYTE);
  return PMPI_Barrier(comm);
}

int
MPI_Allgather(const void  *send,
              int          count,
              MPI_Datatype type,
              void        *receive,
              int          receive_count,
              MPI_Datatype receive_type,
              MPI_Comm     comm)
{
  count_collective(count, type);
  return PMPI_Allgather(
    send, count, type, receive, receive_count, receive_type, comm);
}

int
MPI_Allgatherv(const void  *send,
               int          count,
               MPI_Datatype type,
               void        *receive,
               const int   *receive_counts,
               const int   *starts,
               MPI_Datatype receive_type,
               MPI_Comm     comm)
{
  count_collective(count, type);
  return PMPI_Allgatherv(
    send, count, type, receive, receive_counts, starts, receive_type, comm);
}

int
MPI_Finalize(void)
{
  double mine[4] = {messages, message_bytes, collectives, collective_bytes};
  int    rank, n_ranks;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  double *all = rank == 0 ? malloc(n_ranks * sizeof(mine)) : NULL;
  PMPI_Gather(
    mine, 4, MPI_DOUBLE, all, 4, MPI_DOUBLE, 0, MPI_COMM_WORLD);
  const char *name = getenv("MPI_COUNTER_FILE");
  FILE       *file = rank == 0 && name != NULL ? fopen(name, "w") : NULL;
  if (file != NULL)
    {
      fprintf(file, "rank,messages,bytes,collectives,collective_bytes\n");
      for (int r = 0; r < n_ranks; ++r)
        fprintf(file,
                "%d,%.0f,%.0f,%.0f,%.0f\n",
                r,
                all[4 * r],
                all[4 * r + 1],
                all[4 * r + 2],
                all[4 * r + 3]);
      fclose(file);
    }
  free(all);
  return PMPI_Finalize();
}
