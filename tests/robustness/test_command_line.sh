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
expect 2 "did you mean \"units\"" "$BOLIDE" help unit
expect 2 "bolide verify" "$BOLIDE"
expect 2 "did you mean \"verify\"" "$BOLIDE" verfy
expect 2 "did you mean --overwrite" "$BOLIDE" run case.yaml --overwite
expect 2 "usage: bolide run CASE" "$BOLIDE" run
expect 2 "--threads" "$BOLIDE" run case.yaml --threads many
expect 2 "--set wants PATH=VALUE" "$BOLIDE" run case.yaml --set
expect 2 "exclude each other" "$BOLIDE" run case.yaml --resume --overwrite
expect 2 "No such file" "$BOLIDE" run missing.yaml
expect 2 "nothing to resume" "$BOLIDE" run "$cases/riemann/gas/case.yaml" --output never --resume

expect 0 "200 particles" "$BOLIDE" check "$cases/riemann/gas/case.yaml"
expect 2 "did you mean \"gas-riemann\"" "$BOLIDE" exact gas-rieman
expect 2 '"left" is missing' "$BOLIDE" exact gas-riemann

rm -rf results
expect 0 "check passed: energy" "$BOLIDE" run "$cases/riemann/gas/case.yaml"
[ -s results/gas/checks.csv ] || { echo "FAILED: no checks.csv"; status=1; }
[ -s results/gas/pictures/check-pressure.png ] || { echo "FAILED: no overlay"; status=1; }
expect 2 "results/gas" "$BOLIDE" run "$cases/riemann/gas/case.yaml"
expect 1 "check FAILED: energy" "$BOLIDE" run "$cases/riemann/gas/case.yaml" --overwrite \
    --set "checks.energy.at_least=1"
expect 1 "1 of 19 checks failed" "$BOLIDE" verify "$cases/riemann/gas/case.yaml" \
    --set "checks.energy.at_least=1"
expect 2 "nanometer" "$BOLIDE" run "$cases/riemann/gas/case.yaml" --overwrite \
    --set "resolution=1 nanometer"
[ -s results/gas/checks.csv ] || { echo "FAILED: bad input removed results"; status=1; }
expect 3 "energy has drifted" "$BOLIDE" run "$cases/riemann/gas-standard/case.yaml" \
    --set solver.sph.courant=0.4 --set run.energy_drift=1e-3
[ -s results/gas-standard/snapshots/failed.vtkhdf ] || { echo "FAILED: no failed.vtkhdf"; status=1; }
exit $status
