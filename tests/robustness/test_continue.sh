#!/bin/bash
# A run that is resumed with another case: a later end and other outputs give the bits of the run that had
# them from the start, with each solver, threads and ranks; keys that may not change are refused by name.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"

# extends NAME CASE EARLIER LATER OPTIONS...: a run to EARLIER that is extended to LATER, by other threads.
extends() {
    local name=$1 case=$2 earlier=$3 later=$4
    shift 4
    rm -rf whole part
    "$BOLIDE" run "$case" "$@" --set "run.until=$later" --output whole --threads 1 >whole.log 2>&1
    [ $? -le 1 ] || fail "$name: $(cat whole.log)"
    "$BOLIDE" run "$case" "$@" --set "run.until=$earlier" --output part --threads 2 >part.log 2>&1
    [ $? -le 1 ] || fail "$name to $earlier: $(cat part.log)"
    [ "$(hash_of whole)" != "$(hash_of part)" ] || fail "$name ends too early to be extended"
    "$BOLIDE" run "$case" "$@" --set "run.until=$later" --output part --resume --threads 1 \
        ${ranks:+--ranks $ranks} >part.log 2>&1
    [ $? -le 1 ] || fail "$name, extended: $(cat part.log)"
    [ "$(hash_of whole)" = "$(hash_of part)" ] || fail "$name: extended, it has other bits"
    cmp whole/history.csv part/history.csv || fail "$name: extended, it has another history"
    [ ! -d whole/probes ] || diff -r whole/probes part/probes || fail "$name: extended, it has other probes"
}
data=$BOLIDE_SOURCE_DIR/tests/data
examples=$BOLIDE_SOURCE_DIR/examples
quiet=(--set "output.pictures=[]" --set output.history=1us)
extends sph "$examples/impact/steel-cube-0" 8us 12us "${quiet[@]}" --set "probes={cube: {body: cube}}"
extends mpm "$examples/impact/taylor-bar-mpm" 10us 15us --short "${quiet[@]}"
extends gas "$data/everything-gas.yaml" 0.3ms 0.5ms "${quiet[@]}" --set checks=
extends coupled "$examples/coupling/alternating-plate" 20us 30us --short "${quiet[@]}"
if [ -n "${BOLIDE_MPIRUN:-}" ]; then
    ranks=2 extends ranks "$data/everything-gas.yaml" 0.3ms 0.5ms "${quiet[@]}" --set checks=
    ranks=2 extends ranks-sph "$examples/impact/steel-cube-0" 8us 12us "${quiet[@]}"
    ranks=3 extends ranks-mpm "$examples/impact/taylor-bar-mpm" 10us 15us --short "${quiet[@]}"
fi
extends failure "$data/everything-failure.yaml" 2us 3us "${quiet[@]}"

# The number of steps ends a run too; and what was stopped is extended as well.
rm -rf whole part
for most in 40 60; do
    how=(--set "run.max_steps=$most" --output part)
    [ ! -e part ] || how+=(--resume)
    "$BOLIDE" run "$examples/impact/taylor-bar-mpm" --short "${quiet[@]}" "${how[@]}" >part.log 2>&1
done
"$BOLIDE" run "$examples/impact/taylor-bar-mpm" --short "${quiet[@]}" --set run.max_steps=60 --output whole >whole.log 2>&1
[ -n "$(hash_of whole)" ] && [ "$(hash_of whole)" = "$(hash_of part)" ] || fail "more steps: $(cat part.log)"
cmp whole/history.csv part/history.csv || fail "with more steps it has another history"

