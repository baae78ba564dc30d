#!/bin/bash
# Cases on several ranks: the same bits as on one, whatever the method, when space is divided anew, and after a kill
# that is resumed on another number of ranks. One message when a rank fails. $BOLIDE_MPIRUN starts several processes.
set -u
status=0
fail() {
    echo "FAILED: $*"
    status=1
}
on() {
    local ranks=$1
    shift
    OMP_NUM_THREADS=1 $BOLIDE_MPIRUN -n "$ranks" "$BOLIDE" "$@" </dev/null
}
hash_of() { grep -o '"hash","[0-9a-f]*"' "$1/summary.csv"; }
# What two runs wrote, to the last bit, but for what tells of the running itself.
same() {
    [ -n "$(hash_of "$1")" ] && [ "$(hash_of "$1")" = "$(hash_of "$2")" ] || return 1
    diff -rq -x summary.csv -x run.log -x report.html -x checkpoint.h5 -x case.yaml "${@:3}" "$1" "$2"
}
# The same where particles were sorted at other times: snapshots hold them in the order of storage.
same_but_for_order() { same "$1" "$2" -x snapshots; }

# Every kind of case, a few steps each: what their checks say of so few does not count.
names=$(grep -v '^#' "$BOLIDE_SOURCE_DIR/tests/data/kinds.txt")
cases=
for name in $names; do cases="$cases $BOLIDE_SOURCE_DIR/examples/$name/case.yaml"; done
rm -rf one two four
few=(verify $cases --short --set run.max_steps=41 --set run.energy_drift=0 --set "output.pictures=[density]")
"$BOLIDE" "${few[@]}" --output one >one.log 2>&1
on 2 "${few[@]}" --output two >two.log 2>&1
on 4 "${few[@]}" --set run.rebalance=20 --output four >four.log 2>&1
for name in $names; do
    case $name in
    mpm/*) on_two=same_but_for_order ;; # ranks sort their particles at times of their own
    *) on_two=same ;;
    esac
    $on_two "one/$name" "two/$name" || fail "$name on 2 ranks: $(tail -n 5 two.log)"
    same_but_for_order "one/$name" "four/$name" || fail "$name divided anew on 4 ranks: $(tail -n 5 four.log)"
done

everything=$BOLIDE_SOURCE_DIR/tests/data/everything.yaml
rm -rf whole killed few fewer
"$BOLIDE" run "$everything" --output whole >whole.log 2>&1 || fail "the whole run: $(cat whole.log)"

# One rank is killed when the first checkpoint is there; others go on, in another number.
OMP_NUM_THREADS=1 $BOLIDE_MPIRUN -n 2 "$BOLIDE" run "$everything" --output killed >killed.log 2>&1 </dev/null &
runner=$!
while [ ! -e killed/checkpoint.h5 ] && kill -0 $runner 2>/dev/null; do sleep 0.02; done
rank=$(grep -l "^PPid:[[:space:]]*$runner\$" /proc/[0-9]*/status 2>/dev/null | tail -n 1)
rank=${rank//[^0-9]/}
kill -KILL "${rank:?no rank runs}"
wait $runner && fail "a run with a killed rank must fail"
grep -q "rank [01] .* signal 9" killed.log || fail "a killed rank must be told of: $(cat killed.log)"
[ ! -e killed/checks.csv ] || fail "the killed run came to its end"
on 3 run "$everything" --output killed --resume >resumed.log 2>&1 ||
    fail "resuming after a kill: $(cat resumed.log)"
grep -q "^resumed at step" resumed.log || fail "nothing was resumed: $(cat resumed.log)"
same_but_for_order whole killed || fail "killed on 2 ranks and resumed on 3"

# Ranks that have no particle.
"$BOLIDE" run "$everything" --set "resolution=1 mm" --output few >few.log 2>&1 || fail "few particles: $(cat few.log)"
on 4 run "$everything" --set "resolution=1 mm" --output fewer >few.log 2>&1 || fail "ranks without any: $(cat few.log)"
same_but_for_order few fewer || fail "few particles on 4 ranks"

# A mistake is told once, an impossible state too.
on 2 run "$everything" --set "bodies.bar.material=cheese" --output wrong >wrong.log 2>&1
[ "$(grep -c cheese wrong.log)" = 1 ] || fail "a mistake must be told once: $(cat wrong.log)"
on 2 run "$everything" --set "bodies.end.frozen=no" --set "run.energy_drift=1e-30" --output wrong --overwrite >wrong.log 2>&1
[ "$(grep -c 'total energy has drifted' wrong.log)" = 1 ] || fail "a failure must be told once: $(cat wrong.log)"
exit $status
