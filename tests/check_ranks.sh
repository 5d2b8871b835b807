#!/bin/bash
# Runs a command on several ranks in an empty folder and checks its exit
# status, that one rank alone says what is wrong, that none aborts the others,
# and that nothing was written.
#   check_ranks.sh RANKS STATUS REGEX COMMAND...
set -uo pipefail
ranks="$1" expected="$2" pattern="$3"
shift 3
on_ranks="$(realpath "$(dirname "${BASH_SOURCE[0]}")/on_ranks.sh")"

folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir work && cd work
timeout 50 "$on_ranks" "$ranks" "$@" >../message 2>&1
status=$?

complain()
{
  echo "$1; the ranks said:" >&2
  cat ../message >&2
  exit 1
}
[ $status -eq "$expected" ] || complain "status $status instead of $expected"
[ "$(grep -c '^morsel: ' ../message)" -eq 1 ] || complain "not one message"
grep -qE -- "^morsel: .*$pattern" ../message || complain "no message matches '$pattern'"
! grep -q 'MPI_ABORT' ../message || complain "a rank aborted the others"
[ -z "$(ls -A)" ] || complain "this was written: $(ls -A)"
