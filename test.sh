#!/bin/bash
# Builds and runs the tests; installs what is missing.
#
#   ./test.sh         all but the long cases
#   ./test.sh --all   the long cases, too
#
# Ends with ctest's summary, and with status 0 if every test passed.
set -euo pipefail
root="$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")" && pwd)"
. "$root/.ci/setup.sh"

selection=(-LE long)
for argument in "$@"; do
  case "$argument" in
    --all) selection=() ;;
    *) fail "there is no option '$argument'; give --all or nothing." ;;
  esac
done

install_packages
build all

# OpenMPI refuses to start two ranks as root unless told twice.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
log="$root/build/test.log"
status=0
ctest --test-dir "$root/build" --output-on-failure --no-tests=error \
  --parallel "$(nproc)" "${selection[@]}" >"$log" 2>&1 || status=$?
if [ $status -ne 0 ]; then
  # The failed tests' own output; the passed ones take a line each.
  grep -v ' Passed \| Start ' "$log" || true
else
  sed -n '/tests passed/,$p' "$log"
fi
exit $status
