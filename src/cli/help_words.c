/* Help on words that users type and that are no names of the program: what to do, or that it is not
 * available and what to do instead. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "cli/cli.h"

/* An answer to any of WORDS, which are in lower case, singular, and have blanks around them; a word
 * of several parts has dots. */
struct answer {
    const char *words, *text;
    const char *page; /* that says more, in docs/; NULL for none */
};

static const struct answer answers[] = {
    {" spall spalling spallation pull.back pullback scabbing visar pdv fsv free.surface "
     "free.surface.velocity free.surface.history free.face rear.face ",
     "Give the material a failure model with a spall strength (bolide help failure):\n"
     "  failure: {spall: {strength: 1.3 GPa, stress: mean}}\n"
     "and put a tracer at the free face, where a VISAR looks (two resolutions inside it where\n"
     "the shock is stronger than five times the spall strength). A worked case\n"
     "is on the page below.",
     "tasks/spall.md"},
    {" fracture fragmentation fragment crack failure ",
     "Give the material a failure model; `bolide help failure` lists them:\n"
     "  failure: {spall: {strength: 1.3 GPa}}   breaks where the tension reaches a strength\n"
     "  failure: {johnson-cook: ...}            ductile damage; the library has sets\n"
     "A metal without one never breaks; the run warns when the tension exceeds what the real\n"
     "metal bears. Ceramics and glass (strength: johnson-holmquist), concrete (hjc) and soil\n"
     "(drucker-prager) fail by themselves.\n"
     "Checks measure fragments and largest_fragment; output: {fragments: yes} lists them.",
     "failure.md"},
    {" tension tensile.strength ",
     "A run warns (`tension in NAME`) when a solid carries a mean tension above its\n"
     "`tensile_strength` or, without one, above K/20. Real material would break there. Set\n"
     "`materials.NAME.failure` (bolide help failure), or choose an end of the run before it.\n"
     "If the checks do not depend on it, list it in `expected_warnings` with the reason.\n"
     "Contacts with `tension: none` let bodies separate.",
     "failure.md"},
    {" warning tensile.instability expected.warning ",
     "A run warns by name when something happens that its models do not cover: `tension`,\n"
     "`speed`, `temperature`, `density`, `tensile-instability` (SPH in lasting tension: use\n"
     "`solver: mpm`), `unlit` (an explosive is compressed before its detonation arrives),\n"
     "`energy`, `tracer` (its particle has failed), `region` (a solid of a coupling near the\n"
     "gas) and `coarse` (its cells). The run goes on. `bolide verify` fails, unless the case\n"
     "lists the warning in `expected_warnings` with the reason why its checks hold.",
     "case.md"},
    {" mott mott.distribution expanding.ring bursting.cylinder weibull scatter ",
     "Failure strains that scatter make a body break at random, as Mott (1947) assumed: give the\n"
     "`failure` a `weibull_modulus` (bolide help failure) and sweep over seeds. Worked cases, "
     "with\n"
     "Mott's number of fragments: examples/fragmentation. output: {fragments: yes} lists them.",
     "failure.md"},
    {" tear tearing petal petalling rip ",
     "A sheet tears where its material fails: give it a `failure` (bolide help failure) and at\n"
     "least three particles across the thickness. Elements that are cut along a line are not\n"
     "available.",
     "failure.md"},
    {" damage ",
     "The field `damage` is that of a failure model (`bolide help failure`), of ceramics and\n"
     "glass (strength: johnson-holmquist) or of crushed concrete (strength: hjc), 1: failed.\n"
     "Concrete has `tensile_damage` too.",
     "failure.md"},
    {" whipple whipple.shield shield bumper debris debris.cloud hypervelocity hvi ",
     "A sphere through a bumper and its cloud on a wall: a worked case is on the page below.\n"
     "Checks measure `hole`, `bulge` and `fragments`; `bolide search` finds a ballistic limit.",
     "tasks/whipple-shield.md"},
    {" ricochet oblique oblique.impact obliquity ",
     "An oblique impact is 3-D: rotate the projectile or its velocity, and put a mirror wall\n"
     "through the plane of flight, which cuts the bodies in half. Checks take the velocity that "
     "is\n"
     "left, {largest_fragment: velocity.y, of: BODY}, or its angle from an axis, angle.y.",
     "tasks/impact-on-a-plate.md"},
    {" crater hole plate ",
     "A projectile through a plate, with hole and debris cloud: a worked case is on the page\n"
     "below. Checks measure `hole`, `crater`, `bulge`, `zone` and\n"
     "`fragments`.",
     "tasks/impact-on-a-plate.md"},
    {" ballistic.limit ballistic limit.velocity v50 perforation perforate plug plugging bullet ",
     "`bolide search` finds a ballistic limit by bisection: give the plate a `failure` (bolide\n"
     "help failure) and run two resolutions. A worked case is on the page below.",
     "tasks/ballistic-limit.md"},
    {" rod long.rod penetration penetrator depth.of.penetration armour armor ",
     "A long rod into a thick target, beside the theory (bolide help long-rod): see the page\n"
     "below. `bolide new long-rod` writes a case of it.",
     "tasks/long-rod.md"},
    {" hugoniot plate.impact flyer shock.adiabat shock.speed us.up ",
     "Two plates at several speeds, with U_s over U_p: see the page below. `bolide exact\n"
     "impedance-match` has the exact state; `bolide materials NAME --curves` the curves of a\n"
     "material.",
     "tasks/plate-impact.md"},
    {" mesostructure microstructure pore porous porosity foam grain composite packing voronoi "
     "polycrystal random.packing ",
     "Structures are resolved, with shapes: packing, voronoi (random grains), image (PNG), mesh\n"
     "(STL), repeat, template, polygon, difference, and bodies that replace parts of others. Not\n"
     "available: a compaction model (P-alpha) for pores that are not resolved.",
     "microstructures.md"},
    {" p.alpha palpha compaction compaction.model crushing.curve ",
     "Not available for metals and powders: resolve the pores or grains (bolide help porosity).\n"
     "Concrete has a compaction curve: eos: hjc with strength: hjc.",
     "microstructures.md"},
    {" honeycomb sandwich sandwich.panel corrugated core.panel ",
     "The shape `honeycomb` draws the walls of hexagons or squares, and `weights` give them their\n"
     "mass at any cell size. Corrugated cores: `polygon` or `repeat`. There is no homogenised\n"
     "core.",
     "panels.md"},
    {" mixture two.component two.phase impedance.mismatch thermal.equilibrium "
     "velocity.equilibrium ",
     "Grains of both materials are resolved; `profiles` with `by: material` have means by "
     "material\n"
     "and slab, and checks with `minus` and `relative` compare them. There is no homogenised\n"
     "model of a mixture.",
     "mixtures.md"},
    {" calibration optimise optimize optimisation optimization optimiser inverse least.squares "
     "levenberg.marquardt parameter.identification fit fitting taylor taylor.test taylor.bar ",
     "`calibrate` of a case names keys and measured values; `bolide calibrate` fits them and\n"
     "tells which keys the measurements do not tell apart. `bolide search` bisects one key on\n"
     "whether a check passes; `fits` puts lines and power laws through the runs of a sweep.",
     "tasks/calibrate.md"},
    {" grain grains granular granular.bed powder loose.bed sand bed ",
     "`packing` makes a bed of random discs or spheres, `voronoi` one of convex grains.\n"
     "`bolide check` prints the particles across a grain: 12 or more are needed.",
     "tasks/granular-bed.md"},
    {" statistic seed repetition confidence error.bar error.bars standard.deviation ensemble "
     "monte.carlo random random.grains ",
     "Sweep over the seed of a packing and name it in `repetitions`: the sweep then has means "
     "with\n"
     "their confidence (statistics.csv, plots, and fits with `take: mean`).",
     "tasks/random-grains.md"},
    {" restart resume checkpoint continue extend longer change ",
     "bolide run --resume continues a run from its last checkpoint, with the same bits. A later\n"
     "end, other outputs, new probes and checks are free; `bolide help KEY` has the class of a\n"
     "key. `start: {from: FOLDER}` begins another case with the bodies of a run, fewer or more.",
     "tasks/restart.md"},
    {" film movie video animation animate gif ",
     "bolide film FOLDER [NAME] joins the frames of a picture to an mp4 with ffmpeg, or to an\n"
     "animated PNG; --size 1280x720 sets its size. report.html has a player of them, and a\n"
     "viewer (view.html).",
     "tasks/results.md"},
    {" paraview vtk vtkhdf visit ovito python h5py hdf5 csv postprocess postprocessing plot ",
     "Snapshots are VTKHDF files: open snapshots.vtkhdf.series in ParaView, or single files\n"
     "with h5py. Histories, probes, profiles and checks are CSV files.",
     "tasks/results.md"},
    {" mpi mpirun rank cluster slurm parallel core processor thread openmp hpc ",
     "bolide run --ranks 16 starts 16 processes on this machine; on several machines use\n"
     "`mpirun -n 64 bolide run CASE`. --threads limits the threads of a process.",
     "tasks/cluster.md"},
    {" gpu cuda accelerator ", "Not available: Bolide runs on processors, with threads and MPI.",
     "tasks/cluster.md"},
    {" histogram distribution size.distribution ",
     "output: {histograms: {heat: {field: temperature, of: bed, weight: mass}}} writes a table\n"
     "at each snapshot, and the report plots it (`bolide help output.histograms`). Fragments are "
     "in\n"
     "fragments.csv with output: {fragments: yes}. Checks take `quantile`, `spread` and `mean`.",
     "case.md"},
    {" colour color colour.map color.map colormap palette colour.range legend ",
     "All frames of a picture share their colours: percentiles of the run, or what `range` says:\n"
     "  pictures: {speed: {range: {low: 0 m/s, high: 6 km/s}, log: no, palette: sequential}}\n"
     "`bolide picture FOLDER --set pictures.speed.log=yes` draws again.",
     "case.md"},
    {" perspective view camera 3d.picture 3d.view render rendering slice section cut.plane clip ",
     "Pictures of a 3-D run are perspectives, cut open at planes of symmetry; `view: section`\n"
     "shows a plane. Keys: direction, up, cut, plane, slab, window. `bolide picture FOLDER` draws\n"
     "from the snapshots: --set pictures.body.view=section --set pictures.body.plane.x=2mm.",
     "case.md"},
    {" map maps peak.map arrival.map impulse.map maximum.over.time peak.field ",
     "`output: {maps: {top: {peak: pressure}}}` keeps what a field has been at each particle or\n"
     "cell: `peak`, `arrival: {field: pressure, above: 1 MPa}`, `impulse`. Each is a field for\n"
     "pictures, probes and snapshots.",
     "blast.md"},
    {" schlieren shadowgraph density.gradient ",
     "A field of pictures: `pictures: [schlieren]`, of the density; `schlieren: {field: pressure,\n"
     "strength: 20}` in a picture changes it.",
     "case.md"},
    {" experiment measured.data test.data compare.with.experiment compare overlay ",
     "Write the measured value into a check, with its source:\n"
     "  checks: {depth: {crater: {take: depth}, of: plate, is: 12 mm, within: 5 %, source: "
     "\"...\"}}\n"
     "Curves: bolide compare results/a results/b --data test.csv,time=t:us,value=p:GPa,"
     "probe=gauge,\nfield=pressure.",
     "tasks/results.md"},
    {" clamp clamped fixed fix support supported boundary.condition ",
     "With SPH and MPM, a body clamps another that sticks to it: put a body of the same material\n"
     "there, with `driven: yes` and no velocity. A mirror wall lets its face slide. `frozen: yes`\n"
     "is for waves that leave.",
     "case.md"},
    {" symmetry symmetric mirror half.model quarter.model ",
     "A plane of symmetry:\n"
     "    boundaries: {below: {kind: symmetry, axis: y, side: low, at: 0 mm}}\n"
     "`geometry: axisymmetric` makes bodies of revolution in 2-D: x is the radius, y the axis.\n"
     "`geometry: spherical` or `cylindrical` makes x the radius in 1-D, with the gas solver.",
     "case.md"},
    {" periodic periodicity ",
     "With SPH and gas: `boundaries: {ends: {axis: x, kind: periodic}}`. Not available with MPM:\n"
     "two mirror walls repeat a cell that is symmetric.",
     "case.md"},
    {" absorbing transmitting non.reflecting nonreflecting infinite ",
     "With SPH and MPM: a body of the same material with `frozen: yes`, a few particles thick,\n"
     "lets waves leave. With MPM also a boundary of kind outflow. With gas every face without\n"
     "a boundary transmits.",
     "case.md"},
    {" unit.of.stress units.of.stress stress.unit unit.of.pressure units.of.pressure "
     "pressure.unit ",
     "Stress and pressure take Pa, kPa, MPa, GPa, bar, kbar, Mbar and any other unit of a\n"
     "pressure, as N/mm^2. Results are in Pa. Stress is positive in tension, pressure in\n"
     "compression.\n"
     "`bolide help units` lists the symbols.",
     NULL},
    {" kingery bulmash kingery.bulmash conwep ufc swisdak friedlander tnt.equivalent "
     "scaled.distance ",
     "`exact: {kingery-bulmash: {mass: 5 kg, charge: surface}}` has the curves of Kingery and\n"
     "Bulmash: checks (bolide help blast) compare gauges with them. Without a case:\n"
     "  bolide exact kingery-bulmash --set \"mass=5 kg\" --set \"distance=10 m\"\n"
     "A worked case: bolide help charge.",
     "blast.md"},
    {" overpressure incident.pressure peak.pressure impulse arrival arrival.time "
     "positive.phase.duration positive.phase positive.duration gauge.of.blast ",
     "Record the pressure at a gauge, and let checks take what is wanted of it:\n"
     "  probes: {near: {gauge: {at: [2 m, 0 m]}, fields: [pressure]}}\n"
     "  checks: {impulse: {blast: {probe: near, take: impulse}}}\n"
     "`take` is overpressure, arrival, duration or impulse.",
     "blast.md"},
    {" blast air.blast airblast blast.wave afterburn fireball charge tnt.charge bare.charge "
     "height.of.burst reflected.pressure reflected.impulse ",
     "A charge in air, with `solver: gas`, in free air and above ground: a worked case is on the\n"
     "page below. The library's tnt is lit by `detonations`; `afterburn` of the material lets its\n"
     "products burn in the air. Checks compare gauges with `exact: kingery-bulmash`. A blast on a\n"
     "body without gas: `loads: {NAME: {on: plate, blast: {mass: 1 kg, at: [0 m, 2 "
     "m]}}}`\n"
     "(docs/blast.md). Explosive in contact with metal: bolide help burn.",
     "tasks/charge-in-air.md"},
    {" closed.room vented.room room chamber confined.explosion internal.explosion "
     "quasi.static.pressure quasistatic gas.pressure vent venting weibull closed-room ",
     "Gas pressure in a room, with `solver: gas`: `mixing` of `afterburn` lets products burn and\n"
     "mix with the air, to the pressure of chemical equilibrium, which `exact: closed-room` has:\n"
     "  bolide exact closed-room --set explosive=tnt --set \"load=0.1 kg/m^3\"\n"
     "A gauge whose radius is that of the room records the mean. A worked case with a vent is on\n"
     "the page below (docs/blast.md has the rest).",
     "tasks/vented-room.md"},
    {" street facade city urban blast.in.street building.blast ",
     "The blast of a charge in a street, with `solver: gas` and cells of several `levels`: walls "
     "are\n"
     "faces of the domain, and `fine` has small cells before each gauge. A worked case is on the\n"
     "page below; docs/gas.md has the levels.",
     "tasks/street.md"},
    {" charge.above.plate blast.on.plate blast.plate blast.on.structure cfdmp coupling coupled "
     "gas.and.particles fluid.structure ",
     "A charge above a plate that bends or breaks, with `solver: cfdmp`: gas on a grid, and\n"
     "material points in a box around the plate, between which material passes. The detonation is\n"
     "computed in 1-D, and `start` takes it over. A worked case is on the page below;\n"
     "docs/coupling.md has the method.",
     "tasks/charge-above-plate.md"},
    {" shock.tube sod gas.dynamics cfd euler wind.tunnel air grid cells fdm ",
     "`solver: gas` computes a gas in cells, with walls, inflow, outflow, periodic faces and "
     "rigid\n"
     "bodies. A shock tube beside its exact solution: see the page below; docs/gas.md has\n"
     "the method.",
     "tasks/shock-tube.md"},
    {" underwater underwater.explosion undex water.shock cole free.surface stiffened.gas liquid ",
     "Water with `library: water-stiffened` in `solver: gas`, alone, around an explosive or "
     "beside\n"
     "air: peaks and the period of the bubble with `geometry: spherical` in seconds. SPH and MPM\n"
     "take `library: water-shock`, in 2-D, axisymmetry or 3-D, for structures in the water.",
     "tasks/underwater-charge.md"},
    {" cavitation cavity.in.liquid ram hydrodynamic.ram hydraulic.ram ",
     "A liquid with `failure: cavitation` opens bubbles where it would be in tension: with SPH or\n"
     "MPM `library: water-shock`, whose bubbles bear no pressure, with `solver: gas` `library:\n"
     "water-stiffened`, whose pressure does not fall below `vapour`.",
     "failure.md"},
    {" bubble gas.bubble shock.bubble helium sf6 richtmyer meshkov ",
     "Two gases with `solver: gas`, library: air, helium, sf6. The shock comes from a body of gas\n"
     "in the state behind it, long enough for the run: with two gases there is no inflow. Worked\n"
     "cases: examples/gas/shock-bubble-gas and, with SPH, examples/gas/shock-bubble.",
     "gas.md"},
    {" gurney gurney.velocity cylinder.test metal.acceleration flyer.by.explosive ",
     "The wall of a tube full of explosive, beside Gurney's formula: examples/detonation/\n"
     "cylinder-test. The formula itself is not an exact solution of the program.",
     "detonation.md"},
    {" jet shaped.charge liner efp explosively.formed.projectile explosively.formed.penetrator ",
     "An explosive, lit by `detonations`, behind a liner with `failure`, in axisymmetry. Use SPH\n"
     "for jets: with MPM points of a jet are drawn apart by more than a cell. The liner needs six\n"
     "particles across; the speed of the tip still grows with more.",
     "detonation.md"},
    {" initiation initiate ignition.threshold shock.to.detonation sdt gap.test sensitivity ",
     "An explosive lit by a shock needs a rate: `burn: ignition-growth` or `pressure-power`\n"
     "(library: lx-17, pbx-9502, rdx-reactive, petn-reactive). `burn: programmed` is lit where "
     "and\n"
     "when `detonations` says. Worked: examples/detonation/lx-14-run, the run to detonation.",
     "detonation.md"},
    {" explosive detonation tnt detonate ",
     "An explosive is a material with `burn` (bolide help burn; library: tnt), lit by\n"
     "`detonations`. A charge in air: bolide help blast.",
     "materials.md"},
    {" znd reaction.zone von.neumann spike chapman.jouguet cj ignition.and.growth lee.tarver "
     "run.to.detonation rate.stick jwl++ jwlpp critical.diameter ",
     "`bolide materials NAME` prints the detonation of an explosive, and `bolide exact znd --set\n"
     "material=NAME` its reaction zone. `burn: ignition-growth` with `eos: reactive-jwl` resolves\n"
     "that zone in a run, and so does `burn: pressure-power` with `eos: blended-jwl`, JWL++.",
     "detonation.md"},
    {" image png picture micrograph tomography scan ",
     "The shape `image` takes the pixels of a PNG file in a range of grey (bolide help image).",
     "tasks/image.md"},
    {" stl cad mesh geometry.file step.file ",
     "The shape `mesh` is what a closed STL surface encloses (bolide help mesh). Particles are\n"
     "placed in it at the distance `resolution`: there is no volume mesh to make. Convert other\n"
     "formats, such as STEP, to STL.",
     "case.md"},
    {" erosion erode delete element.deletion ",
     "Not needed: particles are not removed, however far they deform.", "choosing.md"},
    {" adaptive amr refinement refine ",
     "Not available: a particle keeps its size. Give each body its own `resolution`.", "case.md"},
    {" melt melting vaporisation vaporization boiling phase phase.transition ",
     "eos: tillotson goes from solid to vapour, and Johnson-Cook strength vanishes at `melt`.\n"
     "Solid-solid transitions, latent heat and melting curves are not available.",
     "materials.md"},
    {" ceramic glass brittle failure.wave tile pane jh2 jh.2 jh-2 holmquist ",
     "strength: johnson-holmquist is JH-2, with damage and bulking. The library has its constants\n"
     "for boron carbide, alumina, aluminium nitride and float glass (names that end in -jh2):\n"
     "  materials: {tile: {library: boron-carbide-jh2}}\n"
     "Failure waves in glass: strength: failure-wave (library: glass-failure-wave). Concrete\n"
     "has a model of its own (strength: hjc).",
     "brittle.md"},
    {" time.step timestep time.step.size cfl courant.number ",
     "The solver chooses the step: the time that a wave takes to cross a particle or a cell, "
     "times\n"
     "a Courant number. Change that number with `courant` of the solver:\n"
     "  solver: {mpm: {courant: 0.2}}\n"
     "Its default is in `bolide help sph`, `mpm` or `gas`.",
     NULL},
    {" hourglass hourglassing hourglass.control zero.energy.mode ",
     "Not needed: particles and cells are no finite elements and have no hourglass modes.",
     "choosing.md"},
    {" eulerian lagrangian ale ",
     "`solver: gas` is Eulerian: gases flow through a fixed grid. SPH and MPM are Lagrangian: "
     "their\n"
     "particles carry the material, through empty space (SPH) or through a grid that is reset "
     "each\n"
     "step (MPM), and deform without limit. An Eulerian grid for solids is not available.",
     "choosing.md"},
    {" equation.of.state ",
     "Every material has one: `eos` of the material. `bolide help eos` lists them with their "
     "keys,\n"
     "`bolide materials` the materials whose constants are known.",
     "materials.md"},
    {" accuracy uncertainty error.bar trust validation how.accurate ",
     "Measured deviations of every case from theory or experiment are on the page below and in\n"
     "the README of each example. For a case of your own run two or three resolutions:\n"
     "bolide verify --convergence CASE gives the errors and an extrapolated value.",
     "accuracy.md"},
    {" depth.over.time depth penetration.depth penetration.history ",
     "A check measures the depth: {minimum: position.y, of: TARGET, axis: x, between: [R/4, R/2]}\n"
     "of the floor of a hole, or `crater`. A probe records it over time: {check: depth, every:\n"
     "1 us}.",
     "tasks/long-rod.md"},
    {" dust debris.mass ",
     "Failed particles are dust: {fragments: {take: dust}, of: BODY} is its mass, `take: mass`\n"
     "with `above` and `below` that of fragments; `output: {fragments: yes}` lists them.",
     "case.md"},
    {" residual residual.velocity residual.length residual.rod ",
     "Residual velocity: {mean: velocity.y, of: BODY} at the end of the run; `bolide search`\n"
     "finds the ballistic limit. Length left of a rod: depth of the hole less the last position\n"
     "of a tracer at its tail; the measure `length` also counts what lines the hole.",
     "tasks/long-rod.md"},
    {" convergence mesh.independence grid.convergence ",
     "bolide verify --convergence CASE runs a case on several resolutions and gives errors and\n"
     "orders.",
     "convergence.md"},
};

/* TOPIC as the table has it: lower case, dots for blanks and hyphens, blanks around. */
static bool as_word(const char *topic, char *word, size_t size)
{
    const size_t length = strlen(topic);
    if (length + 3 > size || strpbrk(topic, "."))
        return false;
    word[0] = ' ';
    for (size_t i = 0; i < length; i++) {
        const char c = (char)tolower((unsigned char)topic[i]);
        word[i + 1] = c == ' ' || c == '-' || c == '_' ? '.' : c;
    }
    memcpy(word + length + 1, " ", 2);
    return true;
}

bool help_word(const char *topic)
{
    char word[64];
    if (!as_word(topic, word, sizeof word))
        return false;
    const size_t length = strlen(word);
    for (int plural = 0; plural < 2; plural++) {
        for (size_t i = 0; i < sizeof answers / sizeof *answers; i++)
            if (strstr(answers[i].words, word)) {
                printf("%s\n", answers[i].text);
                if (answers[i].page)
                    printf("More: docs/%s\n", answers[i].page);
                return true;
            }
        if (length < 5 || word[length - 2] != 's')
            return false;
        memcpy(word + length - 2, " ", 2); /* craters: crater */
    }
    return false;
}
