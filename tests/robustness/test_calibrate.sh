#!/bin/bash
# bolide calibrate: keys come out of synthetic measurements; what targets cannot tell apart is said.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"
rm -rf results few one bound none slow shifted wrong exact
cat >plate.yaml <<'YAML'
format: 1
dimension: 1
resolution: plate/30
solver: sph
let: {speed: 500 m/s, plate: 2 mm, c: 5.35 km/s, k: 1.34, p: 1 GPa, x: 4 mm}
materials:
  metal:
    eos: {mie-grueneisen: {density: 2710 kg/m^3, sound: c, slope: k, gamma: 2, bulk_modulus: 77 GPa}}
bodies:
  flyer: {material: metal, box: {from: [0 mm], to: [plate]}, velocity: [speed]}
  target: {material: metal, box: {from: [plate], to: [3*plate]}}
run: {until: 0.3 us}
output: {snapshots: no}
probes:
  gauge: {tracer: [1.75*plate], of: target, fields: [pressure]}
checks:
  pressure: {mean: pressure, of: target, between: [2.2 mm, 2.6 mm], at: 0.25 us, is: p, within: 0.2 %}
  front: {front: {field: pressure, value: 1 GPa}, of: target, at: 0.25 us, is: x, within: 0.1 %}
YAML
# The measurements: what the case computes with the keys as they stand.
measured() {
    "$BOLIDE" run plate.yaml --threads 1 --output truth --overwrite --set "let.speed=$1" >log 2>&1
    awk -F, -v check="\"$2\"" '$1 == check { print $4 }' truth/checks.csv
}
for speed in 500m/s 2000m/s; do
    p+=("$(measured $speed pressure) Pa")
    x+=("$(measured $speed front) m")
done
cp truth/probes/gauge.csv trace.csv
cat >two.yaml <<YAML
include: plate.yaml
sweep: {test: {speed: [500 m/s, 2 km/s], p: ["${p[0]}", "${p[1]}"], x: ["${x[0]}", "${x[1]}"]}}
calibrate:
  keys:
    c: {from: 4.5 km/s, to: 6 km/s}
    k: {from: 0.8, to: 1.8, scale: log}
  targets: {pressure: {check: pressure}, front: {check: front}}
  within: 0.05
YAML
# calibrate STATUS WORDS FILE OPTIONS...: the status and the words that the answer must have.
calibrate() {
    local wanted=$1 words=$2
    shift 2
    "$BOLIDE" calibrate "$@" --threads 1 >log 2>&1
    local got=$?
    [ $got = "$wanted" ] || fail "$*: status $got, wanted $wanted: $(cat log)"
    grep -qF -- "$words" log || fail "$* does not say \"$words\": $(cat log)"
}
# near FOLDER KEY VALUE: the key came out within 1 %.
near() {
    awk -F, -v key="\"$2\"" -v is="$3" '$1 == key && ($2 - is)^2 < (0.01 * is)^2 { found = 1 } END { exit !found }' \
        "$1/calibrate-keys.csv" || fail "$2 is not near $3: $(cat "$1/calibrate-keys.csv")"
}
two=results/two-calibrate
calibrate 0 "misfit" two.yaml
near $two c 5350
near $two k 1.34
[ "$(wc -l <$two/calibrate.csv)" -le 9 ] || fail "more than 8 runs: $(cat $two/calibrate.csv)"
[ -s $two/report.html ] || fail "no report"
grep -q '"c": 5' $two/calibrated.yaml || fail "no include: $(cat $two/calibrated.yaml)"

