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

chmod -R u+w . && rm -rf tube sweep other.yaml other.results.csv page ./*.log
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