# A probe more, one less, and none: what has been warned of goes on, with the bits of the state.
cat >rod.yaml <<'END'
format: 1
dimension: 1
resolution: 100 um
materials: {m: {library: steel-1006}}
bodies: {b: {material: m, box: {from: [0 mm], to: [3 mm]}, velocity: [10 m/s]}}
run: {until: 0.3 us}
output: {pictures: []}
END
# probes NAME CASE EARLIER LATER GAUGE TRACER OPTIONS...: TRACER "" where the solver has no particles.
probes() {
    local name=$1 case=$2 earlier=$3 later=$4 gauge=$5 tracer=$6 both had has
    shift 6
    both="g: {gauge: $gauge}${tracer:+, t: {tracer: $tracer\}}"
    rm -rf whole
    "$BOLIDE" run "$case" "$@" --set "probes={}" --set "run.until=$later" --output whole >whole.log 2>&1 ||
        fail "probes, $name: $(cat whole.log)"
    for had in "{}" "{g: {gauge: $gauge}}" "{$both}" "{h: {gauge: $gauge}, $both}"; do
        rm -rf start
        "$BOLIDE" run "$case" "$@" --set "probes=$had" --set "run.until=$earlier" --output start >part.log 2>&1 ||
            fail "probes, $name, $had: $(cat part.log)"
        for has in "{}" "{$both}" "{g: {gauge: $gauge}, n: {gauge: $gauge}}" "{f: {gauge: $gauge}, $both, n: {gauge: $gauge}}"; do
            rm -rf part
            cp -r start part
            "$BOLIDE" run "$case" "$@" --set "probes=$has" --set "run.until=$later" --output part --resume >part.log 2>&1 ||
                fail "probes, $name, $had then $has: $(cat part.log)"
            [ "$(hash_of whole)" = "$(hash_of part)" ] || fail "probes, $name: $had then $has, it has other bits"
        done
    done
}
for solver in sph mpm; do
    probes $solver rod.yaml 0.3us 0.6us "[1 mm]" "[1.5 mm]" --set "solver=$solver"
    rm -rf part
    for has in "{}" "{g: {gauge: [1 mm]}}" "{}"; do # at the same end, as it stands
        "$BOLIDE" run rod.yaml --set "solver=$solver" --set "probes=$has" --output part ${again:+--resume} >part.log 2>&1 ||
            fail "$solver, $has at the end: $(cat part.log)"
        [ "${again:=$(hash_of part)}" = "$(hash_of part)" ] || fail "$solver, $has at the end: it has other bits"
    done
    again=
done
probes gas "$data/everything-gas.yaml" 0.1ms 0.15ms "[0.1 m, 0.1 m, 0.1 m]" "" --set "output.pictures=[]" --set checks=

# A tracer whose particle has failed stays warned of, once, among other probes; one that ends does not.
cat >spall.yaml <<'END'
format: 1
dimension: 1
resolution: 50 um
solver: sph
materials: {m: {library: steel-1006, failure: {spall: {strength: 100 MPa}}}}
bodies:
  flyer: {material: m, box: {from: [0 mm], to: [1 mm]}, velocity: [200 m/s]}
  b: {material: m, box: {from: [1 mm], to: [3 mm]}}
run: {until: 0.8 us}
output: {pictures: []}
END
rm -rf part
"$BOLIDE" run spall.yaml --set "probes={gone: {tracer: [2 mm]}, old: {tracer: [2.5 mm]}}" --output part >start.log 2>&1
"$BOLIDE" run spall.yaml --set "probes={new: {gauge: [2 mm]}, deep: {tracer: [1.2 mm]}, old: {tracer: [2.5 mm]},
    more: {gauge: [1 mm]}}" --set run.until=1us --output part --resume >part.log 2>&1
tell=$(grep -o '^warning: tracer "old" .* failed at t = [0-9.]* ns' start.log)
[ -n "$tell" ] && grep -qF "  $tell" part.log && ! grep -q '^warning: tracer "old"' part.log ||
    fail "a tracer that has failed: $tell, $(cat part.log)"
grep -q '^warning: tracer "gone"' start.log && ! grep -q 'warning: tracer "[gm]' part.log || fail "$(cat part.log)"

# Everything that is free, at once; what is new begins with the resume.
"$BOLIDE" new plate --template impact >/dev/null 2>&1 || true
case=plate/case.yaml
begin=(--set run.until=0.2us --set "probes={old: {gauge: [1 mm], every: 10 ns}, gone: {gauge: [2 mm]}}"
    --set "checks={early: {mean: pressure, at: 0.1 us}, energy: {conserved: energy, within: 1e-12}}")
later=(--set run.until=0.3us --set "probes={new: {gauge: [0.5 mm]}, old: {gauge: [1 mm], every: 20 ns}}"
    --set "checks={energy: {conserved: energy, within: 1e-11}, late: {mean: pressure, at: 0.1 us, at_least: 1 Pa},
        early: {mean: pressure, at: 0.1 us, at_least: 1 Pa}}"
    --set title=Longer --set output.every=20ns --set output.pictures=[] --set output.history=5ns
    --set "profiles={along: {fields: pressure}}" --set output.fragments=yes --set run.energy_drift=1 --set exact=)
