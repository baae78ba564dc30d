#!/bin/bash
# Explosives that burn: the same bits on any number of threads and after a kill, of particles with
# both solvers and of cells. test_ranks.sh compares ranks.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"

for name in everything-explosives everything-explosives-mpm everything-gas-two; do
    case=$BOLIDE_SOURCE_DIR/tests/data/${name%-mpm}.yaml
    settings=()
    [ "$name" = "${name%-mpm}" ] || settings=(--set solver=mpm --set "resolution=62.5 um")
    rm -rf one two four killed
    for threads in 1:one 2:two 4:four; do
        "$BOLIDE" run "$case" "${settings[@]}" --threads "${threads%:*}" --output "${threads#*:}" >run.log 2>&1 ||
            fail "$name on ${threads%:*} threads: $(cat run.log)"
    done
    grep -q "check FAILED" one/run.log && fail "$name: $(grep "check FAILED" one/run.log)"
    same one two || fail "$name: 2 threads differ from one"
    same one four || fail "$name: 4 threads differ from one"

    # Killed while the explosive burns, and resumed on another number of threads.
    "$BOLIDE" run "$case" "${settings[@]}" --threads 2 --output killed >killed.log 2>&1 &
    runner=$!
    await $runner killed/snapshots/000002.vtkhdf killed/checkpoint.h5
    kill -KILL $runner 2>/dev/null
    wait $runner 2>/dev/null
    [ ! -e killed/checks.csv ] || fail "$name: the killed run came to its end"
    "$BOLIDE" run "$case" "${settings[@]}" --threads 1 --output killed --resume >resumed.log 2>&1 ||
        fail "$name, resuming after a kill: $(cat resumed.log)"
    grep -q "^resumed at step" resumed.log || fail "$name: nothing was resumed: $(cat resumed.log)"
    same_but_for_order one killed || fail "$name: a killed and resumed run differs"
done
# While a detonation runs through its charge no sweep of the gas is repeated: of an explosive that
# has yet to burn next to nothing is left to lose.
cat >inside.yaml <<'END'
format: 1
dimension: 3
resolution: 20 mm
solver: gas
materials: {air: {library: air}, tnt: {library: tnt}}
bodies:
  air: {material: air, density: 1.225 kg/m^3, pressure: 1 bar, box: {from: [0 m, 0 m, 0 m], to: [0.64 m, 0.64 m, 0.64 m]}}
  charge: {material: tnt, replaces: air, ball: {center: [0.2 m, 0.32 m, 0.3 m], radius: 0.16 m}}
detonations: {point: {at: [0.2 m, 0.32 m, 0.3 m]}}
run: {until: 19 us}
output: {pictures: []}
END
"$BOLIDE" run inside.yaml --output inside --overwrite >inside.log 2>&1 || fail "$(cat inside.log)"
! grep "repetition of sweeps" inside.log || fail "sweeps inside a charge are repeated"
exit $status
