#!/bin/bash
# report.html: whole, needing nothing but itself, and right in a browser; for runs that finish, stop, fail or
# are killed.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"
cases=$BOLIDE_SOURCE_DIR/examples
says() { grep -qF "$2" "$1/report.html" || fail "$1/report.html does not say \"$2\""; }

rm -rf whole known profile many stopped failed killed copied
"$BOLIDE" run "$cases/porous-aluminium/demo/case.yaml" --short --output whole >whole.log 2>&1 ||
    fail "the demo: $(cat whole.log)"
says whole "Porous aluminium hits a wall at 1000 m/s"
says whole "Passed: 9 of 9 checks."
"$BOLIDE" run "$cases/porous-aluminium/two-waves/case.yaml" --set "output.pictures=[]" --output known \
    >known.log 2>&1 || fail "a case with a known deviation: $(cat known.log)"
says known "Passed: 7 of 8 checks.</strong> <strong>1 known deviation:"
"$BOLIDE" run "$cases/riemann/gas/case.yaml" --set 'title="<b>&\"quoted\" ends"' --output profile \
    >profile.log 2>&1 || fail "the shock tube: $(cat profile.log)"
says profile "&lt;b&gt;&amp;&quot;quoted&quot; ends"
"$BOLIDE" run "$cases/riemann/gas/case.yaml" --set output.every=125us --output many \
    --set "output.pictures=[density, pressure, speed]" >many.log 2>&1 || fail "33 frames: $(cat many.log)"
for folder in whole many; do
    [ "$(stat -c %s $folder/report.html)" -lt 5000000 ] || fail "the page of $folder is large"
done

# From the files alone, wherever they are; and without those that are missing.
cp -r whole copied
rm copied/report.html
"$BOLIDE" report copied >report.log 2>&1 || fail "bolide report: $(cat report.log)"
cmp whole/report.html copied/report.html || fail "bolide report makes another page"
rm -r copied/summary.csv copied/checks.csv copied/history.csv copied/case.yaml copied/pictures
"$BOLIDE" report copied >report.log 2>&1 || fail "bolide report of a poor folder: $(cat report.log)"
says copied "no summary"
"$BOLIDE" report . >report.log 2>&1
[ $? = 2 ] || fail "a folder without a run must be refused: $(cat report.log)"

# A run that fails says why; one that is stopped or killed says so.
"$BOLIDE" run "$cases/riemann/gas-standard/case.yaml" --set solver.sph.courant=0.4 \
    --set run.energy_drift=1e-3 --output failed >failed.log 2>&1
[ $? = 3 ] || fail "the failing run: $(cat failed.log)"
says failed "The run failed at step"
says failed "energy has drifted"
for how in TERM KILL; do
    folder=stopped
    [ $how = KILL ] && folder=killed
    "$BOLIDE" run "$cases/impact/steel-cube-0/case.yaml" --set "output.pictures=[]" --output $folder \
        >$folder.log 2>&1 &
    runner=$!
    await $runner $folder/history.csv
    kill -$how $runner
    wait $runner 2>/dev/null
done
says stopped "Stopped early at step"
"$BOLIDE" report killed >report.log 2>&1 || fail "bolide report of a killed run: $(cat report.log)"
says killed "Not at its end"

