#!/bin/bash
# The viewer, whose every control a headless browser operates without a script error or a request; films, which have
# as many frames as there are snapshots.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"
cat >shield.yaml <<'END'
format: 1
dimension: 3
let: {d: 4 mm, n: 6}
resolution: d/n
solver: mpm
materials: {metal: {library: aluminium-tillotson, failure: {spall: {strength: 1.26 GPa}}}}
boundaries:
  left:  {kind: reflecting, axis: x, at: 0 mm, side: low}
  below: {kind: reflecting, axis: y, at: 0 mm, side: low}
bodies:
  ball:
    material: metal
    velocity: [0 m/s, 0 m/s, 6 km/s]
    intersection:
      shapes:
        - ball: {center: [0 mm, 0 mm, -d/2], radius: d/2}
        - box: {from: [0 mm, 0 mm, -d], to: [d, d, 0 mm]}
  bumper: {material: metal, box: {from: [0 mm, 0 mm, 0 mm], to: [2*d, 2*d, 1 mm]}}
run: {until: 2 us}
output: {every: 0.25 us, pictures: [body]}
END
rm -rf shield
"$BOLIDE" run shield.yaml --output shield >run.log 2>&1 || fail "the run: $(tail -n 3 run.log)"
"$BOLIDE" view shield --fields speed,pressure,damage >view.log 2>&1 || fail "view: $(cat view.log)"
grep -q "of 9 snapshots\|9 of 9" view.log || fail "view said $(cat view.log)"
"$BOLIDE" view shield --limit 150kB --output small.html >small.log 2>&1 || fail "a small page: $(cat small.log)"
[ "$(stat -c %s small.html)" -le 150000 ] || fail "the small page has $(stat -c %s small.html) bytes"
"$BOLIDE" view shield --fields speed,colour >wrong.log 2>&1
[ $? = 2 ] && grep -q 'no snapshot has the field "colour"' wrong.log || fail "a wrong field: $(cat wrong.log)"
"$BOLIDE" view shield --limit many >wrong.log 2>&1
[ $? = 2 ] || fail "a wrong limit: $(cat wrong.log)"

# An APNG needs no program; its frames are those of the pictures.
"$BOLIDE" film shield body --format apng >film.log 2>&1 || fail "film: $(cat film.log)"
python3 - <<'PYTHON' || fail "the APNG"
import struct, zlib
data, at, frames, number = open("shield/body.png", "rb").read(), 8, 0, 0
while at < len(data):
    size, = struct.unpack(">I", data[at:at + 4])
    name, body = data[at + 4:at + 8], data[at + 8:at + 8 + size]
    assert zlib.crc32(name + body) == struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0]
    if name == b"acTL":
        assert struct.unpack(">I", body[:4])[0] == 9
    if name in (b"fcTL", b"fdAT"):
        assert struct.unpack(">I", body[:4])[0] == number
        number += 1
    frames += name == b"fcTL"
    at += 12 + size
assert frames == 9, frames
PYTHON
cp -r shield broken
head -c 1000 broken/pictures/body-000003.png >half && mv half broken/pictures/body-000003.png
# Of a size: the folder keeps its pictures.
"$BOLIDE" film shield body --format apng --size 640x360 >film.log 2>&1 || fail "a film of a size: $(cat film.log)"
[ "$(od -An -tx1 -j16 -N8 shield/body.png | tr -d ' ')" = 0000028000000168 ] || fail "the film is not 640x360"
[ ! -e shield/.frames ] || fail "the frames of a film were left"
"$BOLIDE" film broken body --format apng >wrong.log 2>&1
[ $? = 2 ] && grep -q "body-000003.png" wrong.log || fail "half a frame: $(cat wrong.log)"
if command -v ffmpeg >/dev/null && command -v ffprobe >/dev/null; then
    "$BOLIDE" film shield >film.log 2>&1 || fail "film: $(cat film.log)"
    frames=$(ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 shield/body.mp4)
    [ "${frames%,}" = 9 ] || fail "the mp4 has $frames frames"
