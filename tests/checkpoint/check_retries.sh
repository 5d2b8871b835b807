#!/bin/bash
# A run that is interrupted before a guard takes its step back does so as the
# run that was never interrupted, from the same state, and ends bit by bit alike.
#   check_retries.sh MORSEL COMPARE_RUNS SCENE
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
# A little more than the stable step of 1.11e-6 s: the ledger opens at step 596 only.
large=(--set "Time/Time step=1.115e-6")

run whole "${large[@]}"
expect $? 0 "the whole run"
back="$(grep -o 'Back to time .*' whole/run.log)" || complain "no step was taken back"

for pause in 0.3 0.1 0.03 0; do
  interrupt TERM $pause "${large[@]}"
  expect $? 130 "after SIGTERM"
  grep -q 'Back to time' run/run.log || break
done
! grep -q 'Back to time' run/run.log || complain "it was never interrupted early enough"
run run --resume "${large[@]}"
expect $? 0 "going on"
[ "$(grep -o 'Back to time .*' run/run.log)" = "$back" ] ||
  complain "it went back to another state than '$back'"
"$compare" whole run || complain "the results differ"
