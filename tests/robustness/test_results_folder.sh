#!/bin/bash
# The folder of results: two runs at once, other people's files, odd names; and what surrounds a run:
# closed streams, far too many threads.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"
# refused WORDS COMMAND...: the command ends with 2 and says WORDS.
refused() {
    local words=$1 said got
    shift
    said=$("$@" 2>&1)
    got=$?
    [ $got = 2 ] && [[ $said == *"$words"* ]] || fail "$* ended with $got: $said"
}
rm -rf results run out
mkdir run
cat >run/plate.yaml <<'END'
format: 1
dimension: 1
resolution: 20 um
solver: sph
materials: {aluminium: {library: aluminium}}
bodies:
  flyer: {material: aluminium, box: {from: [-4 mm], to: [0 mm]}, velocity: [1 km/s]}
  target: {material: aluminium, box: {from: [0 mm], to: [8 mm]}}
run: {until: 50 ns}
output: {pictures: [speed]}
probes: {flyer: {body: flyer}}
END
cp run/plate.yaml run/...yaml
cp run/plate.yaml run/case.yaml

# One run at a time: another is refused, whatever it is to do, and the first does not notice.
"$BOLIDE" run run/plate.yaml --set "run.until=1 ms" --output results/long >long.log 2>&1 &
runner=$!
await $runner results/long/history.csv
for how in "" --overwrite --resume; do
    refused "results/long: is in use by another run (process $runner)" \
        "$BOLIDE" run run/plate.yaml --output results/long $how
done
kill -KILL $runner
wait $runner 2>/dev/null
"$BOLIDE" run run/plate.yaml --output results/long --overwrite >long.log 2>&1 ||
    fail "after a kill: $(cat long.log)"
[ ! -e results/long/.bolide-lock ] || fail "a lock is left"
refused "already contains the results of a run" "$BOLIDE" run run/plate.yaml --output results/long
sweep=(--set "sweep={run.until: [50 ns, 1 ms]}" --output results/sweep)
"$BOLIDE" run run/plate.yaml "${sweep[@]}" >sweep.log 2>&1 &
runner=$!
while [ ! -s results/sweep/until=50_ns/report.html ] && kill -0 $runner 2>/dev/null; do
    sleep 0.02
done
refused "results/sweep: is in use by another run (process $runner)" \
    "$BOLIDE" run run/plate.yaml "${sweep[@]}" --overwrite
kill -KILL $runner
wait $runner 2>/dev/null

# What Bolide did not write stays.
for file in pictures/mine.png pictures/speed-000000-best.png probes/flyer-first.csv \
    snapshots/start.vtkhdf notes.txt; do
    echo mine >results/long/$file
done
mkdir results/long/profiles && echo mine >results/long/profiles/mine-000000.csv
rm results/long/case.yaml
"$BOLIDE" run run/plate.yaml --set output.pictures=[] --set probes={} --output results/long \
    --overwrite >long.log 2>&1 || fail "overwriting: $(cat long.log)"
[ "$(cd results/long && find pictures probes profiles -type f | sort | tr '\n' ' ')" = \
    "pictures/mine.png pictures/speed-000000-best.png probes/flyer-first.csv profiles/mine-000000.csv " ] || fail "overwriting left $(find results/long)"
[ -s results/long/snapshots/start.vtkhdf ] && [ -s results/long/notes.txt ] ||
    fail "overwriting removed a user's file"

# Nothing is written through a link, and a resumed run waits for no pipe.
"$BOLIDE" run run/plate.yaml --output results/whole >whole.log 2>&1 || fail "$(cat whole.log)"
echo precious >results/victim
for file in .bolide-lock run.log history.csv checkpoint.h5.part case.yaml.part report.html.part \
    snapshots/000000.vtkhdf pictures/speed-000000.png.part probes/flyer.csv pictures; do
    for how in --overwrite --resume; do
        rm -rf results/linked && cp -r results/whole results/linked
        rm -rf results/linked/$file
        [ $file = pictures ] && target=.. || target=$PWD/results/victim
        ln -s "$target" results/linked/$file
        timeout 60 "$BOLIDE" run run/plate.yaml --output results/linked $how >linked.log 2>&1
        got=$?
        [ $got = 0 ] || [ $got = 2 ] || fail "$file is a link, $how ended with $got"
        [ $got = 0 ] || grep -q "linked/$file: is a symbolic link" linked.log ||
            fail "$file is a link, $how: $(cat linked.log)"
        [ "$(cat results/victim)" = precious ] && [ -z "$(find results -maxdepth 1 -name '*.png')" ] ||
            fail "$how wrote through the link $file"
    done
done
for file in checkpoint.h5 history.csv probes/flyer.csv run.log .bolide-lock; do
    for kind in pipe folder device; do
        rm -rf results/odd && cp -r results/whole results/odd && rm -f results/odd/$file
        case $kind in
        pipe) mkfifo results/odd/$file ;;
        folder) mkdir results/odd/$file ;;
        device) ln -s /dev/zero results/odd/$file ;;
        esac
        refused "odd/$file: is a" timeout 60 "$BOLIDE" run run/plate.yaml --output results/odd --resume
    done
