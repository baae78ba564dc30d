#!/bin/bash
# What a run with gas beside material points warns of or refuses: solids near the gas, cells that are
# too coarse, a blast at the start where material points begin at rest.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"
rm -rf near far into thin early late

# A piston that comes to the gas at the open face of the region: a warning, in the verdict too; then
# an error. Cells that are too coarse are repeated in the verdict.
cat >piston.yaml <<'END'
format: 1
dimension: 1
resolution: 5 mm
materials:
  air: {eos: {ideal-gas: {density: 1.2 kg/m^3, gamma: 1.4}}}
  steel: {library: steel-1006}
bodies:
  piston: {material: steel, velocity: [100 m/s], driven: yes, box: {from: [0 m], to: [0.2 m]}}
  air: {material: air, pressure: 1 bar, box: {from: [0.2 m], to: [1 m]}}
solver: {cfdmp: {region: {low: [0 m], high: [0.4 m]}}}
run: {until: 1.45 ms}
output: {history: 0.1 ms, snapshots: no}
END
"$BOLIDE" run piston.yaml --output near >near.log 2>&1 || fail "a piston near the face: $(cat near.log)"
tail -n 5 near.log | grep -q "warning: region in steel: a solid .* in body \"piston\"" ||
    fail "no verdict on a piston near the face: $(cat near.log)"
"$BOLIDE" run piston.yaml --set run.until="1 ms" --output far >far.log 2>&1 &&
    ! grep -q "region in" far.log || fail "a piston far from the face: $(cat far.log)"
"$BOLIDE" run piston.yaml --set run.until="3 ms" --output into >into.log 2>&1
[ $? = 3 ] && grep -q "the solid \"piston\" has come to" into.log ||
    fail "a piston in the overlap: $(cat into.log)"
"$BOLIDE" run piston.yaml --set bodies.piston.box.from="[0.18 m]" --set domain="{low: [0 m], high: [1 m]}" \
    --set run.until="0.1 ms" --output thin >thin.log 2>&1
tail -n 5 thin.log | grep -q "warning: coarse: .*bodies.piston: 2 cells thick along x" ||
    fail "no verdict on a thin plate: $(cat thin.log)"
"$BOLIDE" check piston.yaml --set solver.cfdmp.mpm.cell="5 mm" >one.log 2>&1
grep -q "warning: .*bodies.air: one particle a cell" one.log ||
    fail "no word on one particle a cell: $(cat one.log)"

# A piston, or a liquid, without strength would be gas.
"$BOLIDE" check piston.yaml --set materials.steel.strength=none >fluid.log 2>&1
[ $? = 2 ] && grep -q 'bodies.piston: .* gas has no prescribed motion: give "steel" a `strength`' fluid.log ||
    fail "a fluid piston: $(cat fluid.log)"
"$BOLIDE" check piston.yaml --set materials.steel.strength=none --set bodies.piston.driven=no >fluid.log 2>&1
[ $? = 2 ] && grep -q 'bodies.piston: .* of two both must be gases: give "steel" a `strength`' fluid.log ||
    fail "a liquid beside air: $(cat fluid.log)"

# A blast from a case of one dimension.
cat >blast.yaml <<'END'
format: 1
dimension: 1
geometry: cylindrical
resolution: 2 mm
materials: {air: {eos: {ideal-gas: {density: 1.2 kg/m^3, gamma: 1.4}}}}
bodies:
  air: {material: air, pressure: 1 bar, box: {from: [0 m], to: [0.5 m]}}
  hot: {material: air, pressure: 100 bar, replaces: air, box: {from: [0 m], to: [20 mm]}}
solver: gas
run: {until: 0.2 ms}
END
cat >plate.yaml <<'END'
format: 1
dimension: 2
resolution: 5 mm
materials:
  air: {eos: {ideal-gas: {density: 1.2 kg/m^3, gamma: 1.4}}}
  steel: {library: steel-1006}
bodies:
  air: {material: air, pressure: 1 bar, box: {from: [-0.2 m, -0.2 m], to: [0.3 m, 0.2 m]}}
  plate: {material: steel, pressure: 1 bar, replaces: air, box: {from: [0.2 m, -0.2 m], to: [0.25 m, 0.2 m]}}
start: {from: blast.yaml, at: 30 us}
domain: {low: [-0.2 m, -0.2 m], high: [0.3 m, 0.2 m]}
solver: {cfdmp: {region: {low: [0.1 m, -0.2 m], high: [0.3 m, 0.2 m]}}}
run: {until: 1 us}
output: {snapshots: no}
END
"$BOLIDE" run plate.yaml --output early >early.log 2>&1 || fail "a blast before the region: $(cat early.log)"
"$BOLIDE" run plate.yaml --set start.at="60 us" --output late >late.log 2>&1
[ $? = 2 ] && grep -q "the blast has a radius of .* is 0.1 m from its centre" late.log ||
    fail "a blast in the region: $(cat late.log)"

exit $status
