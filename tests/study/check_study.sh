#!/bin/bash
# Runs a small study; interrupts it, kills it, lets it go on, changes its base
# scene, and asks for what no run gives.
#   check_study.sh MORSEL FOLDER_OF_THIS_FILE
set -uo pipefail
morsel="$1" here="$2"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cp "$here"/*.prm "$work"
cd "$work"

complain()
{
  echo "$1" >&2
  cat ./*.log out/study.csv >&2
  exit 1
}

rows() { grep -c ",$1," out/study.csv; }

# Waits until a first run has finished; the study's process is $study.
wait_for_first_row()
{
  for _ in $(seq 3000); do
    [ "$(rows finished 2>/dev/null || true)" = "${1:-1}" ] && return
    kill -0 "$study" 2>/dev/null || return
    sleep 0.02
  done
}

# An interrupt keeps what has finished.
"$morsel" product.prm --output out >1.log 2>&1 &
study=$!
wait_for_first_row 1
kill -INT $study
wait $study
[ $? -eq 130 ] || complain "an interrupt did not end with 130"
kept=$(rows finished)
[ "$kept" -ge 1 ] || complain "an interrupt lost the finished rows"
[ "$(rows 'not run')" -ge 1 ] || complain "an interrupt came too late"

# Killed for good, it leaves no process behind and loses nothing.
"$morsel" product.prm --output out >2.log 2>&1 &
study=$!
wait_for_first_row $((kept + 1))
kill -KILL $study
wait $study 2>/dev/null
kept=$(rows finished)

"$morsel" product.prm --output out >3.log 2>&1 ||
  complain "a failed run made the study fail"
grep -q "4 runs, $kept of them kept from before" 3.log ||
  complain "the study did not go on from $kept finished runs"
[ "$(rows finished)" -eq 3 ] || complain "not three runs finished"
[ "$(rows failed)" -eq 1 ] || complain "not one run failed"
grep -q "status 2: .*'XFEM/Enrichment radius'" out/study.csv ||
  complain "the failed run gives no reason"

# Nothing is repeated but the run that failed.
"$morsel" product.prm --output out >4.log 2>&1
grep -q '3 of them kept' 4.log || complain "finished runs were repeated"

# What was kept is the same as what one undisturbed call gives.
"$morsel" product.prm --output once --set "Study/Side by side=2" >5.log 2>&1
same_columns() { cut -d, -f1-8 "$1"; }
diff <(same_columns out/study.csv) <(same_columns once/study.csv) >&2 ||
  complain "going on gave other results"

# used.prm repeats the study, wherever it lies; the old rows serve it.
"$morsel" out/used.prm --output out >6.log 2>&1
grep -q '3 of them kept' 6.log || complain "used.prm is not the same study"

# Another base scene: no old row holds.
sed -i 's/0, 1000/0, 2000/' plate.prm
"$morsel" product.prm --output out >7.log 2>&1
! grep -q 'kept' 7.log || complain "rows of another base scene were kept"

# A comment changes nothing.
echo '# another comment' >>plate.prm
"$morsel" product.prm --output out >8.log 2>&1
grep -q '3 of them kept' 8.log || complain "a comment invalidated old rows"

# A quantity that no run gives.
sed 's/Quantity stress_intensity_I/Quantity stress_intensty_I/' product.prm \
  >misspelt.prm
"$morsel" misspelt.prm --output none >9.log 2>&1
[ $? -eq 2 ] || complain "a quantity that no run gives did not end with 2"
grep -q "'stress_intensty_I', which no run gives. Did you mean 'stress_intensity_I'" \
  9.log || complain "a quantity that no run gives is not named"
[ "$(grep -c '^morsel:' 9.log)" -eq 1 ] || complain "more than one sentence"

# A run that takes too long.
"$morsel" product.prm --output slow --set "Study/Time limit=0.001" >10.log 2>&1
[ $? -eq 3 ] || complain "a study without a finished run did not end with 3"
grep -q 'longer than the time limit' slow/study.csv ||
  complain "the time limit was not told"

# A collection goes on where a part fails, and again where it stopped.
"$morsel" collection.prm --output all >11.log 2>&1 ||
  complain "a failed part made the collection fail"
grep -q '"status": "finished"' all/collection.json &&
  grep -q '"status": "failed"' all/collection.json ||
  complain "the parts' fates are not told"
[ -s all/parts/product/study.csv ] || complain "a part left no results"
"$morsel" all/used.prm --output all >12.log 2>&1
grep -q '3 of them kept' 12.log || complain "the collection repeated runs"
"$morsel" collection.prm --output quick --set Collection/Quick=true >13.log 2>&1
[ "$(wc -l <quick/parts/product/study.csv)" -eq 3 ] ||
  complain "the quick setting has not two runs"