done

# A folder that becomes a link during the run: what it leads to stays as it is.
for folder in snapshots pictures probes profiles; do
    rm -rf results/swapped results/elsewhere && mkdir results/elsewhere
    "$BOLIDE" run run/plate.yaml --set "run.until=1 s" --set output.every="20 ns" \
        --set "profiles={p: {along: x, fields: [density]}}" --set "probes.flyer.every=1 ns" \
        --output results/swapped >swapped.log 2>&1 &
    runner=$!
    while [ ! -s results/swapped/snapshots/000002.vtkhdf ] && kill -0 $runner 2>/dev/null; do
        sleep 0.02
    done
    kill -STOP $runner # else it may make the folder anew in between
    rm -rf results/moved-$folder
    mv results/swapped/$folder results/moved-$folder && ln -s ../elsewhere results/swapped/$folder
    kill -CONT $runner
    [ $folder != pictures ] || kill -TERM $runner # they are drawn at the end
    (sleep 600 && kill -KILL $runner) >/dev/null 2>&1 & # holds no output open
    watch=$!
    wait $runner
    got=$?
    kill $watch 2>/dev/null
    [ $got = 2 ] && grep -q "swapped/$folder: is a symbolic link" swapped.log ||
        fail "$folder became a link, and the run ended with $got: $(tail -5 swapped.log)"
    [ -z "$(ls results/elsewhere)" ] || fail "wrote through $folder: $(ls results/elsewhere)"
done

# A name that begins as a formula does stays a text in a spreadsheet.
for name in =1+1 +2 -3 @SUM; do
    cp run/plate.yaml "run/$name.yaml"
    "$BOLIDE" run "./run/$name.yaml" --output results/formula --overwrite >formula.log 2>&1 ||
        fail "$name: $(cat formula.log)"
    grep -q "^run,\"\",\"name\",\"'$name" results/formula/summary.csv &&
        ! grep -q ',"[=+@-]' results/formula/summary.csv ||
        fail "$name in summary.csv: $(grep name results/formula/summary.csv)"
done

# Names that lead out of the folder that is meant.
refused "the name of the folder is empty" "$BOLIDE" run run/plate.yaml --output ""
for folder in / // .. run/.. run/../; do
    refused "choose a folder with a name of its own" \
        "$BOLIDE" run run/plate.yaml --output $folder
done
refused "run/plate.yaml: is a file instead of a folder" \
    "$BOLIDE" run run/plate.yaml --output run/plate.yaml
refused "new: the name of the folder is empty" "$BOLIDE" new ""
refused "new ..: choose a folder with a name of its own" "$BOLIDE" new ..
refused "the results would go to results/.." "$BOLIDE" run run/...yaml
[ ! -e run.log ] || fail "results beside the folder of results"
mkdir -p out/in && (cd out/in &&
    "$BOLIDE" verify ../../run/case.yaml ../../run/plate.yaml --output there >verify.log 2>&1)
[ -s out/in/there/test_results_folder/run/run.log ] && [ -s out/in/there/run/plate.yaml/run.log ] ||
    fail "verify wrote elsewhere: $(find out)"
[ "$(ls out out/in)" = "$(printf 'out:\nin\n\nout/in:\nthere\nverify.log')" ] ||
    fail "verify wrote beside its folder: $(find out)"

# What is printed does not get into files, whichever stream is closed.
for closed in '<&-' '>&-' '2>&-' '<&- >&- 2>&-'; do
    eval '"$BOLIDE" run run/plate.yaml --output results/closed --overwrite' "$closed" >closed.log 2>&1 ||
        fail "$closed ended with $?"
    [[ $(head -c 8 results/closed/history.csv) == "time [s]" ]] || fail "$closed got into history.csv"
    [ "$(grep -c '^600 particles' results/closed/run.log)" = 1 ] || fail "$closed got into run.log"
done

# More threads than any machine has are a mistake; as many as there is work for are taken.
refused "--threads" "$BOLIDE" run run/plate.yaml --threads 99999
refused "OMP_NUM_THREADS" env OMP_NUM_THREADS=99999 \
    "$BOLIDE" run run/plate.yaml --output results/threads
for threads in 1000 1024; do
    timeout 600 "$BOLIDE" run run/plate.yaml --threads $threads --output results/threads --overwrite \
        >threads.log 2>&1 ||
        fail "$threads threads ended with $?: $(cat threads.log)"
done
OMP_NUM_THREADS=1000 timeout 600 "$BOLIDE" run run/plate.yaml --output results/threads --overwrite \
    >threads.log 2>&1 ||
    fail "1000 threads from the environment: $(cat threads.log)"
grep -q "1 thread$" threads.log || fail "600 particles take one thread: $(cat threads.log)"
exit $status