rm -rf whole part
"$BOLIDE" run $case "${begin[@]}" --output part >part.log 2>&1 || fail "a plate: $(cat part.log)"
old=$(wc -l <part/probes/old.csv)
"$BOLIDE" run $case "${later[@]}" --output part --resume >part.log 2>&1
[ $? = 1 ] || fail "a new check that comes too late must fail: $(cat part.log)"
"$BOLIDE" run $case "${later[@]}" --output whole >whole.log 2>&1 || fail "a plate: $(cat whole.log)"
[ "$(hash_of whole)" = "$(hash_of part)" ] || fail "free keys change bits"
[ "$(sort -u part/probes/gone.csv | wc -l)" -gt 10 ] || fail "a probe that has ended is gone"
head -n 2 part/probes/new.csv | tail -n 1 | grep -q "e-07," || fail "a new probe does not begin with the resume"
[ "$(wc -l <part/probes/old.csv)" -gt "$old" ] || fail "a probe does not continue"
head -n "$((old - 1))" part/probes/old.csv | tail -n 1 | cut -d, -f1 | grep -q "e-0[78]" || fail "rows of a probe"
grep -q '^"early",mean,Pa,.*,passed,' part/checks.csv || fail "what a check measured is lost: $(cat part/checks.csv)"
cmp <(grep '^"early"' whole/checks.csv) <(grep '^"early"' part/checks.csv) || fail "a check of an earlier time"
grep -q '^"late",mean,Pa,nan.*added to a resumed run after its time' part/checks.csv || fail "$(cat part/checks.csv)"
grep -q '^1,.*,"run.until","2.*e-07 s","3e-07 s",free$' part/changes.csv || fail "$(cat part/changes.csv)"
grep -q '^1,.*,"probes.gone",.*,"",free$' part/changes.csv || fail "$(cat part/changes.csv)"
grep -q "until: 2.*e-07 s" part/case-1.yaml && grep -q "until: 3e-07 s" part/case.yaml || fail "the case before"
grep -q "^changed at step .*: run.until: \"2.*e-07 s\" until then, \"3e-07 s\" now" part.log || fail "$(cat part.log)"
# Once more: the record grows; the same command again changes nothing.
"$BOLIDE" run $case "${later[@]}" --set run.until=0.32us --output part --resume >part.log 2>&1
"$BOLIDE" run $case "${later[@]}" --set run.until=0.32us --output part --resume >part.log 2>&1
[ "$(grep -c '"run.until"' part/changes.csv)" = 2 ] || fail "changes of two resumes: $(cat part/changes.csv)"
grep -q '^2,' part/changes.csv && [ -e part/case-2.yaml ] && [ ! -e part/case-3.yaml ] || fail "two resumes"
"$BOLIDE" run $case --short --set output.pictures=[] --output part --overwrite >part.log 2>&1
[ ! -e part/case-1.yaml ] && [ ! -e part/changes.csv ] && [ ! -e part/probes ] || fail "--overwrite leaves $(ls part)"

# refused WORDS OPTIONS...: the resume is refused, and WORDS say why.
refused() {
    local words=$1
    shift
    "$BOLIDE" run $case "${begin[@]}" --output part --resume "$@" >part.log 2>&1
    [ $? = 2 ] && grep -qF -- "$words" part.log || fail "\"$words\" is not the answer to $*: $(cat part.log)"
    [ "$(hash_of part)" = "$hash" ] || fail "a refused resume has changed the results"
}
rm -rf part
"$BOLIDE" run $case "${begin[@]}" --output part >part.log 2>&1
hash=$(hash_of part)
refused 'resolution: "2e-05 m" until the checkpoint, "1e-05 m" now' --set resolution=10um
refused 'solver: "{sph: ' --set solver=mpm
refused 'solver.sph.smoothing: nothing until the checkpoint, "1.1" now' --set "solver={sph: {smoothing: 1.1}}"
refused 'bodies.flyer.velocity: "[1000 m/s]" until the checkpoint' --set let.speed=900m/s
refused 'materials.copper.eos.mie-grueneisen.gamma: "2" until' --set materials.copper.eos.mie-grueneisen.gamma=2.1
refused 'give the new one another name' --set "probes={old: {gauge: [1.5 mm], every: 10 ns}}"
refused 'output.maps.peak: nothing until the checkpoint' --set "output.maps={peak: {peak: pressure}}"
refused 'run.until: the checkpoint is at t = ' --set run.until=0.1us
"$BOLIDE" run $case --change --output other >part.log 2>&1
[ $? = 2 ] && grep -q -- "--change needs --resume" part.log || fail "--change alone: $(cat part.log)"
exit $status
