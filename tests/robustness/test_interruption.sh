#!/bin/bash
# A run that is killed, asked to stop, or out of disk: it resumes to the same bits, and no file is half there.
set -u
case=$BOLIDE_SOURCE_DIR/examples/impact/steel-cube-0/case.yaml
settings=(--set "run.until=20us" --set "output.every=5us" --set "output.checkpoint=0.1s"
    --set "output.pictures=[]" --set "probes={cube: {body: cube}, front: {front: {field: pressure, half: yes}, axis: z},
        tracer: {tracer: [1 mm, 2 mm, -3 mm]}, gauge: {gauge: [0 mm, 0 mm, -5 mm], every: 1 us}}"
    --set "profiles={along: {fields: pressure, along: z, by: body}}"
    --set "checks={energy: {conserved: energy, within: 1e-12},
        slowed: {recorded: {probe: cube, column: velocity.z, take: range}, at_least: 10 m/s}}")
status=0
fail() {
    echo "FAILED: $*"
    status=1
}
# What two runs recorded, to the last bit.
same() {
    cmp "$1/history.csv" "$2/history.csv" && cmp "$1/checks.csv" "$2/checks.csv" &&
        diff -rq "$1/probes" "$2/probes" && diff -rq "$1/profiles" "$2/profiles"
}

rm -rf whole killed stopped full
"$BOLIDE" run "$case" "${settings[@]}" --output whole >whole.log 2>&1 || fail "the whole run: $(cat whole.log)"

# Killed at once when its first checkpoint is there.
"$BOLIDE" run "$case" "${settings[@]}" --output killed >killed.log 2>&1 &
runner=$!
while [ ! -e killed/checkpoint.h5 ] && kill -0 $runner 2>/dev/null; do sleep 0.02; done
kill -KILL $runner 2>/dev/null
wait $runner 2>/dev/null
"$BOLIDE" run "$case" "${settings[@]}" --output killed --resume >killed.log 2>&1 ||
    fail "resuming after a kill: $(cat killed.log)"
same whole killed || fail "a killed and resumed run differs"

# Asked to stop: it writes a checkpoint, says so, and ends with 128 + the signal.
"$BOLIDE" run "$case" "${settings[@]}" --set "output.checkpoint=0s" --output stopped >stopped.log 2>&1 &
runner=$!
while [ ! -s stopped/history.csv ] && kill -0 $runner 2>/dev/null; do sleep 0.02; done
kill -TERM $runner
wait $runner
[ $? = 143 ] || fail "a stopped run must end with 143: $(cat stopped.log)"
"$BOLIDE" run "$case" "${settings[@]}" --set "output.checkpoint=0s" --output stopped --resume \
    >stopped.log 2>&1 || fail "resuming after a stop: $(cat stopped.log)"
same whole stopped || fail "a stopped and resumed run differs"

# No file may grow beyond 64 KB: the run ends with 4 and leaves no snapshot under its final name.
(
    trap '' XFSZ
    ulimit -f 64
    "$BOLIDE" run "$case" "${settings[@]}" --output full >full.log 2>&1
)
[ $? = 4 ] || fail "a full disk must end with 4: $(cat full.log)"
[ ! -e full/snapshots/000000.vtkhdf ] || fail "half a snapshot has its final name"
exit $status