# No run is repeated: the table and the folders stay as they are. One that lacks is computed again.
touch -d 2001-01-01 $two/run-*/report.html $two/run-*/*/report.html
cp $two/calibrate.csv before.csv
calibrate 0 "misfit" two.yaml --resume
cmp before.csv $two/calibrate.csv || fail "resumed, the table is another"
[ -z "$(find $two/run-* -name report.html -newermt 2002-01-01)" ] || fail "resumed, runs were repeated"
sed -i '$d' $two/calibrate.csv
calibrate 0 "misfit" two.yaml --resume
cmp before.csv $two/calibrate.csv || fail "with a run repeated, the table is another"
calibrate 2 "already contains the results of a calibration" two.yaml
calibrate 2 "had other keys or targets" two.yaml --resume --set calibrate.keys.k=
calibrate 1 "continue with --resume --set calibrate.runs=8" two.yaml --output few --set calibrate.runs=4

# With one speed, and its pressure alone, the two keys cannot be told apart.
calibrate 0 "the targets do not tell it apart from c" two.yaml --output one --set 'sweep={}' \
    --set "let.p=${p[0]}" --set 'calibrate.targets={pressure: {check: pressure}}'
grep -q "do not tell it apart" one/report.html || fail "the report does not say so"
# A key at its bound, one without influence.
calibrate 0 "at its upper bound" two.yaml --output bound --set calibrate.keys.k= \
    --set 'calibrate.keys.c.to=5.2 km/s'
calibrate 0 "without influence on any target" two.yaml --output none --set let.idle=1 \
    --set 'calibrate.keys={c: {from: 4.5 km/s, to: 6 km/s}, idle: {from: 1, to: 2}}'

# A run without a value has no misfit; the first one must have one.
slow=(--set sweep={} --set "let.p=${p[0]}" --set "let.x=${x[0]}" --set 'calibrate.within=0.5')
calibrate 1 "front: nothing was measured" two.yaml --output wrong "${slow[@]}" \
    --set 'calibrate.keys={speed: {from: 20 m/s, to: 2 km/s, start: 20 m/s}}'
calibrate 0 "speed = 499.9" two.yaml --output slow "${slow[@]}" \
    --set 'calibrate.keys={speed: {from: 20 m/s, to: 2 km/s, start: 250 m/s}}'

# Measured traces, their time unknown, in two cases.
cat >slow.yaml <<YAML
include: plate.yaml
let: {p: ${p[0]}, x: ${x[0]}}
YAML
cat >traced.yaml <<YAML
include: plate.yaml
let: {speed: 2 km/s}
calibrate:
  keys: {c: {from: 4.5 km/s, to: 6 km/s}, k: {from: 0.8, to: 1.8}}
  targets:
    trace: {probe: gauge, field: pressure, data: trace.csv, deviation: 0.1 GPa, value: pressure}
    slow: {check: front, case: slow.yaml}
  cases: [slow.yaml]
  within: 0.05
YAML
calibrate 0 "trace: root mean square difference" traced.yaml
near results/traced-calibrate c 5350
near results/traced-calibrate k 1.34
calibrate 0 "misfit" traced.yaml --output shifted --set calibrate.targets.trace.shift=fit
calibrate 2 'the probe has no column "stress" (known: position.x, pressure' traced.yaml --output wrong --overwrite --set calibrate.targets.trace.field=stress
calibrate 2 '`deviation` is in m, but the column is' traced.yaml --output wrong --set 'calibrate.targets.trace.deviation=1 mm' --overwrite

# Columns: what is no time, not like the field, or without a unit is refused before the first run.
rm -rf wrong
python3 - <<'PYTHON'
rows = [line.rstrip("\n").split(",") for line in open("trace.csv")]
at = [head.split(" [")[0] for head in rows[0]].index("pressure")
for name, factor, *heads in [("units", 1, "t_us", "p"), ("kilos", 1, "time [us]", "p [kg]"), ("metres", 1, "time [m]", "pressure [Pa]"),
                             ("later", 1, "time [us]", "p [GPa]")]:
    with open(name + ".csv", "w") as out:
        print(*heads, sep=",", file=out)
        for row in rows[1:]:
            time = float(row[0]) * 1e6 + (3.7 if name == "later" else 0)
            print(time, float(row[at]) * (1e-9 if name != "metres" else 1), sep=",", file=out)
with open("second.csv", "w") as out: # the column of the field is not the second
    for row in rows:
        print(row[0], "position.x [m]" if row is rows[0] else 0, row[at], sep=",", file=out)
PYTHON
# refused WORDS KEYS...: `check` and `calibrate` refuse the trace with KEYS, and nothing was run.
refused() {
    local words=$1 settings=()
    shift
    for key; do settings+=(--set "calibrate.targets.trace.$key"); done
    calibrate 2 "$words" traced.yaml --output wrong "${settings[@]}"
    "$BOLIDE" check traced.yaml "${settings[@]}" >log 2>&1
    [ $? = 2 ] && grep -qF -- "$words" log || fail "check, $*: not \"$words\": $(cat log)"
    [ ! -e wrong ] || fail "$*: a run was begun"
}
refused 'there is no such table' data=none.csv
refused 'no unit in `t_us`; write `time: t_us:us`' data=units.csv value=
refused 'no unit in `p`; write `value: p:Pa`' data=units.csv value= time=t_us:us
refused '`p [kg]` is not a quantity like `pressure`, which is in Pa (known: time [us], p [kg])' data=kilos.csv value=
refused '`time [m]` is not a time' data=metres.csv
refused 'the unit of `pressure:kg` contradicts that of the column, `pressure [Pa]`' value=pressure:kg
refused '`position.x [m]` is not a quantity like `pressure`' 'value=position.x'
refused 'there is no column "stress" (known: time [s], position.x [m], pressure [Pa])' data=second.csv value=stress
refused 'trace (3.7 us to 4 us) does not overlap the probe (0 s to 300 ns): give a `shift`' data=later.csv value=
refused 'unknown unit "MPascal"' value=pressure:MPascal
exact() {
    calibrate 0 "run 1: c = 5.35 km/s" traced.yaml --output exact --overwrite --set calibrate.keys.k= \
        --set calibrate.keys.c.start=5.35km/s --set calibrate.within=0.001 "$@"
    grep -q "^  trace: .* misfit \(0\|[0-9.]*e-.*\)$" log || fail "$*: not an exact fit: $(cat log)"
}
exact --set calibrate.targets.trace.data=second.csv --set calibrate.targets.trace.value=
exact --set calibrate.targets.trace.data=second.csv --set 'calibrate.targets.trace.value=pressure [Pa]'
exact --set calibrate.targets.trace.data=units.csv --set calibrate.targets.trace.value=p:GPa --set calibrate.targets.trace.time=t_us:us
# A zero that is far off.
exact --set calibrate.targets.trace.data=later.csv --set calibrate.targets.trace.value= --set calibrate.targets.trace.shift=fit
exact --set calibrate.targets.trace.data=later.csv --set calibrate.targets.trace.value= --set calibrate.targets.trace.shift=-3.7us

calibrate 2 '`is` is in m, but the check measures in Pa' two.yaml --output wrong --set 'calibrate.targets.pressure.is=1 mm' --overwrite
calibrate 2 'there is no `calibrate`' plate.yaml
exit $status
