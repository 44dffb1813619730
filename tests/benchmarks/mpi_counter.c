/* SPDX-License-Identifier: LGPL-2.1-or-later
 * Copyright (C) 2026 by the Crevasse authors
 *
 * Counts the messages of a program through MPI's profiling interface, without
 * a change to it:
 *
 *   mpicc -shared -fPIC -o libmpi_counter.so mpi_counter.c mpi_collectives.c
 *   mpirun -x LD_PRELOAD=libmpi_counter.so -x MPI_COUNTER_FILE=counts.csv ...
 *
 * writes a row for each rank: messages to one other rank, their bytes, calls
 * that involve all ranks, and the bytes that the rank gives to those. What
 * Fortran libraries send is not seen, and of collective calls the usual ones
 * only. */

#include "mpi_counter.h"

#include <stdio.h>
#include <stdlib.h>

static double messages, message_bytes;

double
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

#define SEND(name)                                              \
  int MPI_##name(const void  *data,                             \
                 int          count,                            \
                 MPI_Datatype type,                             \
                 int          receiver,                         \
                 int          tag,                              \
                 MPI_Comm     comm)                             \
  {                                                             \
    count_message(count, type, receiver);                       \
    return PMPI_##name(data, count, type, receiver, tag, comm); \
  }
SEND(Send)
SEND(Ssend)
SEND(Rsend)
SEND(Bsend)

#define START(name)                                                      \
  int MPI_##name(const void  *data,                                      \
                 int          count,                                     \
                 MPI_Datatype type,                                      \
                 int          receiver,                                  \
                 int          tag,                                       \
                 MPI_Comm     comm,                                      \
                 MPI_Request *request)                                   \
  {                                                                      \
    count_message(count, type, receiver);                                \
    return PMPI_##name(data, count, type, receiver, tag, comm, request); \
  }
START(Isend)
START(Issend)
START(Irsend)

int
MPI_Sendrecv(const void  *send,
             int          count,
             MPI_Datatype type,
             int          receiver,
             int          tag,
             void        *receive,
             int          receive_count,
             MPI_Datatype receive_type,
             int          sender,
             int          receive_tag,
             MPI_Comm     comm,
             MPI_Status  *status)
{
  count_message(count, type, receiver);
  return PMPI_Sendrecv(send,
                       count,
                       type,
                       receiver,
                       tag,
                       receive,
                       receive_count,
                       receive_type,
                       sender,
                       receive_tag,
                       comm,
                       status);
}

/* Persistent sends: what each start sends is known when they are made. */
struct persistent
{
  MPI_Request        request;
  int                count, receiver;
  MPI_Datatype       type;
  struct persistent *next;
};
static struct persistent *persistent_sends;

int
MPI_Send_init(const void  *data,
              int          count,
              MPI_Datatype type,
              int          receiver,
              int          tag,
              MPI_Comm     comm,
              MPI_Request *request)
{
  const int error =
    PMPI_Send_init(data, count, type, receiver, tag, comm, request);
  struct persistent *send = malloc(sizeof(*send));
  if (send != NULL)
    {
      const struct persistent made = {
        *request, count, receiver, type, persistent_sends};
      *send            = made;
      persistent_sends = send;
    }
  return error;
}

static void
count_start(MPI_Request request)
{
  for (struct persistent *send = persistent_sends; send; send = send->next)
    if (send->request == request)
      count_message(send->count, send->type, send->receiver);
}

int
MPI_Start(MPI_Request *request)
{
  count_start(*request);
  return PMPI_Start(request);
}

int
MPI_Startall(int count, MPI_Request requests[])
{
  for (int k = 0; k < count; ++k)
    count_start(requests[k]);
  return PMPI_Startall(count, requests);
}

/* A request may be made again where a freed one was. */
int
MPI_Request_free(MPI_Request *request)
{
  for (struct persistent **place = &persistent_sends; *place != NULL;)
    if ((*place)->request == *request)
      {
        struct persistent *freed = *place;
        *place                   = freed->next;
        free(freed);
      }
    else
      place = &(*place)->next;
  return PMPI_Request_free(request);
}

int
MPI_Finalize(void)
{
  double mine[4] = {messages, message_bytes, collectives, collective_bytes};
  int    rank, n_ranks;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  double *all = rank == 0 ? malloc(n_ranks * sizeof(mine)) : NULL;
  PMPI_Gather(mine, 4, MPI_DOUBLE, all, 4, MPI_DOUBLE, 0, MPI_COMM_WORLD);
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
