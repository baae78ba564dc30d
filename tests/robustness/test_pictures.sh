#!/bin/bash
# Pictures: the same bytes on threads and ranks and from snapshots; equal frames; a shield with no key of
# pictures shows hole, cloud and wall in the first picture of its report.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"
cat >shield.yaml <<'END'
format: 1
title: A shield
dimension: 2
geometry: axisymmetric
let: {d: 4 mm, n: 8}
resolution: d/n
solver: mpm
materials: {metal: {library: aluminium-tillotson, failure: {spall: {strength: 1.26 GPa}}}}
bodies:
  ball: {material: metal, velocity: [0 m/s, -6 km/s], ball: {center: [0 mm, d/2], radius: d/2}}
  bumper: {material: metal, box: {from: [0 mm, -1 mm], to: [3*d, 0 mm]}}
  wall: {material: metal, box: {from: [0 mm, -12 mm], to: [3*d, -10 mm]}}
run: {until: 2.5 us}
output: {every: 1 us}
END
rm -rf one two ranks none before listed
"$BOLIDE" run shield.yaml --threads 1 --output one >one.log 2>&1 || fail "the run: $(tail -n 3 one.log)"
"$BOLIDE" run shield.yaml --threads 2 --output two >two.log 2>&1 || fail "on two threads: $(tail -n 3 two.log)"
if [ -n "${BOLIDE_MPIRUN:-}" ]; then
    OMP_NUM_THREADS=1 $BOLIDE_MPIRUN -n 2 "$BOLIDE" run shield.yaml --output ranks >ranks.log 2>&1 </dev/null ||
        fail "on two ranks: $(tail -n 3 ranks.log)"
else
    cp -r two ranks
fi
names=$(cd one/pictures && ls)
[ "$(echo $names)" = "body-000000.png body-000001.png body-000002.png body-000003.png" ] || fail "pictures: $names"
for name in $names; do
    cmp "one/pictures/$name" "two/pictures/$name" || fail "$name on two threads"
    cmp "one/pictures/$name" "ranks/pictures/$name" || fail "$name on two ranks"
done
cp -r one/pictures before
"$BOLIDE" picture one >picture.log 2>&1 || fail "bolide picture: $(cat picture.log)"
[ "$(wc -l <picture.log)" = 4 ] || fail "bolide picture said $(cat picture.log)"
for name in $names; do cmp "one/pictures/$name" "before/$name" || fail "$name from snapshots"; done

# Other pictures, from snapshots; mistakes.
"$BOLIDE" picture one speed both --at 1us --set pictures.both.field='[pressure, speed]' \
    --set pictures.speed.log=yes --set pictures.speed.range.low=1m/s >other.log 2>&1 || fail "others: $(cat other.log)"
[ -s one/pictures/speed-000001.png ] && [ -s one/pictures/both-000001.png ] || fail "others: $(ls one/pictures)"
"$BOLIDE" run shield.yaml --threads 1 --set 'output.pictures=[density, speed]' \
    --set output.pictures.speed.log=yes --output listed >listed.log 2>&1 || fail "a list: $(cat listed.log)"
"$BOLIDE" picture listed pressure speed --at last --set pictures.speed.range.low=1m/s >listed.log 2>&1 ||
    fail "a list: $(cat listed.log)"
[ -s listed/pictures/density-000000.png ] && [ -s listed/pictures/pressure-000003.png ] ||
    fail "pictures of a list: $(ls listed/pictures)"
"$BOLIDE" picture one --set pictures.body.view=sideways >wrong.log 2>&1
[ $? = 2 ] && grep -q 'unknown.*"sideways"\|"sideways"' wrong.log || fail "a wrong view: $(cat wrong.log)"
"$BOLIDE" picture one body --at 1m >wrong.log 2>&1
[ $? = 2 ] && grep -q 'is not a time' wrong.log || fail "a wrong time: $(cat wrong.log)"

# Without snapshots the pictures are the same; with `pictures: []` there are none.
"$BOLIDE" run shield.yaml --threads 1 --set output.snapshots=no --output none >none.log 2>&1 || fail "$(cat none.log)"
for name in $names; do cmp "one/pictures/$name" "none/pictures/$name" || fail "$name without snapshots"; done
[ -z "$(ls none/snapshots)" ] || fail "snapshots are left: $(ls none/snapshots)"
"$BOLIDE" run shield.yaml --set output.pictures=[] --output none --overwrite >none.log 2>&1 || fail "$(cat none.log)"
[ -z "$(ls none/pictures)" ] || fail "pictures: [] draws $(ls none/pictures)"

# One size; wall, bumper and ball are in the last frame of the report, and the hole is white.
cat >look.py <<'PYTHON'
import struct, sys, zlib
def read(path):
    data = open(path, "rb").read()
    width, height = struct.unpack(">II", data[16:24])
    at, packed = 8, b""
    while at < len(data):
        size, = struct.unpack(">I", data[at:at + 4])
        if data[at + 4:at + 8] == b"IDAT":
            packed += data[at + 8:at + 8 + size]
        at += 12 + size
    raw, rows, last, step = zlib.decompress(packed), [], bytes(3 * width), 3 * width + 1
    for y in range(height):
        kind, line = raw[y * step], bytearray(raw[y * step + 1:(y + 1) * step])
        for i in range(len(line)):
            a, b, c = line[i - 3] if i >= 3 else 0, last[i], last[i - 3] if i >= 3 else 0
            p = a + b - c
            paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            line[i] = line[i] + (0, a, b, (a + b) // 2, paeth)[kind] & 255
        rows.append(bytes(line))
        last = line
    return width, height, rows
sizes = {open(p, "rb").read()[16:24] for p in sys.argv[1:]}
assert len(sizes) == 1, "frames of several sizes"
width, height, rows = read(sys.argv[-1])
pixels = lambda row: [row[3 * x:3 * x + 3] for x in range(width)]
colours = [bytes.fromhex(c) for c in ("0072b2", "d55e00", "009e73")]
count = {c: sum(pixels(row).count(c) for row in rows) for c in colours}
assert min(count.values()) > 500, f"a body is not seen: {count}"
bumper = max(rows, key=lambda row: pixels(row).count(colours[1]))
line = pixels(bumper)
first, last = line.index(colours[1]), width - 1 - line[::-1].index(colours[1])
white = sum(p == b"\xff\xff\xff" for p in line[first:last])
assert white > 0.15 * (last - first), f"the hole has {white} of {last - first} pixels"
PYTHON
python3 look.py one/pictures/body-00000[0-3].png || fail "the pictures of the shield"
exit $status
