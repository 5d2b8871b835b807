#!/bin/bash
# A checkpoint of one rank goes on on two and the other way round, the same to
# round-off; and if one of two ranks is killed, the other does not hang.
#   check_other_ranks.sh MORSEL COMPARE_RUNS SCENE
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
two=(timeout 250 "$on_ranks" 2)

run whole
expect $? 0 "the whole run"

interrupt TERM 0.1
expect $? 130 "one rank"
cp -r run of_one
"${two[@]}" "$morsel" --threads 1 --quiet --output run --resume "$scene" >message 2>&1
expect $? 0 "on two ranks"
"$compare" whole run 1e-6 || complain "the results differ on two ranks"

rm -rf run
"${two[@]}" "$morsel" --threads 1 --quiet --output run \
  --set "Output/Checkpoint interval=1e-3" "$scene" >message 2>&1
expect $? 0 "two ranks with checkpoints"
"$compare" whole run 1e-6 || complain "the results of two ranks differ"
cp -r run of_two
run run --resume
expect $? 0 "on one rank"
"$compare" whole run 1e-6 || complain "the results differ on one rank"
rm -rf run && mv of_two run
"${two[@]}" "$morsel" --threads 1 --quiet --output run --resume "$scene" >message 2>&1
expect $? 0 "on the same two ranks"

# One of two is killed.
for pause in 0.1 0.1 0.05 0; do
  rm -rf run
  "${two[@]}" "$morsel" --threads 1 --quiet --output run "$scene" >message 2>&1 &
  pid=$!
  wait_for_file run/history.csv
  sleep $pause
  victim="$(pgrep -f -- "^$morsel --threads 1 --quiet --output run $scene" | tail -1)"
  [ -n "$victim" ] && kill -9 "$victim" && break
  wait $pid
done
[ -n "$victim" ] || complain "there is no rank to kill"
begin=$SECONDS
wait $pid
status=$?
[ $status -ne 0 ] && [ $status -ne 124 ] || complain "status $status with a killed rank"
[ $((SECONDS - begin)) -lt 40 ] || complain "the other rank hung"
grep -qiE "killed|signal 9|exited on signal" message || complain "nothing was said"
