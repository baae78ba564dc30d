#!/bin/bash
# Cases on several ranks: the same bits as on one, whatever the method, when space is divided anew, and after a kill
# that is resumed on another number of ranks. One message when a rank fails. $BOLIDE_MPIRUN starts several processes.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"
on() {
    local ranks=$1
    shift
    OMP_NUM_THREADS=1 $BOLIDE_MPIRUN -n "$ranks" "$BOLIDE" "$@" </dev/null
}

# Every kind of case, a few steps each: what their checks say of so few does not count.
names=$(grep -v '^#' "$BOLIDE_SOURCE_DIR/tests/data/kinds.txt")
cases=
for name in $names; do cases="$cases $BOLIDE_SOURCE_DIR/examples/$name/case.yaml"; done
rm -rf one two four
few=(verify $cases --short --set run.max_steps=25 --set run.energy_drift=0 --set "output.pictures={density: {view: section}}")
"$BOLIDE" "${few[@]}" --output one >one.log 2>&1
on 2 "${few[@]}" --output two >two.log 2>&1
on 4 "${few[@]}" --set run.rebalance=10 --output four >four.log 2>&1
for name in $names; do
    case $name in
    mpm/*) on_two=same_but_for_order ;; # ranks sort their particles at times of their own
    *) on_two=same ;;
    esac
    $on_two "one/$name" "two/$name" || fail "$name on 2 ranks: $(tail -n 5 two.log)"
    same_but_for_order "one/$name" "four/$name" || fail "$name divided anew on 4 ranks: $(tail -n 5 four.log)"
done

# One rank is killed when the first checkpoint is there, or the file $until; others go on, in another number.
until=checkpoint.h5
kill_and_resume() {
    rm -rf whole killed
    "$BOLIDE" run "$@" --output whole >whole.log 2>&1 || fail "the whole run: $(cat whole.log)"
    OMP_NUM_THREADS=1 $BOLIDE_MPIRUN -n 2 "$BOLIDE" run "$@" --output killed >killed.log 2>&1 </dev/null &
    local runner=$!
    await $runner "killed/$until" killed/checkpoint.h5
    local rank
    rank=$(grep -l "^PPid:[[:space:]]*$runner\$" /proc/[0-9]*/status 2>/dev/null | tail -n 1)
    rank=${rank//[^0-9]/}
    kill -KILL "${rank:?no rank runs}"
    wait $runner && fail "a run with a killed rank must fail"
    grep -q "rank [01] .* signal 9" killed.log || fail "a killed rank must be told of: $(cat killed.log)"
    [ ! -e killed/checks.csv ] || fail "the killed run came to its end"
    on 3 run "$@" --output killed --resume >resumed.log 2>&1 ||
        fail "resuming after a kill: $(cat resumed.log)"
    grep -q "^resumed at step" resumed.log || fail "nothing was resumed: $(cat resumed.log)"
    same_but_for_order whole killed || fail "$* killed on 2 ranks and resumed on 3"
}
kill_and_resume "$BOLIDE_SOURCE_DIR/tests/data/everything-gas.yaml"
kill_and_resume "$BOLIDE_SOURCE_DIR/tests/data/everything-gas-two.yaml"
explosives=$BOLIDE_SOURCE_DIR/tests/data/everything-explosives.yaml
until=snapshots/000002.vtkhdf
kill_and_resume "$BOLIDE_SOURCE_DIR/tests/data/everything-levels.yaml"
kill_and_resume "$explosives"
until=checkpoint.h5
rm -rf two
on 2 run "$explosives" --output two >two.log 2>&1 || fail "2 ranks: $(cat two.log)"
same_but_for_order whole two || fail "$explosives on 2 ranks"
for solver in mpm sph; do
    kill_and_resume "$BOLIDE_SOURCE_DIR/tests/data/everything-failure.yaml" --set solver=$solver
    kill_and_resume "$BOLIDE_SOURCE_DIR/tests/data/everything-brittle.yaml" --set solver=$solver
