#!/bin/bash
# Gas and material points side by side, and one after another: the same bits on any number of
# threads and after a kill; side by side, on any number of ranks.
set -u
status=0
fail() {
    echo "FAILED: $*"
    status=1
}
hash_of() { grep -o '"hash","[0-9a-f]*"' "$1/summary.csv"; }
# What two runs wrote, to the last bit, but for what tells of the running itself.
same() {
    [ -n "$(hash_of "$1")" ] && [ "$(hash_of "$1")" = "$(hash_of "$2")" ] || return 1
    diff -rq -x summary.csv -x run.log -x report.html -x checkpoint.h5 -x case.yaml "${@:3}" \
        "$1" "$2"
}
case=$BOLIDE_SOURCE_DIR/tests/data/everything-coupled.yaml

rm -rf one two four killed
for threads in 1:one 2:two 4:four; do
    "$BOLIDE" run "$case" --threads "${threads%:*}" --output "${threads#*:}" >run.log 2>&1 ||
        fail "on ${threads%:*} threads: $(cat run.log)"
done
same one two || fail "2 threads differ from one"
same one four || fail "4 threads differ from one"

# Killed when snapshot $1 of $case is there, into the folder $2, and resumed on another number of
# threads: the run in the folder $3 was not.
kill_and_resume() {
    rm -rf "$2"
    "$BOLIDE" run "$case" --threads 2 --output "$2" >killed.log 2>&1 &
    local runner=$!
    while [ ! -e "$2/snapshots/$1.vtkhdf" ] && kill -0 $runner 2>/dev/null; do sleep 0.02; done
    sleep 0.05
    kill -KILL $runner 2>/dev/null
    wait $runner 2>/dev/null
    rm -rf again
    cp -r "$2" again
    [ ! -e "$2/checks.csv" ] || fail "the run killed at snapshot $1 came to its end"
    "$BOLIDE" run "$case" --threads 1 --output "$2" --resume >resumed.log 2>&1 ||
        fail "resuming after snapshot $1: $(cat resumed.log)"
    grep -q "^resumed at step" resumed.log || fail "nothing was resumed: $(cat resumed.log)"
    same "$3" "$2" || fail "a run killed after snapshot $1 and resumed differs"
}

# When material is passing the faces.
kill_and_resume 000002 killed one

# On ranks, with space divided anew on the way: snapshots hold particles in the order of storage.
for ranks in ${BOLIDE_MPIRUN:+2 4}; do
    rm -rf "ranks$ranks"
    OMP_NUM_THREADS=1 $BOLIDE_MPIRUN -n "$ranks" "$BOLIDE" run "$case" --output "ranks$ranks" \
        --set "run.rebalance=$((ranks * 20))" >ranks.log 2>&1 </dev/null ||
        fail "on $ranks ranks: $(cat ranks.log)"
    same one "ranks$ranks" -x snapshots || fail "$ranks ranks differ from one"
done
if [ -n "${BOLIDE_MPIRUN:-}" ]; then
    OMP_NUM_THREADS=1 $BOLIDE_MPIRUN -n 3 "$BOLIDE" run "$case" --output again --resume \
        >again.log 2>&1 </dev/null || fail "resuming on 3 ranks: $(cat again.log)"
    same one again -x snapshots || fail "a run resumed on 3 ranks differs"
fi

# One method after another: in each of the three stages.
case=$BOLIDE_SOURCE_DIR/tests/data/everything-alternating.yaml
rm -rf one two four
for threads in 1:one 2:two 4:four; do
    "$BOLIDE" run "$case" --threads "${threads%:*}" --output "${threads#*:}" >run.log 2>&1 ||
        fail "one method after another on ${threads%:*} threads: $(cat run.log)"
done
same one two || fail "one method after another: 2 threads differ from one"
same one four || fail "one method after another: 4 threads differ from one"
for snapshot in 000001 000005 000010; do kill_and_resume $snapshot killed one; done

exit $status
