#!/bin/bash
# Checks that doc/parameters.md is up to date, or brings it up to date.
#   check_parameters_doc.sh MORSEL doc/parameters.md [--repair]
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
page()
{
  "$1" --print-parameters md
  printf '\n# Studies\nHow a study is written: [studies.md](studies.md).\n'
  "$1" --print-parameters md "$here/study/sections.prm"
  printf '\n# Collections of studies\n'
  "$1" --print-parameters md "$here/study/collection.prm"
}
if [ "${3:-}" = --repair ]; then
  page "$1" >"$2"
elif ! diff <(page "$1") "$2"; then
  echo "To repair: tests/check_parameters_doc.sh build/morsel doc/parameters.md --repair" >&2
  exit 1
fi
