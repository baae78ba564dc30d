#!/bin/bash
# bolide search: the limit that it finds, its table, and what it says of keys, values and checks that are wrong.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"
cat >gas.yaml <<'YAML'
format: 1
dimension: 1
resolution: 1 mm
solver: sph
let: {slow: 10 m/s, speed: 5 m/s, cells: 20}
materials: {gas: {eos: {ideal-gas: {density: 1 kg/m^3, gamma: 3}}}}
bodies:
  all: {material: gas, velocity: [speed], energy: 2 J/kg, box: {from: [0 m], to: [cells*1 mm]}}
run: {until: 1 s, max_steps: 2}
output: {snapshots: no}
checks:
  fast: {mean: velocity.x, at_least: 31.4 m/s}
  slow: {mean: velocity.x, at_most: 31.4 m/s}
  never: {mean: velocity.x, at_least: 1 km/s}
  light: {total: mass, at_most: 0.0231 kg/m^2}
YAML
# search STATUS WORDS OPTIONS...: the status and the words that the answer must have.
search() {
    local wanted=$1 words=$2
    shift 2
    "$BOLIDE" search gas.yaml "$@" >log 2>&1
    local got=$?
    [ $got = "$wanted" ] || fail "$*: status $got, wanted $wanted: $(cat log)"
    grep -qF -- "$words" log || fail "$* does not say \"$words\": $(cat log)"
}
rm -rf results
ends=(--key speed --from 10m/s --to 90m/s)
search 0 "fast passes at 31.875 m/s and fails at 31.25 m/s: limit 31.5625 m/s +- 0.31 m/s" "${ends[@]}" --check fast --within 1m/s
grep -q "^9 runs; table in results/gas-search/sweep.csv" log || fail "the number of runs: $(cat log)"
[ "$(wc -l <results/gas-search/sweep.csv)" = 10 ] || fail "a row a run: $(cat results/gas-search/sweep.csv)"
grep -q '^"speed=31.25_m_s",31.25,31.25,FAILED,31.25,passed' results/gas-search/sweep.csv || fail "no row of 31.25 m/s"
[ -s results/gas-search/pictures/fast.png ] && [ -s results/gas-search/report.html ] || fail "no plot or report"
search 2 "already contains the results of a sweep" "${ends[@]}" --check fast
cp results/gas-search/sweep.csv before.csv
search 0 "limit 31.5625 m/s" "${ends[@]}" --check fast --within 1m/s --resume
cmp before.csv results/gas-search/sweep.csv || fail "resumed, the table is another"

# Ends in another order, of other units, of names of let, and a key without a unit.
search 0 "slow passes at 31.25 m/s and fails at 31.875 m/s" --key speed --from 90m/s --to 10m/s --check slow --within 1m/s --overwrite
search 0 "fast passes at 31.875 m/s" --key speed --from slow --to 0.09km/s --check fast --within '2 %' --overwrite
search 0 "light passes at 23 and fails at 24" --key cells --from 20 --to 28 --check light --within 1 --overwrite

rm -rf results
search 2 'check "never" fails with speed = 10m/s and with 90m/s' "${ends[@]}" --check never
[ "$(wc -l <results/gas-search/sweep.csv)" = 3 ] || fail "both ends are in the table"
rm -rf results
search 2 '(did you mean "fast"?)' "${ends[@]}" --check fats
search 2 '--from 10m/s: sweep.sped: "sped" is neither a name of let nor a path (did you mean "speed"?)' --key sped --from 10m/s --to 90m/s --check fast
search 2 'expected a velocity (m/s) (--from 10)' --key speed --from 10 --to 90m/s --check fast
search 2 '--from: "muscl" is not a number' --key solver.sph.method --from muscl --to standard --check fast
search 2 'there is nothing between' --key speed --from 10m/s --to 10m/s --check fast
search 2 '--within: "1s" is no quantity in m/s' "${ends[@]}" --check fast --within 1s
search 2 'must be more than 0' "${ends[@]}" --check fast --within 0m/s
search 2 'takes more than 40 runs' "${ends[@]}" --check fast --within 1e-20m/s
search 2 'quotes and backslashes' --key 'sp"eed' --from 10m/s --to 90m/s --check fast
search 2 'search needs --to B' --key speed --from 10m/s --check fast
[ ! -e results ] || fail "a search that cannot begin has written: $(ls -R results)"

# Stopped, it continues where it was.
long=(--set run.max_steps=20000 --set run.until=1000s --threads 1)
"$BOLIDE" search gas.yaml "${ends[@]}" --check fast --within 1m/s "${long[@]}" >stopped.log 2>&1 &
runner=$!
await $runner results/gas-search/speed=90_m_s/run.log
kill -TERM $runner
wait $runner
[ $? = 143 ] || fail "SIGTERM to a search: $(cat stopped.log)"
grep -q "continue with --resume" stopped.log || fail "nothing to go on with: $(cat stopped.log)"
[ "$(wc -l <results/gas-search/sweep.csv)" -ge 2 ] || fail "no table of what was run"
exit $status
