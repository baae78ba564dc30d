#!/bin/bash
# Gas and material points side by side, and one after another: the same bits on any number of
# threads and ranks, and after a kill.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"

# Kills a run of $case when snapshot $1 is there, and resumes it on another number of threads; keeps
# what the killed one has left in the folder `left`.
kill_and_resume() {
    rm -rf killed left
    "$BOLIDE" run "$case" "${settings[@]}" --threads 2 --output killed >killed.log 2>&1 &
    local runner=$!
    await $runner "killed/snapshots/$1.vtkhdf" killed/checkpoint.h5
    sleep 0.05
    kill -KILL $runner 2>/dev/null
    wait $runner 2>/dev/null
    cp -r killed left
    [ ! -e killed/checks.csv ] || fail "$name: the run killed at snapshot $1 came to its end"
    "$BOLIDE" run "$case" "${settings[@]}" --threads 1 --output killed --resume >resumed.log 2>&1 ||
        fail "$name: resuming after snapshot $1: $(cat resumed.log)"
    grep -q "^resumed at step" resumed.log || fail "$name: nothing was resumed: $(cat resumed.log)"
    # Particles may be sorted at other times than without the kill.
    same_but_for_order one killed || fail "$name: a run killed after snapshot $1 and resumed differs"
}

# Runs the case $1 in every way; the others are the snapshots after which it is killed.
settings=()
compare() {
    name=$1 case=$BOLIDE_SOURCE_DIR/tests/data/$1.yaml
    rm -rf one two four
    for threads in 1:one 2:two 4:four; do
        "$BOLIDE" run "$case" "${settings[@]}" --threads "${threads%:*}" \
            --output "${threads#*:}" >run.log 2>&1 ||
            fail "$name on ${threads%:*} threads: $(cat run.log)"
    done
    same one two || fail "$name: 2 threads differ from one"
    same one four || fail "$name: 4 threads differ from one"

    # Space is divided anew on the way.
    for ranks in ${BOLIDE_MPIRUN:+2 4}; do
        rm -rf "ranks$ranks"
        OMP_NUM_THREADS=1 $BOLIDE_MPIRUN -n "$ranks" "$BOLIDE" run "$case" --output "ranks$ranks" \
            --set "run.rebalance=$((ranks * 20))" >ranks.log 2>&1 </dev/null ||
            fail "$name on $ranks ranks: $(cat ranks.log)"
        same_but_for_order one "ranks$ranks" || fail "$name: $ranks ranks differ from one"
    done
    for snapshot in "${@:2}"; do
        kill_and_resume "$snapshot"
        [ -n "${BOLIDE_MPIRUN:-}" ] || continue
        OMP_NUM_THREADS=1 $BOLIDE_MPIRUN -n 3 "$BOLIDE" run "$case" --output left --resume \
            >left.log 2>&1 </dev/null || fail "$name: resuming on 3 ranks: $(cat left.log)"
        same_but_for_order one left || fail "$name: a run resumed on 3 ranks differs"
    done
}

# When material is passing the faces; and in each of the three stages.
compare everything-coupled 000002
compare everything-alternating 000001 000005 000010

# Stopped just before, at and after each handover, and resumed.
every=(--threads 1 --set output.history=1ns --set checks=)
rm -rf whole
"$BOLIDE" run "$case" "${every[@]}" --output whole >whole.log 2>&1 ||
    fail "$name with its history: $(cat whole.log)"
for event in propagation interaction; do
    at=$(sed -n "s/^event,\"$event\",\"time\",\([^,]*\),.*/\1/p" whole/summary.csv)
    step=$(awk -F, -v at="$at" 'NR > 1 && $1 >= at { print $2; exit }' whole/history.csv)
    for most in $((step - 1)) "$step" $((step + 1)); do
        rm -rf part
        for steps in "$most" 100000; do
            "$BOLIDE" run "$case" "${every[@]}" --set "run.max_steps=$steps" --output part \
                $([ "$steps" = "$most" ] || echo --resume) >part.log 2>&1 ||
                fail "$name to step $steps: $(cat part.log)"
        done
        [ "$(hash_of whole)" = "$(hash_of part)" ] && cmp whole/history.csv part/history.csv ||
            fail "$name: stopped at step $most, $event, and resumed it differs"
    done
done

# With markers between the gases, on one rank.
settings=(--set solver.afdmp.gas.method=lax-wendroff)
BOLIDE_MPIRUN= compare everything-alternating 000001 000005

# With levels of cells, on one rank.
settings=(--set levels=3 --set "run.until=120 us" --set "domain.high=[0.96 m, 0.8 m]"
    --set "bodies.air.box.to=[0.96 m, 0.8 m]")
BOLIDE_MPIRUN= compare everything-coupled 000002
low='[-0.48 m, 0 m]' high='[0.32 m, 0.48 m]'
settings=(--set levels=3 --set "run.until=45 us" --set "domain.low=$low" --set "domain.high=$high"
    --set "bodies.air.box.from=$low" --set "bodies.air.box.to=$high")
BOLIDE_MPIRUN= compare everything-alternating 000005 000012

exit $status
