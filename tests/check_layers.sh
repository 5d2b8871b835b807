#!/bin/bash
# Checks that includes point one way only: a room may include itself and the
# rooms that its line below names. What drives a run (the files of no room, with
# headers of their own in source/) stands on top.
#   check_layers.sh SOURCE_DIR
set -euo pipefail
cd "$1"

declare -A may_include=(
  [core]=""
  [materials]="core"
  [scene]="core materials"
  [fracture]="core materials"
  [fe]="core scene materials fracture"
  [sph]="core scene materials fracture"
  [contact]="core"
  [jaw]="core scene materials fracture fe contact"
  [measure]="core scene materials fracture fe sph contact jaw"
  [output]="core scene materials fracture fe sph contact jaw measure"
  [simulation]="core scene materials fracture fe sph contact jaw measure output"
  [study]="core scene simulation"
  [plan]="core scene fracture simulation study"
  [calibrate]="core materials scene simulation study"
  [main]="core scene simulation study plan calibrate"
)
# Parameters of a room stand beside it and include nothing but core, so that
# the scene, which holds them all, may name them.
parameters='(parameters|motion)\.h'

room_of()
{
  local path="${1#include/morsel/}"
  path="${path#source/}"
  case "$path" in
    */*) echo "${path%%/*}" ;;
    main.cc) echo main ;;
    *) echo simulation ;;
  esac
}

errors=0
complain()
{
  echo "$1" >&2
  errors=$((errors + 1))
}

while IFS=: read -r file line include; do
  included="$(sed -E 's/.*<(morsel\/[^>]*)>.*/\1/' <<<"$include")"
  from="$(room_of "$file")"
  to="$(room_of "include/$included")"
  [ -n "${may_include[$from]+known}" ] ||
    { complain "$file: the room '$from' is not in tests/check_layers.sh" && continue; }
  [ "$from" != "$to" ] || continue
  if [ "$from" = scene ] && [[ "$included" =~ $parameters ]]; then
    continue
  fi
  case " ${may_include[$from]} " in
    *" $to "*) ;;
    *) complain "$file:$line: '$from' may not include '$included' (allowed: ${may_include[$from]:-nothing})" ;;
  esac
  if [[ "$file" =~ $parameters ]] && [ "$to" != core ]; then
    complain "$file:$line: a header of parameters may include core only"
  fi
done < <(grep -rnE '^ *# *include <morsel/' include source --include='*.h' --include='*.cc')

# A quoted include of the project's own would escape the rule above.
while read -r hit; do
  complain "$hit: write project includes as <morsel/room/file.h>"
done < <(grep -rnE '^ *# *include "' include source/*/ --include='*.h' --include='*.cc' || true)

while read -r hit; do
  complain "$hit: no 'using namespace' in headers"
done < <(grep -rnE '^ *using namespace' include --include='*.h' || true)

[ $errors -eq 0 ]
