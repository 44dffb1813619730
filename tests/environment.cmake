set(ENV{OMPI_ALLOW_RUN_AS_ROOT} 1)
set(ENV{OMPI_ALLOW_RUN_AS_ROOT_CONFIRM} 1)
set(ENV{OMP_NUM_THREADS} 1)
# More ranks than cores are allowed. Whether they yield while they wait is left to
# Open MPI: beside a busy machine each yield costs a turn of all its processes.
set(ENV{OMPI_MCA_rmaps_base_oversubscribe} 1)
set(ENV{PRTE_MCA_rmaps_default_mapping_policy} :oversubscribe) # Open MPI 5
# All are on one machine, which need not have a network; looking for one takes
# longer than most runs.
set(ENV{OMPI_MCA_pml} ob1)
set(ENV{OMPI_MCA_btl} self,vader)
