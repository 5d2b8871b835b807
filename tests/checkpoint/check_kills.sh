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
start()
{
  "$morsel" --threads 1 --quiet --output run \
    --set "Output/Checkpoint interval=5e-4" "$@" "$scene" >message 2>&1 &
  pid=$!
}

# How long it takes to the first checkpoint [ms].
begin=$(date +%s%N)
start
wait_for_file 'run/checkpoint/*.json'
first=$((($(date +%s%N) - begin) / 1000000))
kill -9 $pid
wait $pid 2>/dev/null

ended=0
for ((k = 1; k < kills; ++k)); do
  start --resume
  moment=$((first * (RANDOM % 200) / 100))
  sleep "$((moment / 1000)).$(printf %03d $((moment % 1000)))"
  # Where it has ended, it goes on from its last checkpoint once more.
  kill -9 $pid 2>/dev/null || ended=$((ended + 1))
  wait $pid 2>/dev/null
  status=$?
  [ $status -eq 137 ] || [ $status -eq 0 ] || complain "status $status at kill $k"
  # Nothing half-written has a final name.
  for list in run/checkpoint/*.json; do
    tail -c 3 "$list" | grep -q '}' || complain "$list is incomplete"
  done
done
echo "$kills kills, $ended of them too late, up to step $(newest_list run)"
run run --resume
expect $? 0 "the last run"
"$compare" whole run || complain "the results differ"
