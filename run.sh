#!/bin/bash
# Simulates a scene and makes its report; installs and builds what is missing.
#
#   ./run.sh [SCENE.prm] [options of the program]
#
# The default scene is one chewing stroke on a roasted peanut. Ends with the
# program's exit status.
set -euo pipefail
root="$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")" && pwd)"
. "$root/.ci/setup.sh"

install_packages
build morsel

# Which of the arguments is the scene, whether there is anything to report, and
# where the results go.
scene="" output="" reports=yes value_of=""
for argument in "$@"; do
  case "$value_of" in
    output) output="$argument" ;;
  esac
  if [ -n "$value_of" ]; then
    value_of=""
    continue
  fi
  case "$argument" in
    --output) value_of=output ;;
    --output=*) output="${argument#*=}" ;;
    --set | --threads) value_of=other ;;
    --print-parameters) value_of=other reports="" ;;
    --print-parameters=* | --validate | --calibrate | --help | -h | --version) reports="" ;;
    -*) ;;
    *) scene="$argument" ;;
  esac
done
arguments=("$@")
[ -n "$scene" ] || arguments=("$root/prm/food/peanut.prm" "$@")

if [ -z "$reports" ]; then
  exec "$root/build/morsel" "${arguments[@]}"
fi
if [ -z "$output" ]; then
  # The program knows the scene's name: it may stand in the scene or in --set.
  parameters="$("$root/build/morsel" "${arguments[@]}" --print-parameters prm)"
  output="output/$(sed -n 's/^set Name *= *\([^#]*[^# ]\).*/\1/p' <<<"$parameters")"
fi

status=0
"$root/build/morsel" "${arguments[@]}" || status=$?
[ $status -eq 0 ] || exit $status

report="$root/postprocess/report.py"
if [ -f "$report" ]; then
  /usr/bin/python3 "$report" "$output" >"$output/report.log" 2>&1 || {
    tail -n 20 "$output/report.log" >&2
    echo "run.sh: the report of '$output' could not be made." >&2
    exit 4
  }
  rm -f "$output/report.log"
  echo "Report: $output/report.html"
else
  echo "Results: $output"
fi
