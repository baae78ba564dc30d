#!/bin/bash
# The command line: exit statuses, and messages that name the nearest right spelling.
set -u
cases=$BOLIDE_SOURCE_DIR/examples
status=0

# expect STATUS WORDS COMMAND...: the command ends with STATUS, and WORDS stand in what it says.
expect() {
    local want=$1 words=$2 said got
    shift 2
    said=$("$@" 2>&1)
    got=$?
    if [ "$got" != "$want" ]; then
        echo "FAILED: $* ended with $got, not $want: $said"
        status=1
    elif [[ $said != *"$words"* ]]; then
        echo "FAILED: $* did not say \"$words\" but: $said"
        status=1
    fi
}

expect 0 "bolide run" "$BOLIDE" help
expect 0 "smoothing" "$BOLIDE" help sph
expect 0 "--overwrite" "$BOLIDE" help run
expect 0 "energy_drift" "$BOLIDE" help case
expect 0 "GPa" "$BOLIDE" help units
expect 0 "let  " "$BOLIDE" help case
expect 0 "short  " "$BOLIDE" help case
expect 0 "names for expressions" "$BOLIDE" help let
expect 0 "equivalent_stress" "$BOLIDE" help fields
expect 0 "artificial viscous pressure" "$BOLIDE" help fields
expect 0 "sound_long" "$BOLIDE" help fields
if [ "$("$BOLIDE" help fields | grep -c sound_long)" != 1 ]; then
    echo "FAILED: help fields lists sound_long more than once"
    status=1
fi
expect 0 "velocity at the start" "$BOLIDE" help bodies.flyer.velocity
expect 0 "velocity at the start" "$BOLIDE" help bodies.flyer.velocity.1
expect 0 "margin of the neighbour lists" "$BOLIDE" help solver.sph.skin
expect 0 "the corner of the low coordinates" "$BOLIDE" help bodies.a.union.2.box.from
expect 0 "value of the field at the front" "$BOLIDE" help "checks.elastic front.front.value"
expect 0 "density at zero pressure" "$BOLIDE" help materials.al.eos.barotropic.density
expect 0 "pictures of every snapshot" "$BOLIDE" help short.output.pictures.1
expect 2 "no help on" "$BOLIDE" help bodies.flyer.velocty
expect 0 "--overwrite" "$BOLIDE" run --help
expect 0 "--overwrite" "$BOLIDE" run case.yaml -h
expect 2 "did you mean \"units\"" "$BOLIDE" help unit
expect 0 "run --resume" "$BOLIDE" help restart
expect 0 "drucker-prager.cohesion" "$BOLIDE" help cohesion
expect 0 "bolide materials tungsten-alloy-johnson-cook" "$BOLIDE" help tungsten
expect 0 "bolide materials rha-johnson-cook" "$BOLIDE" help rha-johnson-cook
expect 2 "no help on \"qwertyuiop\"" "$BOLIDE" help qwertyuiop

# Words of users that are no names of the program have an answer, which names a page that exists.
for word in spall failure fracture whipple craters penetration Hugoniot foam calibration restart \
    checkpoint symmetry film ParaView h5py MPI slurm threads GPU periodic "units of stress" blast \
    stl mesh erosion adaptive melting ceramic "long rod" plate-impact hvi "time step" cfl \
    hourglass eulerian "equation of state" charge tnt conwep "height of burst" Mott ricochet \
    histogram perspective colour slice experiment P-alpha underwater bubbles cavitation schlieren \
    Gurney jets "shaped charge" clamp tear honeycomb initiation; do
    expect 0 "" "$BOLIDE" help $word
    page=$("$BOLIDE" help $word | sed -n 's/^More: //p')
    [ -z "$page" ] || [ -f "$BOLIDE_SOURCE_DIR/$page" ] ||
        { echo "FAILED: help $word names $page, which does not exist"; status=1; }
done
expect 0 "Give the material a failure model" "$BOLIDE" help spall
expect 0 "GPa" "$BOLIDE" help units of stress
expect 0 "johnson-cook (strength)" "$BOLIDE" help johnson cook
expect 0 "| maxima | period" "$BOLIDE" help recorded
expect 0 "as a key of a case:" "$BOLIDE" help run
expect 0 "ParaView" "$BOLIDE" help --help
expect 0 "--resume" "$BOLIDE" help restart
[ "$("$BOLIDE" help fields | grep -c '^  sound_long ')" = 1 ] ||
    { echo "FAILED: help fields lists a field of every solver twice"; status=1; }
expect 2 "bolide verify" "$BOLIDE"
expect 2 "did you mean \"verify\"" "$BOLIDE" verfy
expect 2 "did you mean --overwrite" "$BOLIDE" run case.yaml --overwite
expect 2 "usage: bolide run CASE" "$BOLIDE" run
expect 2 "--threads" "$BOLIDE" run case.yaml --threads many
expect 2 "--ranks" "$BOLIDE" run case.yaml --ranks 0
expect 2 "unknown option --ranks" "$BOLIDE" check case.yaml --ranks 2
expect 2 "--set needs PATH=VALUE" "$BOLIDE" run case.yaml --set
expect 2 "exclude each other" "$BOLIDE" run case.yaml --resume --overwrite
expect 2 "No such file" "$BOLIDE" run missing.yaml
expect 2 "nothing to resume" "$BOLIDE" run "$cases/riemann/gas/case.yaml" --output never --resume