# Every tag is closed, every reference is to the page itself, every picture is whole.
cat >check.py <<'PYTHON'
import base64, html.parser, re, struct, sys
EMPTY = {"meta", "img", "br", "path", "rect", "input"}
class Check(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.open, self.pictures, self.ids = [], 0, set()
    def handle_starttag(self, tag, attributes):
        if tag not in EMPTY:
            self.open.append(tag)
        for key, value in attributes:
            if key == "id":
                assert value not in self.ids, f"two elements are called {value}"
                self.ids.add(value)
            assert not key.startswith("on"), f"a script in {key}"
            if key in ("src", "href", "xlink:href", "srcset", "action", "data", "poster"):
                head, _, text = value.partition(",")
                assert head == "data:image/png;base64", f"{key} refers to {value[:60]}"
                picture = base64.b64decode(text, validate=True)
                assert picture[:8] == b"\x89PNG\r\n\x1a\n" and picture[-8:-4] == b"IEND"
                width, height = struct.unpack(">II", picture[16:24])
                assert dict(attributes)["width"] == str(width), "a picture's width"
                assert dict(attributes)["alt"], "a picture without words"
                self.pictures += 1
    def handle_startendtag(self, tag, attributes):
        assert tag in EMPTY, f"<{tag}/>"
        self.handle_starttag(tag, attributes)
    def handle_endtag(self, tag):
        assert self.open and self.open.pop() == tag, f"</{tag}> closes nothing"
for name, pictures in [a.split(":") for a in sys.argv[1:]]:
    text = open(f"{name}/report.html", encoding="utf-8").read()
    check = Check()
    check.feed(text)
    check.close()
    assert not check.open, f"{name}: {check.open} stay open"
    assert check.pictures >= int(pictures), f"{name}: {check.pictures} pictures"
    text = re.sub(r"<script>.*?</script>", "", text, flags=re.S) # of dygraphs, which names its licence
    assert not re.search(r"https?:|url\(|@import", text), f"{name}: refers to something outside"
    assert not re.search(r'd="[^"]*(nan|inf)', text), f"{name}: a line through no number"
PYTHON
python3 check.py whole:12 profile:2 many:99 copied:0 failed:0 stopped:0 killed:0 || fail "a page is not well formed"

# In a browser: the player works, and nothing reaches beyond the side of a telephone.
if [ ! -x /usr/bin/chromium ]; then
    echo "no browser is installed: the pages were not opened"
    exit $status
fi
home=$(mktemp -d)
trap 'rm -rf "$home"' EXIT
browse() {
    timeout 600 /usr/bin/chromium --headless --no-sandbox --disable-gpu --disable-background-networking \
        --disable-component-update --disable-sync --no-first-run --user-data-dir="$home" "$@" 2>browser.log
}
cat >probe.txt <<'HTML'
<script>
const width = document.documentElement.scrollWidth <= window.innerWidth ? 'fits' : 'is too wide';
const player = document.querySelector('.player'), slider = player && player.querySelector('input');
let works = 'no player';
let plots = 'no plots';
if (window.bolidePlots && bolidePlots.length) {
  const group = bolidePlots[0], graph = group.plots[0].graph, button = document.querySelector('p.controls button');
  const range = () => '' + graph.xAxisRange();
  const all = group.plots.every(p => p.figure.querySelectorAll('canvas').length >= 2);
  graph.updateOptions({dateWindow: [group.times.whole[0], group.times.whole[0] + (group.times.whole[1] - group.times.whole[0]) / 2]});
  graph.setSelection(1);
  graph.resetZoom();
  if (button) { const box = button.parentNode.nextElementSibling; button.click(); button.click(); }
  plots = all && document.querySelectorAll('.plot').length === bolidePlots.reduce((n, g) => n + g.plots.length, 0) ? 'plots work' : 'a plot is missing';
}
if (player) {
  const press = key => slider.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true}));
  const shown = () => [...player.querySelectorAll('figure')].findIndex(f => f.offsetParent !== null);
  const last = +slider.max, seen = [shown()];
  for (const key of ['ArrowLeft', 'Home', 'ArrowLeft', 'ArrowRight', 'End']) { press(key); seen.push(shown()); }
  works = '' + seen === '' + [last, last - 1, 0, 0, 1, last] ? 'player works' : 'player shows ' + seen;
}
document.title = `page ${width}; ${works}; ${plots}`;
</script>
HTML
for page in whole profile failed; do
    cat $page/report.html probe.txt >probed.html
    for size in 390,800 1280,900; do
        browse --window-size=$size --dump-dom "file://$PWD/probed.html" >seen.html
        grep -q '<title>page fits' seen.html || fail "$page at $size: $(grep '<title>' seen.html)"
        [ $page = failed ] || grep -q 'plots work' seen.html || fail "$page: $(grep '<title>' seen.html)"
        [ $page != whole ] || grep -q 'player works' seen.html || fail "$page: $(grep '<title>' seen.html)"
    done
done
browse --screenshot=page.png --window-size=1280,900 "file://$PWD/whole/report.html" >seen.html
[ "$(stat -c %s page.png)" -gt 20000 ] || fail "the picture of the page is empty"
browse --no-pdf-header-footer --print-to-pdf=page.pdf "file://$PWD/whole/report.html" >seen.html
[ "$(head -c 5 page.pdf)" = "%PDF-" ] || fail "the page was not printed"
exit $status
