#!/bin/bash
# Ranks that have no particles: the results are those of one rank.
#   check_few.sh MORSEL COMPARE_RUNS SCENE
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

run whole
expect $? 0 "one rank"
for ranks in 2 3; do
  rm -rf run
  timeout 100 "$on_ranks" $ranks \
    "$morsel" --threads 1 --quiet --output run "$scene" >message 2>&1
  expect $? 0 "$ranks ranks"
  "$compare" whole run 1e-6 || complain "the results differ on $ranks ranks"
done
