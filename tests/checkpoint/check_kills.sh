#!/bin/bash
# A run is killed at 50 random moments, goes on each time, and ends as the run
# that was never interrupted, bit by bit.
#   check_kills.sh MORSEL COMPARE_RUNS SCENE [KILLS]
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
kills="${4:-50}"
RANDOM=20

run whole
expect $? 0 "the whole run"

# A checkpoint every 0.03 s, so that many kills meet one being written.
often=(--set "Output/Checkpoint interval=5e-4")
killed=0 resume=()
while [ $killed -lt "$kills" ]; do
  "$morsel" --threads 1 --quiet --output run "${often[@]}" "${resume[@]}" \
    "$scene" >message 2>&1 &
  pid=$!
  sleep "0.$((RANDOM % 6 + 2))$((RANDOM % 10))"
  if ! kill -9 $pid 2>/dev/null; then
    wait $pid
    expect $? 0 "run that ended before kill $killed"
    # From its last checkpoint once more.
  else
    wait $pid 2>/dev/null
    killed=$((killed + 1))
  fi
  compgen -G "run/checkpoint/*.json" >/dev/null && resume=(--resume)
  # Nothing half-written has a final name.
  for list in run/checkpoint/*.json; do
    [ -f "$list" ] && { tail -c 3 "$list" | grep -q '}' ||
      complain "$list is incomplete"; }
  done
done
[ ${#resume[@]} -gt 0 ] || complain "no run lived to its first checkpoint"
run run --resume
expect $? 0 "the last run"
"$compare" whole run || complain "the results differ"