fi

if [ ! -x /usr/bin/chromium ]; then
    echo "no browser is installed: the viewer was not opened"
    exit $status
fi
home=$(mktemp -d)
trap 'rm -rf "$home"' EXIT
cat >probe.txt <<'HTML'
<script>
const faults = [];
window.onerror = m => faults.push(m);
const look = () => {
  if (window.bolideFailed) { document.title = 'failed: ' + bolideFailed; return; }
  if (!window.bolide || !bolide.ready) { setTimeout(look, 50); return; }
  const get = id => document.getElementById(id), canvas = get('gl'), gl = canvas.getContext('webgl2');
  const hash = () => { bolide.draw(); const w = canvas.width, h = canvas.height, p = new Uint8Array(4 * w * h);
    gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, p); let s = 0; for (let i = 0; i < p.length; i += 4) s = (s * 31 + p[i] + 7 * p[i + 1] + 13 * p[i + 2]) % 4294967291; return s; };
  const over = get('over'), at = (type, x, y, more) => over.dispatchEvent(Object.assign(new PointerEvent(type, {clientX: x, clientY: y, pointerId: 1, ...more})));
  over.setPointerCapture = () => {};
  const steps = {
    time: () => { get('time').value = 4; get('time').oninput({target: get('time')}); },
    field: () => { get('field').value = 0; get('field').onchange({target: get('field')}); },
    low: () => { get('low').value = 2; get('low').onchange({target: get('low')}); },
    high: () => { get('high').value = 4; get('high').onchange({target: get('high')}); },
    log: () => get('log').click(),
    cut: () => { get('cut').value = '+x'; get('cut').onchange({target: get('cut')}); },
    ortho: () => get('ortho').click(),
    dots: () => { get('min').value = 6; get('min').oninput({target: get('min')}); },
    body: () => document.querySelectorAll('#bodies input')[0].click(),
    mirror: () => document.querySelectorAll('#mirrors input')[0].click(),
    drag: () => { at('pointerdown', 300, 300); at('pointermove', 360, 320); at('pointerup', 360, 320); },
    wheel: () => over.dispatchEvent(new WheelEvent('wheel', {deltaY: 200, cancelable: true})),
  };
  const before = hash(), same = [];
  let last = before;
  for (const [name, step] of Object.entries(steps)) { step(); const now = hash(); if (now === last && name !== 'dots') same.push(name); last = now; }
  get('reset').click();
  bolide.S.frame = bolide.S.frame;
  get('play').click(); get('play').click();
  const requests = performance.getEntriesByType('resource').length;
  document.title = 'same: ' + same + '; faults: ' + faults + '; requests: ' + requests + '; reset: ' + (hash() === before);
};
look();
</script>
HTML
cat shield/view.html probe.txt >probed.html
browse() {
    timeout 600 /usr/bin/chromium --headless --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader \
        --disable-background-networking --user-data-dir="$home" --virtual-time-budget=20000 \
        --window-size=900,700 --dump-dom "file://$PWD/probed.html" 2>browser.log
}
browse >seen.html
grep -q '<title>same: ; faults: ; requests: 0; reset: true' seen.html || fail "the viewer: $(grep -o '<title>[^<]*' seen.html)"

# The report holds the viewer, which a button opens.
cat >probe.txt <<'HTML'
<script>
document.getElementById('open-viewer').click();
const look = () => {
  const inner = document.querySelector('iframe.viewer').contentWindow, page = inner.bolide;
  if (inner.bolideFailed) document.title = 'failed: ' + inner.bolideFailed;
  else if (!page || !page.ready) setTimeout(look, 50);
  else document.title = 'opened with ' + inner.document.getElementById('time').max + ' and ' +
    [...inner.document.getElementById('field').options].map(o => o.textContent);
};
look();
</script>
HTML
cat shield/report.html probe.txt >probed.html
browse >seen.html
grep -q '<title>opened with 8 and body,speed,pressure<' seen.html || fail "the report: $(grep -o '<title>[^<]*' seen.html)"
exit $status
