"""The environment in which tests and measurements start several processes: more
than there are cores, which must not spin while they wait; perhaps as root."""

import os

ENVIRONMENT = dict(os.environ, OMP_NUM_THREADS="1",
                   OMPI_ALLOW_RUN_AS_ROOT="1",
                   OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                   OMPI_MCA_rmaps_base_oversubscribe="1",
                   # The same for Open MPI 5.
                   PRTE_MCA_rmaps_default_mapping_policy=":oversubscribe",
                   OMPI_MCA_mpi_yield_when_idle="1",
                   # All on one machine, which need not have a network.
                   OMPI_MCA_btl="^tcp")
