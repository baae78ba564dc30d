#!/bin/bash
# bolide verify --record and scripts/figures: what is stored, how forms, settings and sweeps are merged, what
# cannot be recorded, and pages that differ from records.
set -u
status=0
fail() {
    echo "FAILED: $*"
    status=1
}
says() { grep -qF -- "$2" "$1" || fail "$1 does not say \"$2\": $(head -50 "$1")"; }
verify() { "$BOLIDE" verify --threads 1 "$@" >log 2>&1; }
rows() { grep -c "^$1" tube/results.csv; }

chmod -R u+w . && rm -rf tube sweep bound results other.yaml other.results.csv page ./*.log
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

# Pages.
figures() { /usr/bin/python3 "$BOLIDE_SOURCE_DIR/scripts/figures" "$@" page/README.md >log 2>&1; }
printf 'Text.\n\n<!-- figures: {runs: [../tube, ../tube short, ../tube --set resolution=tube/40]} -->\n<!-- /figures -->\n\nMore.\n' \
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
exit $status
