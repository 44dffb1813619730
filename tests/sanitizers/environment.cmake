# Open MPI, p4est and PETSc keep memory until the process ends.
set(ENV{ASAN_OPTIONS} detect_leaks=0)
set(ENV{UBSAN_OPTIONS} print_stacktrace=1)