expect 0 "200 particles" "$BOLIDE" check "$cases/riemann/gas/case.yaml"
expect 0 "not filled" "$BOLIDE" check "$cases/blast/box/case.yaml" # faces of cells that are not there
expect 2 "did you mean \"gas-riemann\"" "$BOLIDE" exact gas-rieman
expect 2 '--set "left.density=... kg/m^3"' "$BOLIDE" exact gas-riemann
expect 2 '"right" is missing' "$BOLIDE" exact gas-riemann \
    --set 'left={density: 1 kg/m^3, pressure: 1 Pa, gamma: 1.4}'
expect 0 "star pressure" "$BOLIDE" exact "$cases/riemann/gas/case.yaml"
expect 2 "the case has no exact solution; add one" \
    "$BOLIDE" exact "$cases/impact/steel-cube-0/case.yaml"

# Mistakes that only the particles and their fields show are found by check, and by run before it writes.
cat >plate.yaml <<'END'
format: 1
title: plate
dimension: 1
resolution: 20 um
solver: sph
materials: {aluminium: {library: aluminium}}
bodies:
  flyer:  {material: aluminium, box: {from: [-4 mm], to: [1 mm]}, velocity: [1 km/s]}
  target: {material: aluminium, box: {from: [0 mm], to: [8 mm]}}
run: {until: 0.6 us}
output: {pictures: [presure, velocity]}
checks:
  a: {l1: pressure, at_most: 0.1}
  b: {mean: velocity.q, at_most: 1 m/s}
  c: {mean: pressure, is: 3 m, within: 1 %}
END
for command in check run; do
    expect 2 'plate.yaml:8:3: bodies.flyer: overlaps "target"' "$BOLIDE" $command plate.yaml
    expect 2 'plate.yaml:11:20: output.pictures.presure: the particles have no field "presure" (did you mean "pressure"?)' \
        "$BOLIDE" $command plate.yaml
    expect 2 'output.pictures.velocity: "velocity" is a vector, choose its component: velocity.x' "$BOLIDE" $command plate.yaml
    expect 2 '`l1` needs an exact solution' "$BOLIDE" $command plate.yaml
    expect 2 'choose its component: velocity.x' "$BOLIDE" $command plate.yaml
    expect 2 '`is` is in m, but `mean` is in Pa' "$BOLIDE" $command plate.yaml
done
[ ! -e results/plate ] || { echo "FAILED: a run that cannot begin has written results"; status=1; }
right=(--set output.pictures=[] --set checks={} --set 'bodies.flyer.box={from: [-4 mm], to: [0 mm]}')
expect 0 "600 particles" "$BOLIDE" check plate.yaml "${right[@]}"
expect 0 "warning: " "$BOLIDE" check plate.yaml "${right[@]}" --set "resolution=5 mm"
expect 0 "warning: " "$BOLIDE" run plate.yaml "${right[@]}" --set "resolution=5 mm"
for path in "let.n=2" "run.until=1us" "bodies.flyer.velocity=[1m/s]" "solver.sph.courant=0.2"; do
    expect 2 "(did you mean \"${path%=*}\"?)" "$BOLIDE" check plate.yaml "${right[@]}" --set "let={n: 1}" \
        --set "${path#*.}"
done
expect 2 "unknown key \"courant\" (did you mean \"solver.mpm.courant\"?)" "$BOLIDE" check plate.yaml \
    "${right[@]}" --set solver=mpm --set courant=0.2
expect 2 'did you mean "steel-1006", "steel-1006-' "$BOLIDE" check plate.yaml --set materials.aluminium.library=steel
expect 2 'no material "unobtainium" in the library (known: ' \
    "$BOLIDE" check plate.yaml --set materials.aluminium.library=unobtainium

# A program without its files says so.
mkdir -p alone && cp "$BOLIDE" alone/bolide
expect 2 "the library was not found; set BOLIDE_SHARE" env -u BOLIDE_SHARE alone/bolide check plate.yaml
rm -rf alone

# A message that begins with the case's path is not prefixed once more.
expect 2 "plate.yaml: could not run" "$BOLIDE" verify plate.yaml
"$BOLIDE" verify plate.yaml 2>&1 | grep -q "^plate.yaml:11:20: output" || { echo "FAILED: verify's prefix"; status=1; }

# A folder stands for its case.yaml.
mkdir -p home/plate home/none
cp plate.yaml home/plate/case.yaml
expect 0 "600 particles" "$BOLIDE" check home/plate "${right[@]}"
expect 0 "600 particles" "$BOLIDE" check home/plate/ "${right[@]}"
expect 2 "home/plate/case.yaml:8:3: bodies.flyer" "$BOLIDE" run home/plate --overwrite
expect 2 "home/plate: could not run" "$BOLIDE" verify home/plate/
(cd home/plate && expect 0 "plate: plate (1-D" "$BOLIDE" check . "${right[@]}" && exit $status) || status=1
for command in run check verify; do
    expect 2 "home/none: a folder without a case.yaml; name a case file" "$BOLIDE" $command home/none
