#!/bin/bash
# Particles across the grains of a bed: what `bolide check` prints, and for which beds it warns.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"
cat >bed.yaml <<'YAML'
format: 1
dimension: 2
solver: sph
resolution: 8 um
let: {speed: 1 km/s}
materials: {aluminium: {library: aluminium}, tungsten: {library: tungsten}}
bodies:
  bed:
    material: tungsten
    velocity: [speed, 0 m/s]
    packing: {from: [0 mm, 0 mm], to: [0.4 mm, 0.2 mm], fraction: 40 %, radius: 30 um, largest: 50 um}
boundaries: {wall: {kind: reflecting, axis: x, at: 0.4 mm, side: high}}
run: {until: 1 us, max_steps: 2}
output: {snapshots: no, pictures: []}
YAML
# says WORDS OPTIONS...: what check says of the bed.
says() {
    local words=$1
    shift
    "$BOLIDE" check bed.yaml "$@" >log 2>&1 || fail "check $*: $(cat log)"
    grep -qE -- "$words" log || fail "check $* does not say \"$words\": $(cat log)"
}
quiet() {
    "$BOLIDE" check bed.yaml "$@" >log 2>&1 || fail "check $*: $(cat log)"
    grep -q "warning: .*bodies.bed: .*mean grain" log && fail "check $* warns: $(cat log)"
}
says "^  bed: 9[.0-9]* particles across the mean grain, 7[.0-9]* across the smallest$"
says "warning: bed.yaml:8:3: bodies.bed: 9[.0-9]* particles across the mean grain"
quiet --set resolution=6um
# Grains in a matrix, and those of a polycrystal, touch everywhere.
quiet --set 'bodies.matrix={material: aluminium, box: {from: [0 mm, 0 mm], to: [0.4 mm, 0.2 mm]}}' \
    --set bodies.bed.replaces=matrix
grains='from: [0 mm, 0 mm], to: [0.4 mm, 0.2 mm], size: 60 um'
quiet --set bodies.bed.packing= --set "bodies.bed.voronoi={$grains}"
says "warning: .*bodies.bed: 7 particles" --set bodies.bed.packing= --set "bodies.bed.voronoi={$grains, gap: 4 um}"
says "bed: 8 particles across the mean grain" --set bodies.bed.packing= --set 'bodies.bed.repeat={shape: {ball: {center: [40 um, 40 um], radius: 32 um}}, count: [5, 2], step: [70 um, 70 um]}'
# The run says it, and a case may expect it.
"$BOLIDE" verify bed.yaml >log 2>&1 && fail "verify passes with a warning: $(cat log)"
"$BOLIDE" verify bed.yaml --set 'expected_warnings={grains: {warning: coarse, reason: a quick test}}' >log 2>&1 ||
    fail "an expected warning fails: $(cat log)"
exit $status
