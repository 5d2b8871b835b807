#!/bin/bash
# Calibrates a coarse stroke: it converges in few rounds, goes on where it was
# ended, and says what went wrong.
#   check_calibration.sh MORSEL FOLDER_OF_THIS_FILE
set -uo pipefail
morsel="$(readlink -f "$1")" scenes="$(readlink -f "$2")"
scene="$scenes/stroke.prm"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cd "$work"

complain()
{
  echo "$1" >&2
  cat ./*.log >&2
  exit 1
}

# A value of calibration.json.
value_of()
{
  /usr/bin/python3 -c "import json; d = json.load(open('out/calibration.json'))
print($1)"
}

"$morsel" --calibrate "$scene" --output out >1.log 2>&1 ||
  complain "the calibration failed"
[ "$(value_of "d['converged'] and len(d['rounds']) <= 3")" = True ] ||
  complain "it did not converge in three rounds"
factor="$(value_of "d['threshold_factor']")"
grep -q "set Threshold factor = $factor" 1.log ||
  complain "the lines for a scene are missing"
grep -q '"damage": {"threshold_factor":'"$factor" 1.log ||
  complain "the catalogue's object is missing"

# A plain run with the factor gives what was told for its seed.
"$morsel" "$scene" --output plain --set Output/Fields=false \
  --set "Body food/Particles/Particles across=17" \
  --set "Body food/Damage/Threshold factor=$factor" >2.log 2>&1 ||
  complain "the plain run failed"
[ "$(value_of "abs(json.load(open('plain/summary.json'))['compressive_strength']['value']
  / d['rounds'][-1]['targets'][0]['runs'][0]['strength'] - 1) < 1e-9")" = True ] ||
  complain "a plain run gives another strength"
! grep -q Calibration plain/used.prm ||
  complain "used.prm of a plain run has the section Calibration"

# Nothing is repeated; another tolerance does not make old runs void.
"$morsel" --calibrate "$scene" --output out --set Calibration/Tolerance=0.019 \
  >3.log 2>&1 || complain "the second call failed"
[ "$(value_of "all(r['kept'] for q in d['rounds'][:2] for t in q['targets'] for r in t['runs'])")" = True ] ||
  complain "finished runs were repeated"

# Nothing fails.
"$morsel" --calibrate "$scene" --output none --set Stop/Maximum\ closure=0.0005 \
  >4.log 2>&1
[ $? -eq 3 ] || complain "a stroke without failure did not end with 3"
grep -q "^morsel: .*gave no strength: nothing failed" 4.log ||
  complain "it does not say that nothing failed"

# A run that is killed.
"$morsel" --calibrate "$scene" --output slow --set "Calibration/Time limit=0.001" \
  >5.log 2>&1
[ $? -eq 3 ] || complain "a killed run did not end with 3"
grep -q "^morsel: .*longer than the time limit" 5.log ||
  complain "a killed run is not told"

# Too few rounds; what was found is told all the same.
"$morsel" --calibrate "$scene" --output few \
  --set "Calibration/Largest number of rounds=1" >6.log 2>&1
[ $? -eq 3 ] || complain "a target not reached did not end with 3"
grep -q "^morsel: .*after 1 round the best is still" 6.log &&
  [ -s few/calibration.json ] || complain "a target not reached is not told"

# A result that the runs do not give.
"$morsel" --calibrate "$scene" --output wrong \
  --set "Calibration/Compression result=compresive_strength" >7.log 2>&1
[ $? -eq 2 ] || complain "an unknown result did not end with 2"
grep -q "Did you mean 'compressive_strength'" 7.log ||
  complain "an unknown result is not explained"

# Two strengths together, the tensile one from a scene of its own.
"$morsel" --calibrate "$scenes/two_strengths.prm" --output out >8.log 2>&1 ||
  complain "two strengths were not reached"
[ "$(value_of "all(abs(t['error']) <= 0.02 for t in d['rounds'][-1]['targets']) and len(d['targets']) == 2 and d['strength_ratio'] != 10")" = True ] ||
  complain "calibration.json does not show two strengths"
grep -q "set Strength ratio = $(value_of "d['strength_ratio']")" 8.log ||
  complain "the strength ratio is not told"
