/* SPDX-License-Identifier: LGPL-2.1-or-later
 * Copyright (C) 2026 by the Crevasse authors
 *
 * The part of mpi_counter.c that counts the calls which involve all ranks. */

#include <stddef.h>

#include "mpi_counter.h"

double collectives, collective_bytes;

static void
count_collective(int count, MPI_Datatype type)
{
  collectives += 1;
  collective_bytes += bytes_of(count, type);
}

/* MPI_IN_PLACE leaves count and type of what is given without meaning. */
static void
count_given(const void *send, int count, MPI_Datatype type)
{
  if (send == MPI_IN_PLACE)
    count_collective(0, MPI_BYTE);
  else
    count_collective(count, type);
}

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
  count_given(send, count, type);
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
  count_given(send, count, type);
  return PMPI_Allgatherv(
    send, count, type, receive, receive_counts, starts, receive_type, comm);
}

int
MPI_Ibarrier(MPI_Comm comm, MPI_Request *request)
{
  count_collective(0, MPI_BYTE);
  return PMPI_Ibarrier(comm, request);
}

int
MPI_Iallreduce(const void  *send,
               void        *receive,
               int          count,
               MPI_Datatype type,
               MPI_Op       operation,
               MPI_Comm     comm,
               MPI_Request *request)
{
  count_collective(count, type);
  return PMPI_Iallreduce(send, receive, count, type, operation, comm, request);
}

#define SCAN(name)                                                   \
  int MPI_##name(const void  *send,                                  \
                 void        *receive,                               \
                 int          count,                                 \
                 MPI_Datatype type,                                  \
                 MPI_Op       operation,                             \
                 MPI_Comm     comm)                                  \
  {                                                                  \
    count_collective(count, type);                                   \
    return PMPI_##name(send, receive, count, type, operation, comm); \
  }
SCAN(Scan)
SCAN(Exscan)

int
MPI_Gather(const void  *send,
           int          count,
           MPI_Datatype type,
           void        *receive,
           int          receive_count,
           MPI_Datatype receive_type,
           int          root,
           MPI_Comm     comm)
{
  count_given(send, count, type);
  return PMPI_Gather(
    send, count, type, receive, receive_count, receive_type, root, comm);
}

int
MPI_Gatherv(const void  *send,
            int          count,
            MPI_Datatype type,
            void        *receive,
            const int   *receive_counts,
            const int   *starts,
            MPI_Datatype receive_type,
            int          root,
            MPI_Comm     comm)
{
  count_given(send, count, type);
  return PMPI_Gatherv(send,
                      count,
                      type,
                      receive,
                      receive_counts,
                      starts,
                      receive_type,
                      root,
                      comm);
}

static int
is_root(int root, MPI_Comm comm)
{
  int rank;
  MPI_Comm_rank(comm, &rank);
  return rank == root;
}

static double
sum(const int *counts, MPI_Comm comm)
{
  int n_ranks;
  MPI_Comm_size(comm, &n_ranks);
  double all = 0;
  for (int rank = 0; rank < n_ranks; ++rank)
    all += counts[rank];
  return all;
}

static void
count_parts(double count, MPI_Datatype type)
{
  collectives += 1;
  collective_bytes += count * bytes_of(1, type);
}

/* Only the root gives something. */
int
MPI_Scatter(const void  *send,
            int          count,
            MPI_Datatype type,
            void        *receive,
            int          receive_count,
            MPI_Datatype receive_type,
            int          root,
            MPI_Comm     comm)
{
  int n_ranks;
  MPI_Comm_size(comm, &n_ranks);
  if (is_root(root, comm))
    count_parts((double)count * n_ranks, type);
  else
    count_collective(0, MPI_BYTE);
  return PMPI_Scatter(
    send, count, type, receive, receive_count, receive_type, root, comm);
}

int
MPI_Scatterv(const void  *send,
             const int   *counts,
             const int   *starts,
             MPI_Datatype type,
             void        *receive,
             int          receive_count,
             MPI_Datatype receive_type,
             int          root,
             MPI_Comm     comm)
{
  if (is_root(root, comm))
    count_parts(sum(counts, comm), type);
  else
    count_collective(0, MPI_BYTE);
  return PMPI_Scatterv(send,
                       counts,
                       starts,
                       type,
                       receive,
                       receive_count,
                       receive_type,
                       root,
                       comm);
}

int
MPI_Alltoall(const void  *send,
             int          count,
             MPI_Datatype type,
             void        *receive,
             int          receive_count,
             MPI_Datatype receive_type,
             MPI_Comm     comm)
{
  int n_ranks;
  MPI_Comm_size(comm, &n_ranks);
  if (send == MPI_IN_PLACE)
    count_parts((double)receive_count * n_ranks, receive_type);
  else
    count_parts((double)count * n_ranks, type);
  return PMPI_Alltoall(
    send, count, type, receive, receive_count, receive_type, comm);
}

int
MPI_Alltoallv(const void  *send,
              const int   *counts,
              const int   *starts,
              MPI_Datatype type,
              void        *receive,
              const int   *receive_counts,
              const int   *receive_starts,
              MPI_Datatype receive_type,
              MPI_Comm     comm)
{
  if (send == MPI_IN_PLACE)
    count_parts(sum(receive_counts, comm), receive_type);
  else
    count_parts(sum(counts, comm), type);
  return PMPI_Alltoallv(send,
                        counts,
                        starts,
                        type,
                        receive,
                        receive_counts,
                        receive_starts,
                        receive_type,
                        comm);
}
