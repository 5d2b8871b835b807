#!/bin/bash
# Runs a command in an empty folder and checks its exit status, a message
# that matches, and that nothing was written.
#   check_message.sh STATUS REGEX COMMAND...
set -uo pipefail
expected="$1" pattern="$2"
shift 2

folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir work && cd work
"$@" >../message 2>&1
status=$?

complain()
{
  echo "$1; the program said:" >&2
  cat ../message >&2
  exit 1
}
[ $status -eq "$expected" ] || complain "status $status instead of $expected"
grep -qE -- "$pattern" ../message || complain "no message matches '$pattern'"
[ -z "$(ls -A)" ] || complain "this was written: $(ls -A)"
if [ "$expected" -ne 0 ]; then
  # A sentence for a user, not a backtrace.
  [ "$(wc -l <../message)" -le 4 ] || complain "the message has too many lines"
  ! grep -qE 'Stacktrace|terminate called|0x[0-9a-f]{6}' ../message ||
    complain "this is a backtrace"
fi
