#!/bin/bash
# A case that begins with the bodies of another run: with the same bodies it has the bits of a run that was
# never interrupted, by any threads and ranks; bodies are left out and added; the rest is refused by name.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"
cat >one.yaml <<'YAML'
format: 1
dimension: 2
resolution: 1 mm
solver: mpm
materials: {steel: {library: steel-1006, failure: {spall: {strength: 2 GPa}}}}
bodies:
  bar: {material: steel, box: {from: [0 mm, 0 mm], to: [20 mm, 5 mm]}}
  wall: {material: steel, box: {from: [21 mm, -5 mm], to: [24 mm, 10 mm]}, velocity: [-100 m/s, 0 m/s]}
boundaries: {left: {kind: reflecting, axis: x, at: 0 mm, side: low}}
run: {until: 20 us}
output: {history: 0.5 us, pictures: []}
checks:
  mass:     {conserved: mass, within: 1e-12}
  momentum: {conserved: momentum, within: 1e-12}
  energy:   {conserved: energy, within: 1e-12}
YAML
new='{material: steel, box: {from: [25 mm, -2 mm], to: [27 mm, 2 mm]}, velocity: [-300 m/s, 0 m/s]}'
# run FOLDER OPTIONS...
run() {
    local folder=$1
    shift
    rm -rf "$folder"
    "$BOLIDE" run one.yaml --set "solver=$solver" --output "$folder" "$@" >log 2>&1
}
members() { tail -n 1 "$1/history.csv" | cut -d, -f4; }
for solver in mpm sph; do
    run first --set run.until=10us --threads 2 || fail "$solver: $(cat log)"
    run whole --threads 1 || fail "$solver: $(cat log)"
    for ranks in 1 ${BOLIDE_MPIRUN:+2}; do
        run on --set start.from=first --ranks "$ranks" || fail "$solver, continued: $(cat log)"
        [ "$(hash_of on)" = "$(hash_of whole)" ] || fail "$solver: continued on $ranks ranks it has other bits"
    done
    # `at` is the end of that run, though its checkpoint is of the steps before.
    run at --set 'start={from: first, at: 10 us}' || fail "$solver, at the end: $(cat log)"
    [ "$(hash_of at)" = "$(hash_of whole)" ] || fail "$solver: continued at the end it has other bits"
    cmp <(sed -n 2p on/history.csv | cut -d, -f1,2) <(grep -m 1 '^1.0[0-9]*e-05,' whole/history.csv | cut -d, -f1,2) ||
        fail "$solver: the time does not go on: $(sed -n 2p on/history.csv | cut -c1-80)"
    run off --set bodies.wall= --set 'start={from: first, without: wall}' || fail "$solver, a body less: $(cat log)"
    [ "$(members off)" = 100 ] || fail "$solver: the body that is left out is there"
    for ranks in 1 ${BOLIDE_MPIRUN:+2}; do
        run added --set "bodies.new=$new" --set start.from=first --ranks "$ranks" || fail "$solver, a body more: $(cat log)"
        [ "$(members added)" = 153 ] || fail "$solver: a body is missing: $(members added)"
        hash=${hash:-$(hash_of added)}
        [ "$(hash_of added)" = "$hash" ] || fail "$solver: with a body more, other bits on $ranks ranks"
    done
    hash=
    # Its own checkpoint has all that it needs.
    run stopped --set "bodies.new=$new" --set start.from=first --set run.until=15us || fail "$solver: $(cat log)"
    mv first away
    "$BOLIDE" run one.yaml --set "solver=$solver" --set "bodies.new=$new" --set start.from=first --output stopped --resume >log 2>&1
    [ $? = 2 ] && grep -q 'there is no case "first"' log || fail "$solver: a folder that is gone: $(cat log)"
    mv away first
    "$BOLIDE" run one.yaml --set "solver=$solver" --set "bodies.new=$new" --set start.from=first --output stopped --resume >log 2>&1 ||
        fail "$solver, resumed: $(cat log)"
    [ "$(hash_of stopped)" = "$(hash_of added)" ] || fail "$solver: resumed it has other bits"
done
# The same written as a case, in which a key without a value takes out what the included file has.
printf 'include: one.yaml\nsolver: sph\nstart: {from: first, without: wall}\nbodies:\n  wall:\n  new: %s\n' "$new" >other.yaml
"$BOLIDE" run other.yaml --output other --overwrite >log 2>&1 || fail "a body that an included file has: $(cat log)"
[ "$(members other)" = 108 ] || fail "a body that an included file has is there: $(members other)"
# refused WORDS OPTIONS...
refused() {
    local words=$1
    shift
    run no --set start.from=first "$@"
    [ $? = 2 ] && grep -qF -- "$words" log || fail "\"$words\" is not the answer to $*: $(cat log)"
    [ ! -e no ] || fail "$*: a case that is refused has written results"
}
refused 'start: the body "wall" of that run is missing here: name it in `without`' --set bodies.wall=
refused 'start.without: the case has the body "wall"' --set start.without=wall
refused 'start.without: that run has no body "walls"' --set start.without=walls
refused 'resolution: 0.001 m in the case that `start` names, 0.0005 m here' --set resolution=0.5mm
refused 'bodies.wall.velocity: [-100 m/s, 0 m/s] in the case that `start` names, [-50 m/s, 0 m/s] here' \
    --set 'bodies.wall.velocity=[-50 m/s, 0 m/s]'
refused 'materials.steel.eos: {grueneisen' --set materials.steel.library=steel-4340-johnson-cook
refused 'start: that case is of the solver sph: with mpm' --set solver=mpm
refused 'start.at: the checkpoint of that run is at t = ' --set start.at=5us
refused 'start.at: the checkpoint of that run is at t = ' --set start.at=10.1us
rm -rf cut
cp -r first cut
sed -i 's/until: .*/until: 3e-05 s/' cut/case.yaml
refused 'start.at: the checkpoint of that run is at t = 9.' --set start.from=cut --set start.at=30us --set run.until=40us
refused 'run.until: the run that `start` names is at t = ' --set run.until=5us
refused '`center`, `axis`, `window` and `material` are of a blast' --set 'start.center=[0 mm, 0 mm]'
rm first/checkpoint.h5
refused 'checkpoint.h5: cannot be read' --set title=none
exit $status
