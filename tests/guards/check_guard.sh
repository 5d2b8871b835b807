#!/bin/bash
# Runs a scene whose numbers go bad, and checks the exit status, that one
# sentence says why, that the run stops early enough, and that what it leaves is
# in order: summary.json tells how it ended, history.csv goes forward in time.
#   check_guard.sh STATUS REGEX LAST_STEP MORSEL SCENE [options...]
# With status 0 the run must have been saved by a smaller step, and REGEX is
# looked for in run.log. MPIRUN=N runs it on N ranks.
set -uo pipefail
expected="$1" pattern="$2" last_step="$3" morsel="$4"
shift 4

folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
launcher=()
if [ -n "${MPIRUN:-}" ]; then
  launcher=("$(dirname "${BASH_SOURCE[0]}")/../on_ranks.sh" "$MPIRUN")
fi
timeout 100 "${launcher[@]}" "$morsel" --quiet --threads 1 --output "$folder/out" \
  "$@" >"$folder/message" 2>&1
status=$?

complain()
{
  echo "$1; the program said:" >&2
  cat "$folder/message" >&2
  [ ! -f "$folder/out/run.log" ] || cat "$folder/out/run.log" >&2
  exit 1
}
[ $status -eq "$expected" ] || complain "status $status instead of $expected"
if [ "$expected" -eq 0 ]; then
  grep -qE -- "$pattern" "$folder/out/run.log" || complain "run.log has no '$pattern'"
else
  [ "$(grep -c '^morsel: ' "$folder/message")" -eq 1 ] || complain "not one sentence"
  ! grep -q 'MPI_ABORT' "$folder/message" || complain "a rank aborted the others"
  grep -qE -- "^morsel: .*$pattern" "$folder/message" ||
    complain "no message matches '$pattern'"
  step="$(grep -oE ', step [0-9]+' "$folder/message" | head -1 | grep -oE '[0-9]+')"
  [ "$step" -le "$last_step" ] || complain "it stopped at step $step only"
fi
/usr/bin/python3 - "$folder/out" "$expected" <<'PYTHON' || complain "the results are not in order"
import csv, json, sys
folder, expected = sys.argv[1], int(sys.argv[2])
summary = json.load(open(folder + "/summary.json"))
status = summary["text"]["status"]
assert status == ("done" if expected == 0 else "failed"), status
retries = summary["step_retries"]["value"]
if expected == 0:
    assert retries > 0, "no retry"
    assert summary["time_step"]["value"] < summary["first_time_step"]["value"]
else:
    assert summary["text"]["failure"], "no sentence"
times = [float(row["time [s]"]) for row in csv.DictReader(open(folder + "/history.csv"))]
assert all(b > a for a, b in zip(times, times[1:])), times
assert times[-1] <= summary["simulated_time"]["value"] * (1 + 1e-9), times[-1]
PYTHON