done
expect 0 "star pressure" "$BOLIDE" exact "$cases/riemann/gas"
(cd "$cases/riemann" && expect 0 "star pressure" "$BOLIDE" exact gas && exit $status) || status=1

rm -rf results
expect 0 "check passed: energy" "$BOLIDE" run "$cases/riemann/gas/case.yaml"
[ -s results/gas/checks.csv ] || { echo "FAILED: no checks.csv"; status=1; }
[ -s results/gas/pictures/check-pressure.png ] || { echo "FAILED: no overlay"; status=1; }
expect 2 "results/gas" "$BOLIDE" run "$cases/riemann/gas/case.yaml"
expect 1 "check FAILED: energy" "$BOLIDE" run "$cases/riemann/gas/case.yaml" --overwrite \
    --set "checks.energy.at_least=1"
expect 1 "checks failed" "$BOLIDE" verify "$cases/riemann/gas/case.yaml" \
    --set "checks.energy.at_least=1"
expect 0 "check known deviation: energy: " "$BOLIDE" run "$cases/riemann/gas/case.yaml" --overwrite \
    --set "checks.energy.at_least=1" --set "checks.energy.known_deviation=a test"
grep -q '"a test",no,""$' results/gas/checks.csv || { echo "FAILED: no reason in checks.csv"; status=1; }
expect 0 "1 known deviation" "$BOLIDE" verify "$cases/riemann/gas/case.yaml" \
    --set "checks.energy.at_least=1" --set "checks.energy.known_deviation=a test"
expect 1 "passes now: remove \`known_deviation\`" "$BOLIDE" verify "$cases/riemann/gas/case.yaml" \
    --set "checks.energy.known_deviation=a test"
"$BOLIDE" verify "$cases/riemann/gas" --short --output verified >/dev/null 2>&1
expect 2 "already contains the results of a run" "$BOLIDE" verify "$cases/riemann/gas" --short --output verified
expect 0 "1 of 1 cases passed" "$BOLIDE" verify "$cases/riemann/gas" --short --output verified --overwrite
expect 2 "nanometer" "$BOLIDE" run "$cases/riemann/gas/case.yaml" --overwrite \
    --set "resolution=1 nanometer"
[ -s results/gas/checks.csv ] || { echo "FAILED: bad input removed results"; status=1; }
expect 3 "energy has drifted" "$BOLIDE" run "$cases/riemann/gas-standard/case.yaml" \
    --set solver.sph.courant=0.4 --set run.energy_drift=1e-3
[ -s results/gas-standard/snapshots/failed.vtkhdf ] || { echo "FAILED: no failed.vtkhdf"; status=1; }
# Output that cannot be written is an error, whichever line it was.
cat >small.yaml <<'END'
format: 1
dimension: 2
resolution: h
let: {h: 1 mm}
solver: mpm
materials: {metal: {library: aluminium-wilkins}}
bodies:
  flyer: {material: metal, velocity: [2 km/s, 0 m/s], box: {from: [-4 mm, 0 mm], to: [0 mm, 8 mm]}}
  target: {material: metal, box: {from: [0 mm, 0 mm], to: [8 mm, 8 mm]}}
run: {until: 1 us}
END
"$BOLIDE" run small.yaml --overwrite >/dev/full 2>full.log
[ $? = 4 ] && grep -q "could not be written" full.log || {
    echo "FAILED: a full disk behind the output: $(cat full.log)"
    status=1
}

# Forecasts: without and with a pilot, wherever the table of rates cannot be.
expect 0 "(a guess; --pilot measures)" env XDG_CACHE_HOME=/proc/nowhere "$BOLIDE" check small.yaml
expect 0 "(pilot: resolution 2 mm, " "$BOLIDE" check --pilot small.yaml
expect 0 "finished at step" env XDG_CACHE_HOME=/proc/nowhere "$BOLIDE" run small.yaml --overwrite
expect 2 "takes no value" "$BOLIDE" check --pilot=1 small.yaml

# More memory than there is: refused with both numbers, unless --force.
expect 2 "the run needs about" bash -c "ulimit -v 700000; exec '$BOLIDE' check small.yaml --set let.h=8um"
expect 2 "there are 716.8 MB" bash -c "ulimit -v 700000; exec '$BOLIDE' run small.yaml --output large --set let.h=8um"
[ -e large ] && echo "FAILED: a run without memory has begun" && status=1
expect 0 "of memory" bash -c "ulimit -v 700000; exec '$BOLIDE' check --force small.yaml --set let.h=8um"

# A case may have many probes.
{
    cat small.yaml
    echo "probes:"
    for i in $(seq 20000); do echo "  p$i: {gauge: {at: [1 mm, 1 mm]}}"; done
} >probes.yaml
expect 0 "of memory" bash -c "ulimit -v 700000; exec '$BOLIDE' check probes.yaml"

exit $status
