#!/bin/bash
# Threads that wait for each other sleep soon, unless the user wants it otherwise, and the number of threads that a run
# uses never changes its results.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"
# What gcc's OpenMP, the only one that tells, has understood: the program's own copy speaks last.
spins() { OMP_DISPLAY_ENV=verbose env -u OMP_WAIT_POLICY "$@" "$BOLIDE" --version 2>&1 | sed -n "s/.*GOMP_SPINCOUNT = '\(.*\)'/\1/p" | tail -n 1; }
if [ -n "$(spins)" ]; then
    [ "$(spins)" = 5000 ] || fail "threads spin $(spins) times"
    [ "$(spins GOMP_SPINCOUNT=77)" = 77 ] || fail "the user's GOMP_SPINCOUNT is lost"
    [ "$(spins OMP_WAIT_POLICY=passive)" = 0 ] || fail "the user's OMP_WAIT_POLICY is lost"
fi

# One number after another, and all the time two; with as many busy programs as processors beside them.
busy=()
for ((k = 0; k < $(nproc); k++)); do
    (while :; do :; done) &
    busy+=($!)
done
trap 'kill "${busy[@]}" 2>/dev/null' EXIT
case=$BOLIDE_SOURCE_DIR/examples/porous-aluminium/demo-first-order/case.yaml
for threads in 1 2 fixed; do
    [ $threads = fixed ] && export OMP_DYNAMIC=false
    env -u OMP_WAIT_POLICY "$BOLIDE" run "$case" --short --set run.max_steps=100 --set run.energy_drift=0 \
        --threads ${threads/fixed/2} --output $threads --overwrite >$threads.log 2>&1
    [ $? -le 1 ] || fail "$threads: $(cat $threads.log)"
done
[ -n "$(hash_of 1)" ] || fail "no hash: $(cat 1.log)"
for threads in 2 fixed; do
    [ "$(hash_of $threads)" = "$(hash_of 1)" ] || fail "$threads: another hash"
done
grep -q "threads on average" fixed/run.log && fail "OMP_DYNAMIC=false still took fewer threads"
exit $status
