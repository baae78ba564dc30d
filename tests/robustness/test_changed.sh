#!/bin/bash
# A run that is resumed with other loads, boundaries, failure constants and without a body: only with --change;
# nothing is lost from the balance; what is removed later has the bits of a run that removed it then.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"
cat >push.yaml <<'END'
format: 1
dimension: 2
resolution: 1 mm
solver: mpm
materials: {steel: {library: steel-1006, failure: {spall: {strength: 2 GPa}}}}
bodies:
  bar: {material: steel, box: {from: [0 mm, 0 mm], to: [20 mm, 5 mm]}}
  wall: {material: steel, box: {from: [21 mm, -5 mm], to: [24 mm, 10 mm]}, velocity: [-100 m/s, 0 m/s]}
boundaries: {left: {kind: reflecting, axis: x, at: 0 mm, side: low}}
loads: {push: {on: bar, pressure: 100 MPa, axis: x, side: high, before: 16 us}}
contacts: {them: {between: [bar, wall], tension: none}}
gravity: [0 m/s^2, -9.81 m/s^2]
run: {until: 20 us}
output: {history: 0.5 us, pictures: []}
checks:
  mass:     {conserved: mass, within: 1e-12}
  momentum: {conserved: momentum, within: 1e-12}
  energy:   {conserved: energy, within: 1e-12}
END
# resumed SETTINGS...: a copy of `start` is continued.
resumed() {
    rm -rf part
    cp -r start part
    "$BOLIDE" run push.yaml --set "solver=$solver" --output part --resume "$@" >part.log 2>&1
}
for solver in mpm sph; do
    rm -rf start whole
    "$BOLIDE" run push.yaml --set "solver=$solver" --set run.until=12us --output start >start.log 2>&1 ||
        fail "$solver: $(cat start.log)"
    resumed || fail "$solver, extended: $(cat part.log)"
    unchanged=$(hash_of part)
    for change in gravity= "gravity=[0 m/s^2, 1e6 m/s^2]" boundaries= contacts= loads.push.pressure=300MPa \
        loads.push.before=13us materials.steel.failure.spall.strength=0.05GPa "solver.$solver.courant=0.2" \
        bodies.wall.remove_at=0s; do
        key=${change%%=*}
        resumed --set "$change"
        [ $? = 2 ] && grep -qF -- "--change lets the run continue" part.log || fail "$solver: $change without --change"
        resumed --change --set "$change" || fail "$solver, $change: $(cat part.log)"
        [ "$(hash_of part)" != "$unchanged" ] || fail "$solver: $change has no effect"
        grep -q "^1,[0-9]*,1.*\"$key.*,from here$" part/changes.csv || fail "$change: $(cat part/changes.csv)"
        grep -q "<h2>Changed when it was resumed" part/report.html || fail "the report is silent about $change"
        [ "$(tail -n 1 part/history.csv | sed 's/.*,//')" = 1 ] || fail "the history is silent about $change"
        [ "$(sed -n 3p part/history.csv | sed 's/.*,//')" = 0 ] || fail "the history changes before $change"
    done
    # A body that is taken away later than the resume has the bits of a run that knew of it.
    "$BOLIDE" run push.yaml --set "solver=$solver" --set bodies.wall.remove_at=15us --output whole >whole.log 2>&1 ||
        fail "$solver, a body that is taken away: $(cat whole.log)"
    for ranks in 1 ${BOLIDE_MPIRUN:+2}; do
        resumed --change --set bodies.wall.remove_at=15us --ranks "$ranks" || fail "$solver: $(cat part.log)"
        [ "$(hash_of part)" = "$(hash_of whole)" ] || fail "$solver: on $ranks ranks a body removed later has other bits"
    done
    tail -n 1 whole/history.csv | cut -d, -f4 | grep -qx 100 || fail "$solver: the body is there: $(tail -n 1 whole/history.csv)"
    # Once it has gone the key is free; while it is there, it is not.
    resumed --set bodies.wall.remove_at=0s --set run.until=16us --change || fail "$solver: $(cat part.log)"
    "$BOLIDE" run push.yaml --set "solver=$solver" --output part --resume >part.log 2>&1 ||
        fail "$solver: a body that has gone must be removed again: $(cat part.log)"
    gone=$(hash_of part)
    grep -q '^2,.*"bodies.wall.remove_at","0 s","",free$' part/changes.csv || fail "$solver: $(cat part/changes.csv)"
    [ "$(tail -n 1 part/history.csv | cut -d, -f4)" = 100 ] || fail "$solver: a body that has gone is back"
    resumed --set bodies.wall.remove_at=0s --change || fail "$solver: $(cat part.log)"
    [ "$(hash_of part)" = "$gone" ] || fail "$solver: without the key of a body that has gone there are other bits"
    resumed --set bodies.wall.remove_at=30us
    [ $? = 2 ] && [ "$(hash_of part)" = "$(hash_of start)" ] && grep -qF -- "--change lets" part.log ||
        fail "$solver: a body that is there: $(cat part.log)"
    # What cannot be changed though others of its kind can.
    resumed --change --set loads=
    grep -q "loads.push: .*a resumed run cannot change it" part.log || fail "a load is removed: $(cat part.log)"
    resumed --change --set "boundaries.right={kind: reflecting, axis: x, at: 24 mm, side: high}"
    grep -q "boundaries.right: .*a resumed run gets no new boundary" part.log || fail "a new wall: $(cat part.log)"
    resumed --change --set boundaries.left.at=-1mm
    grep -q "boundaries.left.at: .*a resumed run cannot change it" part.log || fail "a moved wall: $(cat part.log)"
    resumed --change --set "materials.steel.failure={grady: {}}"
    grep -q "materials.steel.failure: .*a resumed run cannot change it" part.log || fail "another model: $(cat part.log)"
    resumed --change --set materials.steel.failure.spall.weibull_modulus=5
    grep -q "weibull_modulus: .*a resumed run cannot change it" part.log || fail "a modulus: $(cat part.log)"
done

# A gas: what is outside a face.
gas=$BOLIDE_SOURCE_DIR/tests/data/everything-gas.yaml
how=(--set output.pictures=[] --set checks= --output gas)
rm -rf gas
"$BOLIDE" run "$gas" "${how[@]}" --set run.until=0.2ms >gas.log 2>&1 || fail "a gas: $(cat gas.log)"
"$BOLIDE" run "$gas" "${how[@]}" --set run.until=0.3ms --resume --change --set boundaries.block= >gas.log 2>&1
grep -q "boundaries.block: .*with this solver a resumed run keeps its boundaries" gas.log || fail "an obstacle: $(cat gas.log)"
"$BOLIDE" run "$gas" "${how[@]}" --set run.until=0.3ms --resume --change --set boundaries.y= >gas.log 2>&1
grep -q "boundaries.y: .*keeps its periodic faces" gas.log || fail "a periodic face: $(cat gas.log)"
"$BOLIDE" run "$gas" "${how[@]}" --set run.until=0.3ms --resume --change --set boundaries.right.kind=transmitting >gas.log 2>&1 ||
    fail "a face that opens: $(cat gas.log)"
courant=(--set boundaries.right.kind=transmitting --set run.until=0.4ms --set solver.gas.courant=0.4 --resume)
"$BOLIDE" run "$gas" "${how[@]}" "${courant[@]}" >gas.log 2>&1
grep -q "solver.gas.courant: .*--change lets the run continue" gas.log || fail "another step: $(cat gas.log)"
"$BOLIDE" run "$gas" "${how[@]}" "${courant[@]}" --change >gas.log 2>&1 || fail "another step of a gas: $(cat gas.log)"
exit $status
