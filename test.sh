#!/bin/bash
# Builds and runs the tests; installs what is missing.
#
#   ./test.sh             all but the long cases
#   ./test.sh --all       the long cases, too
#   ./test.sh --sanitize  unit tests and short scenes with every address and
#                         undefined behaviour watched, in build-sanitize/
#   ./test.sh --coverage  which lines of the program all but the long cases
#                         reach, in build-coverage/
#
# Ends with ctest's summary, and with status 0 if every test passed.
set -euo pipefail
root="$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")" && pwd)"
. "$root/.ci/setup.sh"

selection=(-LE long)
preset=""
for argument in "$@"; do
  case "$argument" in
    --all) selection=() ;;
    --sanitize) preset=sanitize selection=(-L 'unit|messages|regression|fuzz' -LE long) ;;
    --coverage) preset=coverage ;;
    *) fail "there is no option '$argument'; give --all, --sanitize, --coverage or nothing." ;;
  esac
done

if [ "$preset" = coverage ]; then
  install_packages gcovr
else
  install_packages
fi
if [ -n "$preset" ]; then
  folder="$root/build-$preset"
  build_preset "$preset"
  find "$folder" -name '*.gcda' -delete # counts of an earlier run
else
  folder="$root/build"
  build all
fi

# OpenMPI refuses to start two ranks as root unless told twice.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
sanitizers="$root/tests/sanitizers"
# Leaks are not looked for: MPI leaves some in every process, in modules that are
# unloaded before the end and so have no name to be suppressed by.
export ASAN_OPTIONS="detect_leaks=0:detect_stack_use_after_return=1"
export UBSAN_OPTIONS="print_stacktrace=1:halt_on_error=1:suppressions=$sanitizers/undefined.txt"
export TSAN_OPTIONS="suppressions=$sanitizers/threads.txt"
log="$folder/test.log"
status=0
ctest --test-dir "$folder" --output-on-failure --no-tests=error \
  --parallel "$(nproc)" "${selection[@]}" >"$log" 2>&1 || status=$?
if [ $status -ne 0 ]; then
  # The failed tests' own output; the passed ones take a line each.
  grep -v ' Passed \| Start ' "$log" || true
else
  sed -n '/tests passed/,$p' "$log"
fi
if [ "$preset" = coverage ]; then
  gcovr --root "$root" --filter "$root/source/" --filter "$root/include/" \
    --print-summary "$folder"
fi
exit $status
