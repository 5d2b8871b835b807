#!/bin/bash
# Runs a command on several ranks: on_ranks.sh RANKS COMMAND...
# Ranks that wait leave their core to others only where there are more ranks than
# cores: beside other work on the machine they would get hardly any time else.
# Tests with it take two processors in ctest.
ranks="$1"
shift
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
yield=0
[ "$ranks" -gt "$(nproc)" ] && yield=1
exec mpirun -np "$ranks" --oversubscribe --mca mpi_yield_when_idle $yield "$@"
