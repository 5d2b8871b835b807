#!/bin/bash
# Stress intensities on several ranks are those of one.
#   check_crack_ranks.sh MORSEL SCENE RANKS...
set -uo pipefail
morsel="$1" scene="$2"
shift 2
on_ranks="$(realpath "$(dirname "${BASH_SOURCE[0]}")/on_ranks.sh")"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cd "$folder"

for ranks in 1 "$@"; do
  timeout 60 "$on_ranks" "$ranks" "$morsel" --threads 1 --quiet --output "on_$ranks" \
    "$scene" >message 2>&1 || { echo "status $? on $ranks ranks" && cat message; exit 1; }
done >&2

/usr/bin/python3 - "$@" <<'COMPARE'
import json
import sys


def intensities(ranks):
    with open(f"on_{ranks}/summary.json") as summary:
        values = json.load(summary)
    return {name: values[name]["value"] for name in values
            if name.startswith("stress_intensity_I") and "spread" not in name}


one = intensities(1)
assert one, "no stress intensities"
scale = max(abs(value) for value in one.values())
for ranks in sys.argv[1:]:
    other = intensities(ranks)
    for name, value in one.items():
        assert abs(other[name] - value) < 1e-8 * scale, \
            f"{name}: {value} on one rank, {other[name]} on {ranks}"
COMPARE
