#!/bin/bash
# Checks that doc/parameters.md is up to date.
#   check_parameters_doc.sh MORSEL doc/parameters.md
set -euo pipefail
if ! diff <("$1" --print-parameters md) "$2"; then
  echo "To repair: build/morsel --print-parameters md > doc/parameters.md" >&2
  exit 1
fi
