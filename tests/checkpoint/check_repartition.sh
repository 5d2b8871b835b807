#!/bin/bash
# Particles change ranks while the food breaks: the results are those of one
# rank, and a checkpoint that is made after the change goes on, to the last digit
# on as many ranks, and to round-off on others.
#   check_repartition.sh MORSEL COMPARE_RUNS SCENE
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

on()
{
  timeout 250 "$on_ranks" "$1" \
    "$morsel" --threads 1 --quiet --output run "${@:2}" "$scene" >message 2>&1
}

run whole
expect $? 0 "one rank"

on 2
expect $? 0 "two ranks"
grep -q "changed ranks" run/run.log || complain "no particle changed ranks"
"$compare" whole run 1e-6 || complain "the results differ on two ranks"
mv run whole_on_two

on 2 --set Ranks/Repartition=false
expect $? 0 "two ranks that keep their particles"
! grep -q "changed ranks" run/run.log || complain "particles changed ranks unasked"
"$compare" whole run 1e-6 || complain "the results differ where particles stay"
rm -rf run

# The last checkpoint is made well after the change.
on 2 --set "Output/Checkpoint interval=2e-3"
expect $? 0 "two ranks with checkpoints"
"$compare" whole_on_two run || complain "checkpoints change the results"
change="$(sed -n 's/.*changed ranks.* step \([0-9]*\)\.$/\1/p' run/run.log | head -1)"
saved="$(basename "$(newest_list run)" .json)"
[ $((10#${saved#step_})) -gt "$change" ] || complain "no checkpoint after the change"
cp -r run with_checkpoints

on 2 --resume
expect $? 0 "on the same two ranks"
"$compare" whole_on_two run || complain "resuming is not to the last digit"
for ranks in 1 3; do
  rm -rf run && cp -r with_checkpoints run
  on $ranks --resume
  expect $? 0 "on $ranks ranks"
  "$compare" whole run 1e-6 || complain "the results differ on $ranks ranks"
done
