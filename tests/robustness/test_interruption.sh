#!/bin/bash
# A run that is killed, asked to stop, or out of disk: it resumes to the same bits, and no file is half there.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"
case=$BOLIDE_SOURCE_DIR/examples/impact/steel-cube-0/case.yaml
settings=(--set "run.until=20us" --set "output.every=5us" --set "output.checkpoint=0.1s"
    --set "output.pictures=[]" --set "probes={cube: {body: cube}, front: {front: {field: pressure, half: yes}, axis: z},
        tracer: {tracer: [1 mm, 2 mm, -3 mm]}, gauge: {gauge: [0 mm, 0 mm, -5 mm], every: 1 us}}"
    --set "profiles={along: {fields: pressure, along: z, by: body}}"
    --set "checks={energy: {conserved: energy, within: 1e-12},
        slowed: {recorded: {probe: cube, column: velocity.z, take: range}, at_least: 10 m/s}}")
# What two runs recorded, to the last bit.
same_records() {
    cmp "$1/history.csv" "$2/history.csv" && cmp "$1/checks.csv" "$2/checks.csv" &&
        diff -rq "$1/probes" "$2/probes" && diff -rq "$1/profiles" "$2/profiles"
}

rm -rf whole killed stopped full changed gone damaged
"$BOLIDE" run "$case" "${settings[@]}" --output whole >whole.log 2>&1 || fail "the whole run: $(cat whole.log)"

# Killed at once when its first checkpoint is there.
"$BOLIDE" run "$case" "${settings[@]}" --output killed >killed.log 2>&1 &
runner=$!
await $runner killed/checkpoint.h5
kill -KILL $runner 2>/dev/null
wait $runner 2>/dev/null
"$BOLIDE" run "$case" "${settings[@]}" --output killed --resume >killed.log 2>&1 ||
    fail "resuming after a kill: $(cat killed.log)"
same_records whole killed || fail "a killed and resumed run differs"

# Asked to stop: it writes a checkpoint, says so, and ends with 128 + the signal.
"$BOLIDE" run "$case" "${settings[@]}" --set "output.checkpoint=0s" --output stopped >stopped.log 2>&1 &
runner=$!
await $runner stopped/history.csv
kill -TERM $runner
wait $runner
[ $? = 143 ] || fail "a stopped run must end with 143: $(cat stopped.log)"
"$BOLIDE" run "$case" "${settings[@]}" --set "output.checkpoint=0s" --output stopped --resume \
    >stopped.log 2>&1 || fail "resuming after a stop: $(cat stopped.log)"
same_records whole stopped || fail "a stopped and resumed run differs"

# Every signal that would end the program stops a run with a checkpoint. Two at once are one request.
cat >long.yaml <<'END'
format: 1
dimension: 1
resolution: 20 um
solver: sph
materials: {aluminium: {library: aluminium}}
bodies:
  flyer: {material: aluminium, box: {from: [-4 mm], to: [0 mm]}, velocity: [1 km/s]}
  target: {material: aluminium, box: {from: [0 mm], to: [8 mm]}}
run: {until: 20 us}
output: {history: 0.1 us}
END
# begin FOLDER COMMAND...: the runner of long.yaml in FOLDER, which has begun.
begin() {
    rm -rf "$1"
    env --default-signal "${@:2}" "$BOLIDE" run long.yaml --output "$1" >"$1.log" 2>&1 &
    runner=$!
    await $runner "$1/history.csv"
}
# stopped FOLDER SIGNAL STATUS: the run was stopped by SIGNAL.
stopped() {
    [ "$3" = $((128 + $(kill -l "$2"))) ] ||
        fail "a run must end by SIG$2, but its status is $3: $(cat "$1.log")"
    [ -s "$1/checkpoint.h5" ] || fail "SIG$2: no checkpoint"
    grep -q '"status","stopped"' "$1/summary.csv" || fail "SIG$2: no report"
}
for signal in INT HUP QUIT PIPE XCPU; do
    begin signal
    kill -$signal $runner
    kill -$signal $runner 2>/dev/null
    wait $runner
    stopped signal $signal $?
done
rm -rf signal
env --default-signal "$BOLIDE" run long.yaml --output signal 2>signal.log | head -n 1 >/dev/null
stopped signal PIPE ${PIPESTATUS[0]}

# Under nohup a run outlives its terminal; SIGUSR1 asks for a checkpoint, and the run continues.
begin signal nohup
kill -HUP $runner
kill -USR1 $runner
await $runner signal/checkpoint.h5
sleep 0.1
kill -0 $runner 2>/dev/null ||
    fail "SIGUSR1 or an ignored SIGHUP has ended a run: $(cat signal.log)"
kill -TERM $runner
wait $runner
stopped signal TERM $?
grep -q "^checkpoint at step" signal/run.log ||
    fail "a checkpoint that was asked for is not reported"

# A run that stops on a drift of energy leaves its state; with a larger limit it goes on from there as
# if it had never stopped.
gas=$BOLIDE_SOURCE_DIR/examples/riemann/gas-standard/case.yaml
drifts=(--set solver.sph.courant=0.4 --set "output.every=1 ms" --set output.pictures=[]
    --set "probes={gauge: {gauge: [50 mm], every: 0.1 ms}}")
