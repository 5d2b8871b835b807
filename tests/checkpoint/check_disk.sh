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
else
  echo "no small file system can be mounted here: that part is left out"
fi

# A folder that vanishes.
"$morsel" --threads 1 --quiet --output run "${often[@]}" "$scene" >message 2>&1 &
pid=$!
wait_for_file 'run/checkpoint/*.json'
rm -rf run
for _ in $(seq 20); do
  rm -rf run 2>/dev/null
  touch run 2>/dev/null && break
done
wait $pid
expect $? 4 "after the folder had vanished"
expect_message "^morsel: Cannot "
rm -rf run

# Nothing can be created in a file.
touch file
run file/run
expect $? 4 "where a file stands"
