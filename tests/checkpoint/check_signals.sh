#!/bin/bash
# Signals, damaged and foreign checkpoints, other numbers of ranks.
#   check_signals.sh MORSEL COMPARE_RUNS SCENE
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

run whole
expect $? 0 "the whole run"
cp whole/summary.json summary_before
run whole --resume
expect $? 2 "nothing to go on from"
expect_message "^morsel: --resume: there is no checkpoint in 'whole/checkpoint'"
cmp -s whole/summary.json summary_before || complain "results were touched"

# Each signal ends the run with a checkpoint, from which it goes on.
for signal in INT TERM; do
  interrupt $signal 0.3
  expect $? 130 "after SIG$signal"
  expect_message "^morsel: Interrupted .*--resume goes on from 'run/checkpoint/"
  run run --resume
  expect $? 0 "going on after SIG$signal"
  "$compare" whole run || complain "the results differ after SIG$signal"
done

# What is solved at once ends at once.
rm -rf static
"$morsel" --output static --set "XFEM/Cells along x=201" --set "XFEM/Cells along y=201" \
  "$(dirname "$scene")/../../prm/fracture/m1_xfem.prm" >message 2>&1 &
pid=$!
wait_for_file static/run.log
kill -TERM $pid
wait $pid
expect $? 130 "an interrupted static scene"
expect_message "^morsel: Interrupted before the scene was solved"

# SIGUSR1 makes a checkpoint in passing, one after another; two are kept.
rm -rf run
"$morsel" --threads 1 --quiet --output run "$scene" >message 2>&1 &
pid=$!
wait_for_file run/history.csv
for _ in 1 2 3; do
  sleep 0.1
  kill -USR1 $pid 2>/dev/null
done
wait $pid
expect $? 0 "with SIGUSR1"
"$compare" whole run || complain "a checkpoint changed the results"
[ "$(ls run/checkpoint/*.json | wc -l)" -eq 2 ] || complain "not two checkpoints"

# The newest is damaged: the one before serves.
cp -r run intact
newest="$(newest_list run)"
part="${newest%.json}.rank0"
printf 'X' | dd of="$part" bs=1 seek=1000 conv=notrunc 2>/dev/null
run run --resume
expect $? 0 "from the checkpoint before"
grep -q "damaged (checksum)" run/run.log || complain "the damage was not told"
"$compare" whole run || complain "the results differ from the one before"

# Cut short, missing, not of this program, all of them.
for damage in 'truncate -s 100' 'rm' 'cp message'; do
  rm -rf run && cp -r intact run
  for list in run/checkpoint/*.json; do
    case "$damage" in
      cp*) $damage "$list" ;;
      *) $damage "${list%.json}.rank0" ;;
    esac
  done
  run run --resume
  expect $? 4 "after '$damage'"
  expect_message "^morsel: --resume: no checkpoint is good. The checkpoint 'run/checkpoint/"
done

# Another scene.
rm -rf run && cp -r intact run
run run --resume --set "Contact/Friction=0.31"
expect $? 2 "other parameters"
expect_message "does not belong to this run: it was made with 'set Friction"

# Half the step from there on.
run run --resume --set "Time/Time step=2e-7"
expect $? 0 "going on with another step"
[ "$(tail -1 run/history.csv | sed 's/.*,//')" = 2e-07 ] ||
  complain "the step is still $(tail -1 run/history.csv | sed 's/.*,//')"
rm -rf run && cp -r intact run

# A run from the beginning keeps what an earlier one left.
run run
expect $? 0 "anew"
compgen -G "run/checkpoint_before/*.json" >/dev/null || complain "checkpoints were lost"
"$compare" whole run || complain "the results differ anew"
