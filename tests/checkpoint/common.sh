# What the tests of checkpoints share. They are called with
#   MORSEL COMPARE_RUNS SCENE
# and run in an empty folder that goes when they end.
set -uo pipefail
morsel="$1" compare="$2" scene="$3"
on_ranks="$(realpath "$(dirname "${BASH_SOURCE[0]}")/../on_ranks.sh")"

folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cd "$folder"

complain()
{
  echo "$1" >&2
  for file in message run/run.log; do
    [ -f "$file" ] && { echo "--- $file" && tail -5 "$file"; } >&2
  done
  exit 1
}

# Runs the scene quietly into a folder: run FOLDER [OPTION...]
run()
{
  "$morsel" --threads 1 --quiet --output "$@" "$scene" >message 2>&1
}

expect()
{
  [ "$1" -eq "$2" ] || complain "status $1 instead of $2: $3"
}

expect_message()
{
  grep -qE -- "$1" message || complain "no message matches '$1'"
  ! grep -qE 'Stacktrace|terminate called|HDF5-DIAG' message ||
    complain "this is no sentence for a user"
}

wait_for_file()
{
  for _ in $(seq 600); do
    compgen -G "$1" >/dev/null && return
    sleep 0.02
  done
  complain "there is no $1"
}

# Starts the scene into run/ and sends it a signal some seconds later, sooner if
# it has ended before, as it may beside other work: interrupt SIGNAL SECONDS
# [OPTION...]
interrupt()
{
  for pause in "$2" 0.1 0.05 0; do
    rm -rf run
    "$morsel" --threads 1 --quiet --output run "${@:3}" "$scene" >message 2>&1 &
    pid=$!
    wait_for_file run/history.csv
    sleep "$pause"
    kill -"$1" $pid 2>/dev/null
    wait $pid
    status=$?
    [ $status -eq 0 ] || break
  done
  return $status
}

newest_list()
{
  ls "$1"/checkpoint/*.json | tail -1
}
