#!/bin/bash
# A full disk, a folder that may not be written to, a folder that vanishes:
# status 4, a sentence, and nothing half-written under a final name.
#   check_disk.sh MORSEL COMPARE_RUNS SCENE
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
often=(--set "Output/Checkpoint interval=1e-3")

# A breaking peanut, to small/run: run_on_ranks RANKS [OPTION...]
run_on_ranks()
{
  timeout 100 "$on_ranks" "$1" \
    "$morsel" --threads 1 --quiet --output small/run --set "Output/Fields=true" \
    --set "Time/End time=1e-4" "${@:2}" \
    "$(dirname "$scene")/breaking_ranks.prm" >message 2>&1
}

expect_one_sentence()
{
  [ "$(grep -c '^morsel: ' message)" -eq 1 ] || complain "not one sentence"
  ! grep -q 'MPI_ABORT' message || complain "a rank aborted the others"
}

# Every frame that has its name can be read to its last row.
expect_complete_fields()
{
  ! compgen -G "$1/*/*.tmp*" >/dev/null || complain "temporary files are left"
  /usr/bin/python3 -c '
import glob, sys, h5py
for name in glob.glob(sys.argv[1] + "/solution/*.h5"):
    with h5py.File(name, "r") as h5:
        assert {len(h5[table][:]) for table in h5 if table != "cells"} == {len(h5["nodes"])}
' "$1" || complain "a frame is incomplete"
}

mkdir small
if mount -t tmpfs -o size=300k none small 2>/dev/null; then
  trap 'umount "$folder/small"; rm -rf "$folder"' EXIT
  for fields in false true; do
    rm -rf small/*
    run small/run "${often[@]}" --set "Output/Fields=$fields"
    expect $? 4 "on a full disk"
    expect_message "^morsel: .*Cannot write.*(No space left on device|solution)"
    [ "$(wc -l <message)" -le 2 ] || complain "more than a sentence"
    ! compgen -G 'small/run/*.tmp*' >/dev/null || complain "temporary files are left"
    ! compgen -G 'small/run/*/*.tmp*' >/dev/null || complain "temporary files are left"
    # The rows that are there are complete.
    columns="$(head -1 small/run/history.csv | tr -cd , | wc -c)"
    while read -r row; do
      [ "$(echo "$row" | tr -cd , | wc -c)" -eq "$columns" ] ||
        complain "half a row: $row"
    done <small/run/history.csv
    for list in small/run/checkpoint/*.json; do
      [ ! -f "$list" ] || tail -c 3 "$list" | grep -q '}' ||
        complain "$list is incomplete"
    done
  done
  # Two ranks: none waits for the one that met the end of the disk, wherever
  # that is: in the layout of a file, in the rows of either rank, or in what the
  # first one writes alone. What has its name is complete.
  for room in 60k 300k 500k 700k 900k 1100k; do
    rm -rf small/* && mount -o remount,size=$room small
    run_on_ranks 2
    expect $? 4 "on a disk of $room, with two ranks"
    expect_message "^morsel: Cannot write 'small/run/.*No space left on device"
    expect_one_sentence
    expect_complete_fields small/run
  done
  rm -rf small/* && mount -o remount,size=40k small
  "$morsel" --quiet --output small/run \
    "$(dirname "$scene")/../../prm/fracture/m1_xfem.prm" >message 2>&1
  expect $? 4 "a static scene on a full disk"
  expect_message "^morsel: Cannot write 'small/run/.*No space left on device"
  [ ! -e small/run/solution/plate.vtu ] || complain "a file is half-written"

  rm -rf small/* && mount -o remount,ro small
  for ranks in 1 2; do
    run_on_ranks $ranks
    expect $? 4 "where nothing may be written, on $ranks rank(s)"
    expect_message "^morsel: .*Read-only file system"
    expect_one_sentence
  done
else
  echo "no small file system can be mounted here: that part is left out"
fi

# A folder that vanishes.
"$morsel" --threads 1 --quiet --output run "${often[@]}" "$scene" >message 2>&1 &
pid=$!
wait_for_file 'run/checkpoint/*.json'
mv run elsewhere
wait $pid
expect $? 4 "after the folder had vanished"
expect_message "^morsel: Cannot "
[ ! -e run ] || complain "the folder was made anew: $(ls run)"

# Nothing can be created in a file.
touch file
run file/run
expect $? 4 "where a file stands"
