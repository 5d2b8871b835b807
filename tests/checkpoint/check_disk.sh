#!/bin/bash
# A full disk, a folder that may not be written to, a folder that vanishes:
# status 4, a sentence, and nothing half-written under a final name.
#   check_disk.sh MORSEL COMPARE_RUNS SCENE
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
often=(--set "Output/Checkpoint interval=1e-3")

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
  # Two ranks: none waits for the one that met the end of the disk.
  for room in 300k 900k; do
    rm -rf small/* && mount -o remount,size=$room small
    timeout 100 mpirun -np 2 --oversubscribe --mca mpi_yield_when_idle 1 \
      "$morsel" --threads 1 --quiet --output small/run --set "Output/Fields=true" \
      --set "Time/End time=1e-4" "$(dirname "$scene")/breaking_ranks.prm" >message 2>&1
    expect $? 4 "on a disk of $room, with two ranks"
    expect_message "^morsel: Cannot write 'small/run/solution/.*No space left on device"
    ! compgen -G 'small/run/*/*.tmp*' >/dev/null || complain "temporary files are left"
  done
  rm -rf small/* && mount -o remount,size=40k small
  "$morsel" --quiet --output small/run \
    "$(dirname "$scene")/../../prm/fracture/m1_xfem.prm" >message 2>&1
  expect $? 4 "a static scene on a full disk"
  expect_message "^morsel: Cannot write 'small/run/.*No space left on device"
  [ ! -e small/run/solution/plate.vtu ] || complain "a file is half-written"

  rm -rf small/* && mount -o remount,ro small
  run small/run
  expect $? 4 "where nothing may be written"
  expect_message "^morsel: .*Read-only file system"
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
