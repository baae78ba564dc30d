#!/bin/bash
# Input made to hang the program, to fill its memory, to take over a terminal or to show files that are not the user's.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"

# limited SECONDS COMMAND...: kills what takes longer on the processor or waits for ever, but not
# what is slow because the machine is busy.
limited() {
    local seconds=$1
    shift
    (ulimit -t "$seconds" && exec timeout 600 "$@")
}

# refuse SECONDS WORDS COMMAND...: the command ends with 2 within SECONDS, says WORDS, and nothing that steers a terminal.
refuse() {
    local seconds=$1 words=$2 said got
    shift 2
    said=$(limited "$seconds" "$@" 2>&1)
    got=$?
    [ "$got" = 2 ] || fail "$* ended with $got, not 2: ${said:0:300}"
    [[ $said == *"$words"* ]] || fail "$* did not say \"$words\" but: ${said:0:300}"
    [[ $said != *$'\e'* ]] || fail "$* wrote an escape character"
}

plate() {
    cat <<'END'
format: 1
title: plate
dimension: 1
resolution: 20 um
solver: sph
materials: {aluminium: {library: aluminium}}
run: {until: 0.1 us}
bodies:
  target: {material: aluminium, box: {from: [0 mm], to: [8 mm]}}
END
}

# What is no regular file is neither opened nor read.
rm -f fifo; mkfifo fifo 2>/dev/null
mkdir -p folder
for file in fifo /dev/zero /dev/tty; do
    refuse 10 "this is not a regular file" "$BOLIDE" check $file
    { echo "include: $file"; plate; } >include.yaml
    refuse 10 "include.yaml:1:10: include: $file: this is not a regular file" "$BOLIDE" check include.yaml
done
refuse 10 "folder: a folder without a case.yaml" "$BOLIDE" check folder
truncate -s 40M large.yaml
refuse 10 "large.yaml: File too large" "$BOLIDE" check large.yaml

# Many checks, all of them wrong, or each with an exact solution of its own, take neither minutes nor
# all memory.
{ plate; echo "checks:"
  for i in $(seq 40000); do echo "  c$i: {mean: presure, at_most: 1 Pa}"; done; } >checks.yaml
refuse 30 "39950 more are not shown" "$BOLIDE" check checks.yaml
{ plate; echo "checks:"
  state="density: 1 kg/m^3, capacity: 1 J/(kg*K), conductivity: 1 W/(m*K), temperature"
  for i in $(seq 6000); do
      echo "  c$i: {l1: temperature, at_most: 1, against: {temperature-jump: {" \
          "left: {$state: $i K}, right: {$state: 300 K}}}}"
  done; } >checks.yaml
sed -i 's/library: aluminium}/library: aluminium, heat: {capacity: 900 J\/(kg*K), temperature: 293 K}}/' \
    checks.yaml
refuse 30 "the exact solutions of the checks take more than 512 MB" "$BOLIDE" check checks.yaml

# No line of a file of another kind is shown.
printf 'root:secret: 1\nuser:secret: 2\n' >foreign
{ echo "include: foreign"; plate; } >include.yaml
refuse 10 "an included file must have keys of a case" "$BOLIDE" check include.yaml
"$BOLIDE" check include.yaml 2>&1 | grep -q secret && fail "an included file is shown"
"$BOLIDE" check foreign 2>&1 | grep -q secret && fail "a file that is no case is shown"

# Controls come out as text, from file names, options and keys.
plate >$'clear\e[2J.yaml'
[[ $("$BOLIDE" check $'clear\e[2J.yaml') != *$'\e'* ]] || fail "a file name steers the terminal"
plate >plate.yaml
refuse 10 'no\x1b[2Jfile.yaml: No such file' "$BOLIDE" check $'no\e[2Jfile.yaml'
refuse 10 'control character \x1b' "$BOLIDE" check plate.yaml --set $'bodies.\e[2J=1'
refuse 10 'control character \x0a' "$BOLIDE" check plate.yaml --set $'a\nplate.yaml: all is well=1'
refuse 10 'control character \x1b' "$BOLIDE" check plate.yaml --set 'title="\e[2J"'

