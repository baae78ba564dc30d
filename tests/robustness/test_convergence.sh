#!/bin/bash
# bolide verify --convergence: tables, page and exit status of studies that pass, fail, deviate as known, cannot be
# made, or are stopped; and what lies in the folder.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"
gas=$BOLIDE_SOURCE_DIR/examples/riemann/gas/case.yaml
# study STATUS LOG OPTIONS...: the gas, coarse.
study() {
    local wanted=$1 log=$2
    shift 2
    "$BOLIDE" verify --convergence "$gas" --overwrite --set run.until=2ms "$@" >"$log" 2>&1
    local got=$?
    [ $got = "$wanted" ] || fail "$log: status $got, wanted $wanted: $(cat "$log")"
}
says() { grep -qF -- "$2" "$1" || fail "$1 does not say \"$2\": $(head -50 "$1")"; }
levels='[4 mm, 2 mm, 1 mm]'
order() { echo "convergence={values: $levels, of: [shock front], order: {L1 of energy: {$1}}}"; }

rm -rf results all ./*.log
study 0 passes.log --set "$(order 'at_least: 0.2, source: theory')"
says passes.log "passed"
says passes.log "results in results/gas/convergence.html"
[ "$(wc -l <results/gas/convergence.csv)" = 4 ] || fail "a row a run: $(cat results/gas/convergence.csv)"
[ "$(head -1 results/gas/convergence.csv)" = 'run,resolution [m],particles,seconds [s],"L1 of energy error","L1 of energy order","shock front [m]","shock front error [m]","shock front order"' ] ||
    fail "heads: $(head -1 results/gas/convergence.csv)"
says results/gas/convergence-orders.csv '"passed","theory"'
says results/gas/convergence.html 'href="convergence/resolution=4_mm/report.html"'
says results/gas/convergence.html "Passed: 1 of 1 orders."
for run in 4 2 1; do
    [ -s results/gas/convergence/resolution=${run}_mm/report.html ] || fail "no report of the run at $run mm"
done
! find results -name '*.part' | grep . || fail "half a file is left"
python3 - <<'PYTHON' || fail "the page is not well formed"
import html.parser, re
class Check(html.parser.HTMLParser):
    open = []
    def handle_starttag(self, tag, attributes):
        if tag not in {"meta", "img"}:
            self.open.append(tag)
    def handle_endtag(self, tag):
        assert self.open.pop() == tag, f"</{tag}> closes nothing"
text = open("results/gas/convergence.html", encoding="utf-8").read()
check = Check()
check.feed(text)
assert not check.open and text.count("data:image/png;base64,") == 1
assert not re.search(r"https?:|url\(|@import|\bnan\b", text)
PYTHON

# The same numbers whatever the order of the values and the number of threads.
cp results/gas/convergence-orders.csv before.csv
levels='[1 mm, 4 mm, 2 mm]'
study 0 again.log --set "$(order 'at_least: 0.2, source: theory')" --threads 1
cmp before.csv results/gas/convergence-orders.csv || fail "another order of the values gives other orders"

"$BOLIDE" verify --convergence "$gas" --set "$(order 'at_least: 0.2')" >there.log 2>&1
[ $? = 2 ] || fail "a study that is there was replaced: $(cat there.log)"
says there.log "results/gas: already contains a convergence study (--overwrite replaces it)"
cmp before.csv results/gas/convergence-orders.csv || fail "a study that is there was changed"

study 1 fails.log --set "$(order 'at_least: 3')" --output all
says fails.log "riemann/gas: 1 of 1 orders failed"
says all/riemann/gas/convergence.html "Failed: 1 of 1 orders."
study 0 short.log --set "$(order 'at_least: 3, known_deviation: it is a first-order method')"
says short.log "known deviation: it is a first-order method"
study 1 now.log --set "$(order 'at_least: 0.1, known_deviation: it is a first-order method')"
says now.log "passes now"

# Without a word in the case: the resolution times 4, 2 and 1; an error that the runs tell by themselves.
study 0 plain.log --set resolution=1mm --set 'convergence={estimate: [pressure left], of: [L1 of pressure]}'
says plain.log "4 mm          2 mm          1 mm"
grep -q '^pressure left: .*\(grid convergence index\|nothing to extrapolate\)' plain.log ||
    fail "no estimate: $(cat plain.log)"

# Studies that cannot be made say why and write nothing.
rm -rf results
study 2 same.log --set 'convergence={vary: run.until, values: [1 ms, 2 ms]}'
says same.log "give the same resolution"
study 2 fixed.log --set bodies.left.resolution=1mm --set 'convergence={values: [2 mm, 1 mm]}'
says fixed.log "bodies.left.resolution: a convergence study refines all bodies"
study 2 two.log --set 'convergence={values: [2 mm, 1 mm], estimate: [pressure left]}'
says two.log "at least three runs are needed"
study 2 value.log --set 'convergence={values: [2 mm, 1 s, 1 mm]}'
says value.log 'expected a length (m)'
study 2 nothing.log --set 'convergence={values: [2 mm, 1 mm]}' --set 'checks={mass: {conserved: mass, within: 1}}'
says nothing.log "name what is to be studied"
[ ! -e results ] || fail "something was written: $(find results)"
"$BOLIDE" verify --convergence >usage.log 2>&1
[ $? = 2 ] || fail "a study of nothing: $(cat usage.log)"

# Runs that fail are told, and their numbers left out; one that is stopped leaves the page as it was.
gas=$BOLIDE_SOURCE_DIR/examples/riemann/gas-standard/case.yaml
study 3 drift.log --set 'convergence={values: [4 mm, 2 mm, 0.5 mm]}' --set run.until=4ms \
    --set solver.sph.courant=0.4 --set run.energy_drift=1e-3
says drift.log "energy has drifted"
says drift.log "gas-standard/resolution=0.5_mm: could not run"
[ -s results/gas-standard/convergence.html ] || fail "no page of the other runs"
mkdir results/gas
echo before >results/gas/convergence.html
gas=$BOLIDE_SOURCE_DIR/examples/riemann/gas/case.yaml
"$BOLIDE" verify --convergence "$gas" --set 'convergence={values: [1 mm, 0.5 mm, 2 um]}' >stopped.log 2>&1 &
runner=$!
while [ ! -s results/gas/convergence/resolution=2_um/history.csv ] && kill -0 $runner 2>/dev/null; do
    sleep 0.02
done
kill -TERM $runner
wait $runner
[ $? = 143 ] || fail "stopped: $(cat stopped.log)"
[ "$(cat results/gas/convergence.html)" = before ] || fail "a stopped study wrote its page"
exit $status
