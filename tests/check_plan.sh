#!/bin/bash
# Plans a scene, checks the form of what is said, and that the command which is
# proposed names a sound scene of which --validate says the same.
#   check_plan.sh MORSEL SCENE ACCURACY
set -uo pipefail
morsel="$1" scene="$2" accuracy="$3"
plan="$(mktemp)"
trap 'rm -f "$plan"' EXIT

complain()
{
  echo "$1; the program said:" >&2
  cat "$plan" >&2
  exit 1
}

"$morsel" --plan "$accuracy" "$scene" >"$plan" 2>&1 || complain "status $?"
for line in 'Method .*Resolution .*Unknowns .*Time .*Memory' 'Chosen: ' \
            'Predicted memory about [0-9.]+ [MG]B' \
            'Predicted time   about [0-9.]+ (s|min|h)'; do
  grep -qE "^$line" "$plan" || complain "no line begins with '$line'"
done

command="$(sed -n '/^  morsel/,$p' "$plan" | sed 's/^  morsel/"$morsel" --validate/')"
validated="$(eval "$command" 2>&1)" || complain "the command fails: $validated"
grep -qE '^Predicted time   about [0-9.]+ s' <<<"$validated" ||
  complain "--validate does not predict a time: $validated"
