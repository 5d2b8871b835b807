#!/bin/bash
# Checks that all sources are formatted as .clang-format says.
#   check_format.sh SOURCE_DIR
# To repair: clang-format -i FILE...
set -euo pipefail
cd "$1"
find include source tests benchmarks -name '*.h' -o -name '*.cc' | sort |
  xargs clang-format --dry-run --Werror --ferror-limit=1
