#!/bin/bash
# bolide verify --record, --compare-record, scripts/record and scripts/figures: what is stored, how forms, settings
# and sweeps are merged, what cannot be recorded, what differs from a record, and pages that differ from records.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"
says() { grep -qF -- "$2" "$1" || fail "$1 does not say \"$2\": $(head -50 "$1")"; }
verify() { "$BOLIDE" verify --threads 1 "$@" >log 2>&1; }
rows() { grep -c "^$1" tube/results.csv; }

chmod -R u+w . && rm -rf tube sweep bound tree results other.yaml other.results.csv page ./*.log
mkdir -p tube sweep page
sed 's/^  density:  .*/  density, mean: {l1: density, at_most: 0.06}/; s/checks: {density: {at_most: 0.09}, /checks: {/' \
    "$BOLIDE_SOURCE_DIR/templates/riemann.yaml" >tube/case.yaml
sed -i 's/400 # .*/50/; s,^short: {resolution: tube/100,short: {resolution: tube/25,; s/at_most: [0-9.]*/at_most: 0.5/g' tube/case.yaml

# One form after the other; neither loses the other's rows, and the order does not depend on which came first.
verify --record tube || fail "cannot record: $(cat log)"
[ "$(head -1 tube/results.csv)" = form,settings,run,check,measured,unit,wanted,low,high,verdict,note ] ||
    fail "heads: $(head -1 tube/results.csv)"
[ "$(rows normal,)" = 5 ] || fail "a row a check: $(cat tube/results.csv)"
says tube/results.csv '"density, mean"'
verify --record --short tube && [ "$(rows short,)" = 5 ] && [ "$(rows normal,)" = 5 ] ||
    fail "the short form: $(cat log tube/results.csv)"
verify --record --set resolution=tube/40 tube && [ "$(rows normal,resolution=tube/40,)" = 5 ] ||
    fail "with a setting: $(cat log tube/results.csv)"
verify --record --long tube && [ "$(rows long,)" = 0 ] || fail "a case without a long form has one in its record"
cp tube/results.csv first.csv
verify --record tube && verify --record --set resolution=tube/40 tube && verify --record --short --threads 2 tube
cmp first.csv tube/results.csv || fail "the same runs make another record"
rm tube/results.csv
verify --record --short tube && verify --record --set resolution=tube/40 tube && verify --record tube
cmp first.csv tube/results.csv || fail "the record depends on the order of the runs"
[ "$(sed -n '2s/,.*//p;7s/,.*//p' tube/results.csv | tr '\n' ' ')" = "normal normal " ] ||
    fail "normal comes first: $(cat tube/results.csv)"

# Rows of a file that is not in order are kept.
{ sed -n 1p first.csv && grep ^short first.csv && grep ^normal first.csv; } >tube/results.csv
verify --record --short tube && [ "$(sort first.csv | cksum)" = "$(sort tube/results.csv | cksum)" ] ||
    fail "rows of a file that is not in order: $(cat tube/results.csv)"
cp first.csv tube/results.csv

# A sweep has its runs; a file of another name its own record.
{ cat tube/case.yaml && echo 'sweep: {warm: [1.8 kg/m^3, 2 kg/m^3]}'; } >sweep/case.yaml
verify --record sweep/case.yaml && [ "$(cut -d, -f3 sweep/results.csv | sort -u | tr '\n' ' ')" = \
    "run warm=1.8_kg_m_3 warm=2_kg_m_3 " ] || fail "a sweep: $(cat log sweep/results.csv)"
cp tube/case.yaml other.yaml
verify --record other.yaml && [ -s other.results.csv ] || fail "a file of another name: $(cat log)"

# What is no record, what cannot be recorded.
cp tube/results.csv kept.csv
echo "a,b" >tube/results.csv
verify --record tube && fail "what is no record was replaced"
says log "results.csv: not a record of a case"
cp kept.csv tube/results.csv
verify --record --convergence tube && fail "a convergence study was recorded"
says log "exclude each other"
verify --record --set run.until=-1s tube
cmp kept.csv tube/results.csv || fail "a case that does not run changed its record"
if [ "$(id -u)" != 0 ]; then
    chmod a-w tube
    verify --record tube && fail "recorded in a folder that is read-only"
    says log "tube/results.csv: the record cannot be written here"
    chmod u+w tube
fi
! find . -name '*.part' | grep . || fail "half a file is left"

# Regression bounds start from the record, which says what a change of the result may be.
mkdir -p bound && sed 's/density, mean: {l1: density, at_most: 0.5}/density, mean: {l1: density, regression_bound: 10 %}/
    s/^  mass: .*/  place: {front: {field: pressure, value: 2 bar}, regression_bound: 1 mm}/' tube/case.yaml >bound/case.yaml
verify bound && fail "a bound without a record passes"
says log "bolide verify --record bound/case.yaml"
verify --short bound && fail "a bound without a record passes"
says log "no record of this value in the short form: \`bolide verify --record --short bound/case.yaml\` makes it"
verify --record bound && verify bound || fail "a bound does not hold in what it was made of: $(cat log)"
says log "2 within regression bounds"
says bound/results.csv "regression bound 10 %"
# value FACTOR: the recorded value of the mean density times FACTOR.
value() { awk -F, -v f="$1" 'BEGIN { OFS = "," } /^normal,,,"density/ { $6 *= f } 1' kept.csv >bound/results.csv; }
cp bound/results.csv kept.csv
value 0.8
verify bound && fail "an error a quarter larger than recorded passes"
says log "FAILED"
value 0.95
verify bound || fail "an error a twentieth larger than recorded fails: $(cat log)"
value 3
verify bound || fail "a smaller error fails: $(cat log)"
cp kept.csv bound/results.csv
"$BOLIDE" run bound --output results --overwrite >log 2>&1 && grep -q "recorded_value:" results/case.yaml &&
    verify results/case.yaml || fail "the case as run does not run again: $(cat log)"

# Runs are compared with the record: what moved, by a unit of the last digit or less, is not there any more, is new,
# has another limit or verdict.
compare() { verify --compare-record "$@"; }
edit() { cp first.csv tube/results.csv && sed -i "$1" tube/results.csv; }
cp first.csv tube/results.csv
compare tube && compare --short --threads 2 tube && compare --set resolution=tube/40 tube ||
    fail "a run differs from the record that it made: $(cat log)"
compare sweep/case.yaml && compare other.yaml && compare bound || fail "a run differs from its record: $(cat log)"
compare --set resolution=tube/30 tube && fail "settings that were not recorded pass"
says log "not in the record"
edit '/^normal,,,"density/ s/,0\.0\([0-9]*\),/,0.1\1,/' && compare tube && fail "a value that moved passes"
says log "tube: 1 of 5 values differ from the record tube/results.csv; \`bolide verify --record\`"
says log "tube: density, mean: 0.0"
compare --short tube || fail "the short form differs: $(cat log)"
digit() { # digit N: the recorded density with its last digit moved by N
    awk -F, -v OFS=, -v n="$1" '/^normal,,,"density/ { $6 = sprintf("%.*f", length($6) - 2, $6 + n / 10 ^ (length($6) - 2)) }
        1' first.csv >tube/results.csv
}
digit 0 && compare tube || fail "the editing changes more: $(cat log)"
digit 20 && compare tube && fail "twenty units of the last digit pass"
edit '/^normal,,,"density/ s/0\.5,,$/0.4,,/' && compare tube && fail "another limit passes"
says log "density, mean: high is 0.5, recorded: 0.4"
edit '/^normal,,,"density/ s/,,$/,failed,/' && compare tube && fail "another verdict passes"
says log "density, mean: passed, recorded: failed"
edit '/^normal,,,"density/ d' && compare tube && fail "a new check passes"
says log "density, mean: 0.0"
edit '/^normal,,,"density/ { p; s/density/former/ }' && compare tube && fail "a check that has gone passes"
says log "tube: 1 recorded values are no longer measured"
cp first.csv tube/results.csv
compare --record tube && fail "a record is made and compared with at once"
says log "exclude each other"

# The script repeats all recorded runs, goes on after an interruption, and lists what moved.
mkdir -p tree/scripts tree/examples/topic tree/build && cp -r tube tree/examples/topic/
cp "$BOLIDE_SOURCE_DIR/scripts/record" tree/scripts/
record() { tree/scripts/record "$BOLIDE" "$@" >log 2>&1; }
record --compare || fail "the script: $(cat log)"
says log "3 of 3 runs ended: 0 differ, 0 failed"
sed -i 2d tree/build/record.jsonl && record --compare || fail "the script goes on: $(cat log)"
says log "2 runs have ended before"
record --compare --again --short tree/examples/topic/tube || fail "the script: $(cat log)"
says log "1 of 1 runs ended"
record --compare --again --limit 0 && fail "runs that are over the limit pass"
says log "3 over the limit"
sed -i 's/resolution: tube\/50/resolution: tube\/60/' tree/examples/topic/tube/case.yaml
record --compare && fail "what moved passes"
says log "1 differ"
says log "density, mean: 0.0"
record && record --compare || fail "what the script has recorded differs: $(cat log)"

# Pages.
figures() { /usr/bin/python3 "$BOLIDE_SOURCE_DIR/scripts/figures" "$@" page/README.md >log 2>&1; }
printf 'Text.\n\n<!-- figures: {runs: [../tube, ../tube short, ../tube --set resolution=tube/40]} -->\n\nMore.\n' \
    >page/README.md
figures --check && fail "an empty table passes"
figures || fail "cannot fill: $(cat log)"
says page/README.md "| check | allowed | measured | \`--short\` | measured |"
says page/README.md "| density, mean | at most 0.5 | 0."
[ "$(tail -1 page/README.md)" = More. ] || fail "the text behind a table: $(cat page/README.md)"
figures --check || fail "a filled page differs: $(cat log)"
sed -i 's/^normal,,,velocity,0\.0/normal,,,velocity,0.1/' tube/results.csv
figures --check && fail "a changed record passes"
says log "differs from the records; run scripts/figures"
sed -i '/^short/d' tube/results.csv
figures && fail "a form that was not recorded passes"
says log "README.md:3: the record of"
says log "bolide verify --record --short"

# A mark that names its YAML, which lies beside the page.
printf '<!-- figures: all -->\n' >page/README.md
figures && fail "a name that nothing has passes"
says log "README.md:1: no all lies beside the page"
printf 'all: {runs: [../tube]}\n' >page/figures.yaml
figures || fail "cannot fill what is named: $(cat log)"
says page/README.md "| check | allowed | measured |"
printf 'more: {runs: [../tube]}\n' >>page/figures.yaml
figures --check && fail "a name that no mark has passes"
says log "the page does not show more"
exit $status
