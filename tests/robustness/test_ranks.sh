#!/bin/bash
# One case on several ranks: the same bits as on one, whatever the method, when space is divided anew, and after a kill
# that is resumed on another number of ranks. One message when a rank fails. $BOLIDE_MPIRUN starts several processes.
set -u
examples=$BOLIDE_SOURCE_DIR/examples
status=0
fail() {
    echo "FAILED: $*"
    status=1
}
on() {
    local ranks=$1
    shift
    OMP_NUM_THREADS=1 $BOLIDE_MPIRUN -n "$ranks" "$BOLIDE" "$@" </dev/null
}
hash_of() { grep -o '"hash","[0-9a-f]*"' "$1/summary.csv"; }
# What two runs wrote, to the last bit.
same() {
    [ -n "$(hash_of "$1")" ] && [ "$(hash_of "$1")" = "$(hash_of "$2")" ] || return 1
    for part in history.csv checks.csv probes profiles pictures snapshots; do
        [ ! -e "$1/$part" ] || diff -rq "$1/$part" "$2/$part" || return 1
    done
}

# Every method, geometry and law, a few steps each.
while read -r name steps; do
    folder=$(basename "$name")
    run=(run "$examples/$name/case.yaml" --short --overwrite --set "run.max_steps=$steps" --set "run.energy_drift=0")
    "$BOLIDE" "${run[@]}" --output "$folder-1" >"$folder.log" 2>&1
    on 2 "${run[@]}" --output "$folder-2" >"$folder.log" 2>&1
    same "$folder-1" "$folder-2" || fail "$name on 2 ranks: $(tail -n 5 "$folder.log")"
    on 4 "${run[@]}" --set run.rebalance=20 --set "output.pictures=[]" --output "$folder-4" >"$folder.log" 2>&1
    [ "$(hash_of "$folder-1")" = "$(hash_of "$folder-4")" ] || fail "$name divided anew on 4 ranks: $(tail -n 5 "$folder.log")"
done <<EOF
porous-aluminium/demo 45
rotation/disc-corrected 45
axisymmetric/rod-breathing 45
heat/aluminium-brass 45
riemann/gas-standard 45
elastic-plastic/aluminium-hllc 45
beryllium-shell/monaghan 40
impact/steel-cube-30 45
impact/piston 45
rubber/cylinders 45
shear/water-layer-3d 25
EOF

# Killed when its first checkpoint is there, and resumed on other numbers of ranks, one among them.
settings=(--set "run.until=20us" --set "output.every=5us" --set "output.checkpoint=0.1s"
    --set "output.pictures=[]" --set "probes={cube: {body: cube}, front: {front: {field: pressure, half: yes}, axis: z},
        tracer: {tracer: [1 mm, 2 mm, -3 mm]}, gauge: {gauge: [0 mm, 0 mm, -5 mm], every: 1 us}}"
    --set "profiles={along: {fields: pressure, along: z, by: body}}"
    --set "checks={energy: {conserved: energy, within: 1e-12},
        slowed: {recorded: {probe: cube, column: velocity.z, take: range}, at_least: 10 m/s}}")
case=$examples/impact/steel-cube-0/case.yaml
rm -rf whole killed
"$BOLIDE" run "$case" "${settings[@]}" --output whole >whole.log 2>&1 || fail "the whole run: $(cat whole.log)"
on 2 run "$case" "${settings[@]}" --output killed >killed.log 2>&1 &
runner=$!
while [ ! -e killed/checkpoint.h5 ] && kill -0 $runner 2>/dev/null; do sleep 0.02; done
rank=$(pgrep -n -P $runner)
kill -KILL "${rank:-$runner}" 2>/dev/null
wait $runner 2>/dev/null && fail "a run with a killed rank must fail"
on 3 run "$case" "${settings[@]}" --output killed --resume >killed.log 2>&1 ||
    fail "resuming after a kill: $(cat killed.log)"
for part in history.csv checks.csv probes profiles; do
    diff -rq "whole/$part" "killed/$part" || fail "killed on 2 ranks and resumed on 3: $part differs"
done
[ "$(hash_of whole)" = "$(hash_of killed)" ] || fail "killed on 2 ranks and resumed on 3"

# A mistake is told once, an impossible state too.
on 2 run "$case" --set "bodies.cube.material=cheese" --output wrong >wrong.log 2>&1
[ "$(grep -c cheese wrong.log)" = 1 ] || fail "a mistake must be told once: $(cat wrong.log)"
on 2 run "$case" --set "run.energy_drift=1e-30" --output wrong --overwrite >wrong.log 2>&1
[ "$(grep -c 'total energy has drifted' wrong.log)" = 1 ] || fail "a failure must be told once: $(cat wrong.log)"
exit $status