# Time grows with the size of a case, not with its square.
{ plate; seq -f 'key%.0f: 1' 100000; } >keys.yaml
refuse 20 "99950 more are not shown" "$BOLIDE" check keys.yaml
{ plate; seq 10 20000 | awk '{ print "  b" $1 ": {material: aluminium, nonsense" $1 ": 1, moreover: 2, box: {from: [" $1 " mm], to: [" $1 + 1 " mm]}, resolution: 1 mm}" }'; } >odd.yaml
refuse 20 "are not shown" "$BOLIDE" check odd.yaml
{ plate; echo "let:"; seq -f '  name%.0f: 1 mm' 100000; } >let.yaml
limited 20 "$BOLIDE" check let.yaml >/dev/null || fail "a hundred thousand names take too long"
{ plate; seq 10 20000 | awk '{ print "  b" $1 ": {material: aluminium, box: {from: [" $1 " mm], to: [" $1 + 1 " mm]}, resolution: 1 mm}" }'; } >bodies.yaml
limited 20 "$BOLIDE" check bodies.yaml >/dev/null || fail "twenty thousand bodies take too long"

# Numbers that only a slip or an attacker writes.
refuse 10 "wider than all bodies" "$BOLIDE" check plate.yaml --set 'solver={mpm: {cell: 1e30 m}}'
refuse 10 "out of range: it must be 1e-06" "$BOLIDE" check plate.yaml --set 'solver={mpm: {courant: 1e-300}}'
refuse 10 "8e+27 sites, more than the 2.81e+14" "$BOLIDE" check plate.yaml --set 'resolution=1e-30 m'
refuse 10 "a coarser resolution" "$BOLIDE" check plate.yaml --set 'resolution=1e-12 m'
refuse 10 "bins over" "$BOLIDE" check plate.yaml --set 'profiles={p: {fields: [pressure], width: 1e-30 m}}'
for command in check run; do
    refuse 10 "velocity: this is faster than light" "$BOLIDE" $command plate.yaml \
        --set 'bodies.target.velocity=[1e200 m/s]'
    refuse 10 "velocity: this is faster than light" "$BOLIDE" $command plate.yaml \
        --set 'bodies.target.velocity=[1e12 1/s*x]'
done
refuse 10 "more sites than ids" "$BOLIDE" check plate.yaml --set dimension=2 --set 'bodies={
    disc: {material: aluminium, ball: {center: [0, 0], radius: 5 mm}, lattice: {rings: {count: 1}}, resolution: 1 nm}}'
refuse 10 "take too long to count" "$BOLIDE" check plate.yaml --set dimension=2 --set 'resolution=0.1 mm' --set 'bodies={b: {
    material: aluminium, repeat: {count: [300, 300], step: [0.01 mm, 0.01 mm], shape: {repeat: {count: [300, 300],
    step: [0.01 mm, 0.01 mm], shape: {ball: {center: [0, 0], radius: 3 mm}}}}}}}'
refuse 10 "out of range: it must be 0 to 1e+06" "$BOLIDE" check plate.yaml --set dimension=2 --set 'bodies={
    disc: {material: aluminium, ball: {center: [0, 0], radius: 5 mm}, lattice: {rings: {count: 2147483647}}}}'
refuse 10 "move the case to within" "$BOLIDE" check plate.yaml --set 'bodies={
    far: {material: aluminium, box: {from: [1e12 m], to: [1e12 m + 8 mm]}}}'
said=$("$BOLIDE" check plate.yaml --set 'resolution=1e-11 m' --set 'bodies={ball: {material: aluminium,
    ball: {center: [0], radius: 4 mm}}}' 2>&1 & sleep 1; kill $! 2>/dev/null)
[[ $said == *"counting particles, which may take minutes"* ]] || fail "a long count is not announced: $said"
exit $status
