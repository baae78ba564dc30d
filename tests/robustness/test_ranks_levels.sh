#!/bin/bash
# Cells of several levels on several ranks: the same bits as on one, with any number of threads, while levels change and
# blocks go to other ranks. $BOLIDE_MPIRUN starts several processes.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"

# One gas that flows in beside an axis, around a ball.
cat >inflow.yaml <<'END'
format: 1
dimension: 2
geometry: axisymmetric
resolution: 2 mm
levels: 3
solver: {gas: {regrid: 1}}
materials: {air: {eos: {ideal-gas: {density: 1.2 kg/m^3, gamma: 1.4}}}}
bodies:
  air: {material: air, box: {from: [0 m, 0 m], to: [0.32 m, 0.48 m]}, pressure: 0.1 MPa, density: 1.2 kg/m^3}
boundaries:
  low: {kind: inflow, axis: y, at: 0 m, side: low, part: {box: {from: [0 m, -1 m], to: [0.1 m, 1 m]}},
    density: 3 kg/m^3, pressure: 0.5 MPa, velocity: [0 m/s, 400 m/s]}
  block: {kind: rigid-body, part: {ball: {center: [0 m, 0.3 m], radius: 30 mm}}}
run: {until: 1 s, max_steps: 100, rebalance: 15}
output: {pictures: [pressure]}
END

# Two materials in 3-D that begin with a 1-D run.
cat >shells.yaml <<'END'
format: 1
dimension: 1
geometry: spherical
resolution: 2 mm
solver: gas
materials:
  air: {eos: {ideal-gas: {density: 1.2 kg/m^3, gamma: 1.4}}}
  hot: {eos: {ideal-gas: {density: 10 kg/m^3, gamma: 1.25}}}
bodies:
  air: {material: air, pressure: 0.1 MPa, density: 1.2 kg/m^3, box: {from: [0 m], to: [0.5 m]}}
  hot: {material: hot, pressure: 20 MPa, density: 10 kg/m^3, box: {from: [0 m], to: [60 mm]}, replaces: air}
run: {until: 30 us}
END
cat >octant.yaml <<'END'
format: 1
dimension: 3
resolution: 10 mm
levels: 3
solver: {gas: {regrid: 2, cells_to_front: 8}}
materials:
  air: {eos: {ideal-gas: {density: 1.2 kg/m^3, gamma: 1.4}}}
  hot: {eos: {ideal-gas: {density: 10 kg/m^3, gamma: 1.25}}}
bodies:
  air: {material: air, pressure: 0.1 MPa, density: 1.2 kg/m^3, box: {from: [0 m, 0 m, 0 m], to: [0.64 m, 0.48 m, 0.32 m]}}
start: {from: shells.yaml, material: hot}
boundaries:
  x: {kind: reflecting, axis: x, at: 0 m, side: low}
  y: {kind: reflecting, axis: y, at: 0 m, side: low}
  z: {kind: reflecting, axis: z, at: 0 m, side: low}
run: {until: 1 s, max_steps: 24, rebalance: 7}
END

# Levels at rest along a line that repeats itself, which more ranks than blocks share.
cat >line.yaml <<'END'
format: 1
dimension: 1
resolution: 1 mm
levels: 3
solver: {gas: {regrid: 0}}
fine: {middle: {box: {from: [300 mm], to: [310 mm]}}}
materials: {air: {eos: {ideal-gas: {density: 1.2 kg/m^3, gamma: 1.4}}}}
bodies:
  air: {material: air, pressure: 0.1 MPa, density: 1.2 kg/m^3, box: {from: [0 m], to: [0.768 m]}}
  hot: {material: air, pressure: 1 MPa, density: 1.2 kg/m^3, box: {from: [0 m], to: [0.2 m]}, replaces: air}
boundaries: {ends: {kind: periodic, axis: x}}
run: {until: 1 s, max_steps: 100}
END

for case in "$BOLIDE_SOURCE_DIR/tests/data/everything-levels.yaml" inflow.yaml octant.yaml line.yaml; do
    rm -rf whole
    "$BOLIDE" run "$case" --threads 1 --output whole >whole.log 2>&1 || fail "$case: $(cat whole.log)"
    for ranks in 1 2 3 4; do
        for threads in 1 2; do
            rm -rf other
            OMP_NUM_THREADS=$threads $BOLIDE_MPIRUN -n $ranks "$BOLIDE" run "$case" --threads $threads --output other \
                >other.log 2>&1 </dev/null || fail "$case on $ranks ranks: $(cat other.log)"
            same whole other || fail "$case on $ranks ranks, $threads threads each"
        done
    done
done
exit $status
