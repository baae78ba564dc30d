#!/bin/bash
# Cases on several ranks: the same bits as on one, whatever the method, when space is divided anew, and after a kill
# that is resumed on another number of ranks. One message when a rank fails. $BOLIDE_MPIRUN starts several processes.
set -u
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
# What two runs wrote, to the last bit, but for what tells of the running itself.
same() {
    [ -n "$(hash_of "$1")" ] && [ "$(hash_of "$1")" = "$(hash_of "$2")" ] || return 1
    diff -rq -x summary.csv -x run.log -x report.html -x checkpoint.h5 -x case.yaml "${@:3}" "$1" "$2"
}
# The same where particles were sorted at other times: snapshots hold them in the order of storage.
same_but_for_order() { same "$1" "$2" -x snapshots; }

# Every method, geometry and law, a few steps each: what their checks say of so few does not count.
names="riemann/gas-standard riemann/gas-second-order heat/aluminium-brass elastic-plastic/aluminium
    elastic-plastic/aluminium-hllc beryllium-shell/monaghan axisymmetric/rod-breathing
    axisymmetric/gas-ball-second-order rotation/disc-corrected rotation/disc-second-order porous-aluminium/demo
    porous-aluminium/demo-second-order rubber/stiff-cylinders impact/steel-cube-30 shear/water-layer-3d"
cases=
for name in $names; do cases="$cases $BOLIDE_SOURCE_DIR/examples/$name/case.yaml"; done
few=(verify $cases --short --set run.max_steps=41 --set run.energy_drift=0 --set "output.pictures=[density]")
"$BOLIDE" "${few[@]}" --output one >one.log 2>&1
on 2 "${few[@]}" --output two >two.log 2>&1
on 4 "${few[@]}" --set run.rebalance=20 --output four >four.log 2>&1
for name in $names; do
    same "one/$name" "two/$name" || fail "$name on 2 ranks: $(tail -n 5 two.log)"
    same_but_for_order "one/$name" "four/$name" || fail "$name divided anew on 4 ranks: $(tail -n 5 four.log)"
done

# A piston that stops, a contact, a wall, and a frozen end out of which waves run, with all that may be recorded.
cat >space.yaml <<'CASE'
format: 1
dimension: 3
resolution: 0.25 mm
solver: {sph: {conduction: contact}}
let: {stopped: 0.5 us}
materials: {aluminium: {library: aluminium}}
bodies:
  piston:
    material: aluminium
    velocity: [500 m/s, 0 m/s, 0 m/s]
    driven: yes
    stop: stopped
    box: {from: [-1 mm, 0 mm, 0 mm], to: [0 mm, 3 mm, 3 mm]}
  target: {material: aluminium, box: {from: [0 mm, 0 mm, 0 mm], to: [4 mm, 3 mm, 3 mm]}}
  bar: {material: aluminium, box: {from: [4 mm, 0 mm, 0 mm], to: [8 mm, 3 mm, 3 mm]}}
  end: {material: aluminium, frozen: yes, box: {from: [8 mm, 0 mm, 0 mm], to: [9 mm, 3 mm, 3 mm]}}
contacts:
  faces: {between: [target, bar], shear: slip, tension: none}
walls:
  below: {mirror: y, at: 0 mm, side: low}
probes:
  bar: {body: bar}
  front: {front: {field: pressure, half: yes, from: high}, of: target}
  tracer: {tracer: [1 mm, 2 mm, 2 mm]}
  gauge: {gauge: {at: [2 mm, 1 mm, 1 mm]}, every: 0.1 us}
profiles:
  along: {fields: [pressure, velocity.x], along: x, by: body, bins: 20}
run: {until: 1.2 us, rebalance: 20}
output: {every: 0.3 us, checkpoint: 0.2 s, pictures: [pressure, body]}
checks:
  mass: {conserved: mass, within: 1e-12}
  piston moved: {mean: displacement.x, of: piston, is: 500 m/s*stopped, within: 1e-12 m}
  piston stands: {maximum: speed, of: piston, at_most: 0 m/s}
  crumbs: {pieces: {link: 0.5}, at_least: 2}
  halves: {asymmetry: {field: velocity.y, across: y, center: [0 mm, 1.5 mm, 0 mm]}, at_least: 0}
  layers: {shear_layer: {speed: 1 m/s, plane: 1.5 mm}, at_least: 0 m^2/s}
  slabs: {front: {field: velocity.x, value: 10 m/s, slab: 0.5 mm}, at_least: 0 mm}
  wave: {front: {field: pressure, half: yes, from: low}, of: bar, at_least: 0 mm}
  bar is pushed: {recorded: {probe: bar, column: velocity.x, take: range}, at_least: 10 m/s}
CASE
rm -rf whole killed
"$BOLIDE" run space.yaml --output whole >whole.log 2>&1 || fail "the whole run: $(cat whole.log)"

# One rank is killed when the first checkpoint is there; others go on, in another number.
OMP_NUM_THREADS=1 $BOLIDE_MPIRUN -n 2 "$BOLIDE" run space.yaml --output killed >killed.log 2>&1 </dev/null &
runner=$!
while [ ! -e killed/checkpoint.h5 ] && kill -0 $runner 2>/dev/null; do sleep 0.02; done
rank=$(grep -l "^PPid:[[:space:]]*$runner\$" /proc/[0-9]*/status 2>/dev/null | tail -n 1)
rank=${rank//[^0-9]/}
kill -KILL "${rank:?no rank runs}"
wait $runner && fail "a run with a killed rank must fail"
grep -q "rank [01] .* signal 9" killed.log || fail "a killed rank must be told of: $(cat killed.log)"
[ ! -e killed/checks.csv ] || fail "the killed run came to its end"
on 3 run space.yaml --output killed --resume >resumed.log 2>&1 ||
    fail "resuming after a kill: $(cat resumed.log)"
grep -q "^resumed at step" resumed.log || fail "nothing was resumed: $(cat resumed.log)"
same_but_for_order whole killed || fail "killed on 2 ranks and resumed on 3"

# Ranks that have no particle.
"$BOLIDE" run space.yaml --set "resolution=1 mm" --output few >few.log 2>&1 || fail "few particles: $(cat few.log)"
on 4 run space.yaml --set "resolution=1 mm" --output fewer >few.log 2>&1 || fail "ranks without any: $(cat few.log)"
same_but_for_order few fewer || fail "few particles on 4 ranks"

# A mistake is told once, an impossible state too.
on 2 run space.yaml --set "bodies.bar.material=cheese" --output wrong >wrong.log 2>&1
[ "$(grep -c cheese wrong.log)" = 1 ] || fail "a mistake must be told once: $(cat wrong.log)"
on 2 run space.yaml --set "bodies.end.frozen=no" --set "run.energy_drift=1e-30" --output wrong --overwrite >wrong.log 2>&1
[ "$(grep -c 'total energy has drifted' wrong.log)" = 1 ] || fail "a failure must be told once: $(cat wrong.log)"
exit $status