done
# Bodies that touch after a while.
apart=$BOLIDE_SOURCE_DIR/tests/data/apart.yaml
rm -rf whole three
"$BOLIDE" run "$apart" --output whole >whole.log 2>&1 || fail "bodies that are apart: $(cat whole.log)"
on 3 run "$apart" --output three >three.log 2>&1 || fail "bodies that are apart on 3 ranks: $(cat three.log)"
same_but_for_order whole three || fail "bodies that are apart on 3 ranks"
everything=$BOLIDE_SOURCE_DIR/tests/data/everything.yaml
kill_and_resume "$everything" # whose `whole` serves below

rm -rf few fewer
# Ranks that have no particle.
"$BOLIDE" run "$everything" --set "resolution=1 mm" --output few >few.log 2>&1 || fail "few particles: $(cat few.log)"
on 4 run "$everything" --set "resolution=1 mm" --output fewer >few.log 2>&1 || fail "ranks without any: $(cat few.log)"
same_but_for_order few fewer || fail "few particles on 4 ranks"

# A mistake is told once, an impossible state too.
on 2 run "$everything" --set "bodies.bar.material=cheese" --output wrong >wrong.log 2>&1
[ "$(grep -c cheese wrong.log)" = 1 ] || fail "a mistake must be told once: $(cat wrong.log)"
on 2 run "$everything" --set "bodies.end.frozen=no" --set "run.energy_drift=1e-30" --output wrong --overwrite >wrong.log 2>&1
[ "$(grep -c 'total energy has drifted' wrong.log)" = 1 ] || fail "a failure must be told once: $(cat wrong.log)"

# --ranks starts mpirun itself: the same bits, and Bolide's own verdict and exit status.
export BOLIDE_MPIRUN
rm -rf asked failing stopped
"$BOLIDE" run "$everything" --ranks 2 --threads 1 --output asked >asked.log 2>&1 || fail "--ranks 2: $(cat asked.log)"
same_but_for_order whole asked || fail "--ranks 2 computes something else"
grep -q "2 ranks, each 1 thread" asked/run.log || fail "run.log names the ranks: $(head -n 2 asked/run.log)"
plate=$BOLIDE_SOURCE_DIR/examples/elastic-plastic/aluminium/case.yaml
"$BOLIDE" verify "$plate" --ranks 2 --short --set run.max_steps=2 --output failing >failing.log 2>&1
[ $? = 1 ] || fail "a failed check on ranks must end with 1: $(cat failing.log)"
grep -q "0 of 1 cases passed" failing.log || fail "no verdict of a failed check: $(cat failing.log)"
grep -qi "abort" failing.log && fail "mpirun had the last word: $(cat failing.log)"
"$BOLIDE" run "$everything" --ranks 2 --set "bodies.bar.material=cheese" >wrong.log 2>&1
[ $? = 2 ] && [ "$(wc -l <wrong.log)" = 1 ] || fail "a mistake on ranks must end with 2: $(cat wrong.log)"
BOLIDE_MPIRUN=/nowhere/mpirun "$BOLIDE" run "$everything" --ranks 2 >wrong.log 2>&1
[ $? = 4 ] && grep -q "/nowhere/mpirun" wrong.log || fail "mpirun is missing: $(cat wrong.log)"
on 2 run "$everything" --ranks 3 >wrong.log 2>&1
grep -q "mpirun has started 2 ranks already" wrong.log || fail "--ranks among ranks: $(cat wrong.log)"

# A request to stop reaches the ranks, which leave a checkpoint, and what started them tells of the signal.
"$BOLIDE" run "$everything" --ranks 2 --threads 1 --output stopped >stopped.log 2>&1 &
runner=$!
await $runner stopped/checkpoint.h5
kill -TERM $runner
wait $runner
[ $? = 143 ] || fail "SIGTERM to ranks: $(cat stopped.log)"
grep -q "continue with --resume" stopped.log || fail "nothing to go on with: $(cat stopped.log)"
"$BOLIDE" run "$everything" --output stopped --resume >resumed.log 2>&1 || fail "resuming: $(cat resumed.log)"
same_but_for_order whole stopped || fail "stopped on 2 ranks and resumed alone"
exit $status
