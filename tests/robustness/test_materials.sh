#!/bin/bash
# bolide materials: the table of the library, a material with its sources, and what it says of a name
# that is not there and of files that are broken.
set -u
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

export BOLIDE_SHARE=$BOLIDE_SOURCE_DIR
library=$BOLIDE_SOURCE_DIR/materials
expect 0 "aluminium-wilkins" "$BOLIDE" materials
expect 0 "6449.9" "$BOLIDE" materials
expect 0 "cockcroft-latham" "$BOLIDE" materials
expect 0 "bolide materials [NAME]" "$BOLIDE" help materials
expect 2 'did you mean "tungsten"' "$BOLIDE" materials tungsen
expect 2 "known: air, alumina" "$BOLIDE" materials unobtainium
expect 2 "no material" "$BOLIDE" materials ../materials/water
expect 2 "no material" "$BOLIDE" materials ""
expect 2 "usage: bolide materials" "$BOLIDE" materials water air
expect 2 "unknown option" "$BOLIDE" materials --output x
expect 2 "needs the name" "$BOLIDE" materials --curves
expect 0 "shock,4050,8.51579e+10,5.25666e+06,3200.31,8600.05,9727.27,3242.42" "$BOLIDE" materials aluminium --curves

expect 0 "#   detonation speed 8348 m/s" "$BOLIDE" materials petn-reactive

# The speed and pressure of the source of Composition B, 7980 m/s and 29.5 GPa, follow from its JWL
# constants; U_s of water and PMMA at u = 1 km/s is that of their sources.
detonation=$("$BOLIDE" materials comp-b | sed -n 's/.*detonation speed \([0-9]*\) m\/s.*/\1/p')
[ "${detonation:-0}" -gt 7940 ] && [ "$detonation" -lt 8020 ] || { echo "FAILED: comp-b has D = $detonation"; status=1; }
expect 0 "Chapman-Jouguet 29." "$BOLIDE" materials comp-b

for file in "$library"/*.yaml; do
    name=$(basename "$file" .yaml)
    "$BOLIDE" materials "$name" | head -c "$(stat -c %s "$file")" | cmp -s - "$file" || { echo "FAILED: materials $name is not $file"; status=1; }
done
rows=$("$BOLIDE" materials | grep -c -E ' (none|perfect-plastic|johnson-cook|drucker-prager|hjc|johnson-holmquist|failure-wave) ')
[ "$rows" = "$(ls "$library"/*.yaml | wc -l)" ] || { echo "FAILED: the table has $rows rows"; status=1; }

# A broken file costs its own row only; a share without a library falls back to that of the build.
rm -rf share && mkdir -p share/materials
cp "$library/water.yaml" share/materials/
printf 'eos: {barotropic: {density: 1 kg/m^2\n' >share/materials/broken.yaml
export BOLIDE_SHARE=$PWD/share
expect 2 "water  " "$BOLIDE" materials
expect 2 "broken.yaml:" "$BOLIDE" materials
expect 4 "could not be written" bash -c '"$BOLIDE" materials water >/dev/full'
exit $status
