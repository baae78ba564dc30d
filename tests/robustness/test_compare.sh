#!/bin/bash
# bolide compare: several runs and a measurement in one page, their differences, and plots that a browser draws.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"
cat >plate.yaml <<'END'
format: 1
dimension: 1
let: {speed: 400 m/s}
resolution: 50 um
solver: sph
materials: {aluminium: {library: aluminium}}
bodies:
  flyer:  {material: aluminium, box: {from: [-2 mm], to: [0 mm]}, velocity: [speed]}
  target: {material: aluminium, box: {from: [0 mm], to: [5 mm]}}
run: {until: 1 us}
output: {pictures: []}
probes: {gauge: {tracer: [2 mm], fields: [pressure, velocity]}}
END
rm -rf a b compare bare none
"$BOLIDE" run plate.yaml --output a >a.log 2>&1 || fail "$(tail -n 3 a.log)"
"$BOLIDE" run plate.yaml --set let.speed=500m/s --output b >b.log 2>&1 || fail "$(tail -n 3 b.log)"
# A comparison that fails leaves no file.
cp -r a bare && rm -rf bare/probes
"$BOLIDE" compare bare --output none >none.log 2>&1
[ $? = 2 ] && [ -z "$(ls -A none)" ] || fail "files of a comparison that failed: $(ls -A none) $(cat none.log)"
# What run a has, 20 ns later, in other units.
python3 - <<'PYTHON'
import csv
rows = list(csv.reader(open("a/probes/gauge.csv")))
column = [head.startswith("pressure") for head in rows[0]].index(True)
with open("test.csv", "w") as out:
    out.write("t_us,p\n")
    for row in rows[1::20]:
        out.write(f"{float(row[0]) * 1e6 + .02},{float(row[column]) * 1e-9}\n")
PYTHON
"$BOLIDE" compare a b --data test.csv,time=t_us:us,value=p:GPa,probe=gauge,field=pressure >compare.log 2>&1 ||
    fail "compare: $(cat compare.log)"
python3 - <<'PYTHON' || fail "compare.csv: $(cat compare/compare.csv)"
import csv
a, b = csv.DictReader(open("compare/compare.csv"))
assert abs(float(a["shift [s]"]) + 20e-9) < 2e-9, a
assert abs(float(a["largest"])) < 0.05e9 < float(b["largest"]), (a, b)
assert float(a["rms"]) < float(b["rms"])
PYTHON
"$BOLIDE" compare a --data test.csv,tme=t_us:us >wrong.log 2>&1
[ $? = 2 ] || fail "a wrong key: $(cat wrong.log)"
# refused WORDS DATA: the measured series is refused.
refused() {
    "$BOLIDE" compare a --data "$2" >wrong.log 2>&1
    [ $? = 2 ] && grep -qF -- "$1" wrong.log || fail "$2: not \"$1\": $(cat wrong.log)"
}
pressure=probe=gauge,field=pressure
refused 'no unit in `t_us`; write `time=t_us:us`' test.csv,value=p:GPa,$pressure
refused '`p:kg` is not a quantity like `pressure`' test.csv,time=t_us:us,value=p:kg,$pressure
refused 'there is no column "q" (known: t_us, p)' test.csv,time=t_us:us,value=q:GPa,$pressure
refused 'a/probes/gauge.csv: there is no column "stress" (known: ' test.csv,time=t_us:us,value=p:GPa,probe=gauge,field=stress
refused 'a has no probe "gage"' test.csv,time=t_us:us,value=p:GPa,probe=gage,field=pressure
refused 'field= is missing' test.csv,time=t_us:us,value=p:GPa,probe=gauge
"$BOLIDE" compare a --data none.csv >wrong.log 2>&1
[ $? = 2 ] || fail "a missing file: $(cat wrong.log)"
# The exact solution that a gauge recorded is a line in the plot of its pressure: one, where runs have the same.
rm -rf exact coarse twice
cp -r a exact
cp -r b coarse
python3 - <<'PYTHON'
import csv
for run in ("exact", "coarse"):
    path = run + "/probes/gauge.csv"
    rows = list(csv.reader(open(path)))
    with open(path, "w") as out:
        csv.writer(out).writerows([row + ([f"{2e12 * float(row[0]):.9g}"] if i else ["exact [Pa]"]) for i, row in enumerate(rows)])
PYTHON
"$BOLIDE" compare exact coarse --output twice >twice.log 2>&1 || fail "with exact solutions: $(cat twice.log)"
python3 - <<'PYTHON' || fail "the exact solution in twice/compare.html"
import json, re
plots = [json.loads(data) for data in re.findall(r'application/json">(.*?)</script>', open("twice/compare.html").read(), re.S)]
names = [[(s["name"], s["dashed"]) for s in p["series"]] for p in plots]
assert len(plots) == 3, names
assert names[[p["unit"] for p in plots].index("GPa")] == [("exact", 0), ("coarse", 0), ("exact", 1)], names
PYTHON
if [ ! -x /usr/bin/chromium ]; then
    echo "no browser is installed: the page was not opened"
    exit $status
fi
home=$(mktemp -d)
trap 'rm -rf "$home"' EXIT
cat >probe.txt <<'HTML'
<script>
const group = bolidePlots[0], plot = group.plots[0], span = group.view()[1] - group.view()[0];
const lines = group.plots.map(p => p.data.series.length);
group.plots[0].graph.updateOptions({dateWindow: [group.view()[0], group.view()[0] + span / 2]});
const button = document.querySelector('p.controls button');
if (button) { button.click(); button.click(); }
document.title = 'lines ' + lines + '; requests ' + performance.getEntriesByType('resource').length;
</script>
HTML
cat compare/compare.html probe.txt >probed.html
timeout 600 /usr/bin/chromium --headless --no-sandbox --disable-gpu --user-data-dir="$home" --dump-dom \
    "file://$PWD/probed.html" >seen.html 2>browser.log
grep -q '<title>lines 2,3,2; requests 0' seen.html || fail "the page: $(grep -o '<title>[^<]*' seen.html)"
exit $status