rm -rf drifted undrifted
"$BOLIDE" run "$gas" "${drifts[@]}" --set run.energy_drift=0 --output undrifted >undrifted.log 2>&1
"$BOLIDE" run "$gas" "${drifts[@]}" --set run.energy_drift=1e-3 --output drifted >drifted.log 2>&1
[ $? = 3 ] || fail "a drift must end with 3: $(cat drifted.log)"
grep -q "^checkpoint.h5 holds step" drifted/run.log ||
    fail "the checkpoint of a failure is not reported"
[ -s drifted/snapshots/failed.vtkhdf ] || fail "no snapshot of a failure"
"$BOLIDE" run "$gas" "${drifts[@]}" --set run.energy_drift=0 --output drifted --resume \
    >drifted.log 2>&1
cmp drifted/history.csv undrifted/history.csv && diff -r drifted/probes undrifted/probes &&
    cmp drifted/checks.csv undrifted/checks.csv || fail "resumed after a drift: $(cat drifted.log)"

# A step that collapses ends the run, which says where.
"$BOLIDE" run long.yaml --set "run.until=200 ns" --output collapsed --overwrite \
    --set "materials.aluminium={eos: {mie-grueneisen: {density: 2700 kg/m^3, sound: 5300 m/s,
        slope: 1e9, gamma: 2, bulk_modulus: 76 GPa, form: source}}}" >collapsed.log 2>&1
[ $? = 3 ] || fail "a collapsed step must end with 3: $(cat collapsed.log)"
grep -q "step has collapsed to .* limited by sound speed, particle .* of body \"" collapsed.log ||
    fail "a collapsed step must be explained: $(cat collapsed.log)"
[ -s collapsed/checkpoint.h5 ] && [ -s collapsed/snapshots/failed.vtkhdf ] ||
    fail "nothing is left of a collapse"

# A run that nobody will wait for is warned of, before it begins and when it does.
"$BOLIDE" check long.yaml --set "run.until=100 s" >hopeless.log 2>&1
grep -q "warning: about .* steps are more than any run takes" hopeless.log ||
    fail "check does not warn of too many steps: $(cat hopeless.log)"
"$BOLIDE" run long.yaml --set "run.until=100 s" --output hopeless --overwrite >hopeless.log 2>&1 &
runner=$!
for ((i = 0; i < 1000; i++)); do # 20 s, for a busy machine
    grep -q "^warning: with steps of" hopeless.log && break
    kill -0 $runner 2>/dev/null || break
    sleep 0.02
done
kill $runner
wait $runner
grep -q "^warning: with steps of .* the run needs .* steps" hopeless.log ||
    fail "run does not warn of too many steps: $(cat hopeless.log)"

# Rows that were changed since the checkpoint are not gone on after.
cp -r drifted changed
sed -i '3s/[0-9]/7/' changed/history.csv
"$BOLIDE" run "$gas" "${drifts[@]}" --set run.energy_drift=0 --output changed --resume \
    >changed.log 2>&1
[ $? = 2 ] && grep -q "changed/history.csv: its first .* rows are not those" changed.log ||
    fail "a changed history must be refused: $(cat changed.log)"
cp drifted/history.csv changed
sed -i '3s/[0-9]/7/' changed/probes/gauge.csv
"$BOLIDE" run "$gas" "${drifts[@]}" --set run.energy_drift=0 --output changed --resume \
    >changed.log 2>&1
[ $? = 2 ] && grep -q "changed/probes/gauge.csv: its first .* rows are not those" changed.log ||
    fail "a changed probe must be refused: $(cat changed.log)"

# Snapshots that were removed are missed, and the series does not list them.
cp -r drifted gone
rm gone/snapshots/00000[1-3].vtkhdf
"$BOLIDE" run "$gas" "${drifts[@]}" --set run.energy_drift=0 --output gone --resume >gone.log 2>&1 ||
    fail "resuming without some snapshots: $(cat gone.log)"
grep -q "^warning: 3 of .* snapshots that were written are gone, snapshots/000001.vtkhdf first" gone/run.log ||
    fail "snapshots that are gone are not missed: $(cat gone.log)"
grep -q 000000.vtkhdf gone/snapshots.vtkhdf.series && ! grep -q 00000[1-3].vtkhdf gone/snapshots.vtkhdf.series ||
    fail "the series lists what is gone: $(cat gone/snapshots.vtkhdf.series)"
grep -q "snapshots that were written are gone" drifted.log && fail "no snapshot of drifted was gone"

# One that was damaged is named.
cp -r drifted damaged
size=$(stat -c %s damaged/snapshots/000002.vtkhdf)
printf '\x55' | dd of=damaged/snapshots/000002.vtkhdf bs=1 seek=$((size / 2)) conv=notrunc 2>/dev/null
"$BOLIDE" run "$gas" "${drifts[@]}" --set run.energy_drift=0 --output damaged --resume >damaged.log 2>&1 ||
    fail "resuming with a damaged snapshot: $(cat damaged.log)"
grep -q "^warning: 1 of .* snapshots are not what the run wrote, .* snapshots/000002.vtkhdf first" damaged/run.log ||
    fail "a damaged snapshot is not named: $(cat damaged.log)"
grep -q "not what the run wrote" drifted.log gone.log && fail "snapshots of drifted are whole"

# No file may grow beyond 64 KB: the run ends with 4 and leaves no snapshot under its final name.
(
    trap '' XFSZ
    ulimit -f 64
    "$BOLIDE" run "$case" "${settings[@]}" --output full >full.log 2>&1
)
[ $? = 4 ] || fail "a full disk must end with 4: $(cat full.log)"
[ ! -e full/snapshots/000000.vtkhdf ] || fail "half a snapshot has its final name"
exit $status
