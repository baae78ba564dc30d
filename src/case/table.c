/* Every key of a case file: what it is, its default, its range and a line of help. */
#include "case/internal.h"

static const char *const geometry_names[] = {"plane-strain", "plane-stress", "axisymmetric",
                                             "cylindrical",  "spherical",    NULL};

static const struct parameter body_table[] = {
    PARAMETER(TEXT, struct body_input, material, REQUIRED, "name of its material in `materials`"),
    {.kind = PARAMETER_ONE_OF,
     .offset = offsetof(struct body_input, shape),
     .standard = REQUIRED,
     .kind_of_thing = "shape",
     .help = "shape of the body"},
    PARAMETER(ONE_OF, struct body_input, lattice, "square", "initial arrangement of its particles",
              .kind_of_thing = "lattice"),
    PARAMETER(FIELDS, struct body_input, velocity, OPTIONAL,
              "velocity at the start, one value per dimension, a function of position or, for a "
              "driven body, of time; default: at rest",
              .arguments = ARGUMENT_POSITION | ARGUMENT_TIME, .unit = "m/s"),
    PARAMETER(FIELD, struct body_input, density, OPTIONAL,
              "density at the start; give at most two of density, pressure and energy",
              .arguments = ARGUMENT_POSITION, .unit = "kg/m^3", .below = INFINITY),
    PARAMETER(FIELD, struct body_input, pressure, OPTIONAL, "pressure at the start",
              .arguments = ARGUMENT_POSITION, .unit = "Pa"),
    PARAMETER(FIELD, struct body_input, energy, OPTIONAL, "specific internal energy at the start",
              .arguments = ARGUMENT_POSITION, .unit = "J/kg"),
    PARAMETER(FIELD, struct body_input, temperature, OPTIONAL,
              "temperature at the start, instead of the energy", .arguments = ARGUMENT_POSITION,
              .unit = "K", .below = INFINITY),
    PARAMETER(FIELDS, struct body_input, stress, OPTIONAL,
              "stress of a solid at the start, instead of the pressure: [xx, yy, zz] in 1-D, [xx, "
              "yy, zz, xy] in 2-D, [xx, yy, zz, xy, yz, zx] in 3-D",
              .arguments = ARGUMENT_POSITION, .unit = "Pa"),
    PARAMETER(NUMBER, struct body_input, resolution, OPTIONAL,
              "particle spacing of this body; default: that of the case", .unit = "m",
              .below = INFINITY),
    PARAMETER(
        INTEGER, struct body_input, weights, "0",
        "weighs a particle by the part of its site that is in the body: so many points along "
        "each axis of a site are looked at, and the particle stands at the mean of those that "
        "are in it; for walls thinner than a few particles. 0: a site counts whole where its "
        "centre is in the body (solvers mpm, cfdmp, afdmp)",
        .above = 0, .below = 32, .closed = true),
    PARAMETER(NAMES, struct body_input, replaces, OPTIONAL,
              "bodies that are cut away where this one is"),
    PARAMETER(FLAG, struct body_input, driven, "no",
              "whether it keeps its velocity whatever pushes back, like a piston"),
    PARAMETER(FLAG, struct body_input, frozen, "no",
              "whether it keeps its initial state and moves with its velocity: a transmitting "
              "(non-reflecting) boundary"),
    PARAMETER(NUMBER, struct body_input, stop, OPTIONAL,
              "time at which the body stops for good; default: never", .unit = "s",
              .below = INFINITY, .closed = true),
    PARAMETER(NUMBER, struct body_input, remove_at, OPTIONAL,
              "time at which the body is taken away, with its mass, momentum and energy, which the "
              "ledger books; default: never (solvers sph, mpm)",
              .unit = "s", .below = INFINITY, .closed = true, .change = CHANGE_FROM_HERE),
    PARAMETER(
        NUMBER, struct body_input, damping, "0 1/s",
        "rate at which the body loses its velocity, v' = -damping v, so that it stops ringing "
        "and shows its permanent shape; the ledger books what it loses (solvers sph, mpm)",
        .unit = "1/s", .below = INFINITY, .closed = true, .change = CHANGE_FROM_HERE),
    PARAMETER(NUMBER, struct body_input, damped_from, "0 s", "the time at which `damping` begins",
              .unit = "s", .below = INFINITY, .closed = true, .change = CHANGE_FROM_HERE),
    PARAMETER_END,
};

static const struct parameter fine_table[] = {
    {.kind = PARAMETER_ONE_OF,
     .offset = offsetof(struct fine_input, shape),
     .standard = REQUIRED,
     .kind_of_thing = "shape",
     .help = "a shape: blocks of cells that meet the box around it are of the finest level"},
    PARAMETER_END,
};

static const struct parameter run_table[] = {
    PARAMETER(NUMBER, struct run_input, until, REQUIRED, "the time at which the run ends",
              .unit = "s", .below = INFINITY),
    PARAMETER(INTEGER, struct run_input, max_steps, "0",
              "the number of steps after which the run ends; 0: no limit", .below = INFINITY,
              .closed = true),
    PARAMETER(INTEGER, struct run_input, rebalance, "0",
              "with several ranks, number of steps between rebalancing; 0: when one rank has "
              "worked longer than the others",
              .below = INFINITY, .closed = true),
    PARAMETER(NUMBER, struct run_input, energy_drift, OPTIONAL,
              "relative drift of the total energy that ends the run with an error, 0: none; "
              "default: none, but a drift of 5 % is a warning",
              .below = INFINITY, .closed = true),
    PARAMETER_END,
};

static const struct parameter output_table[] = {
    PARAMETER(NUMBER, struct output_input, every, OPTIONAL,
              "time between snapshots; default: only the first and the last state", .unit = "s",
              .below = INFINITY),
    PARAMETER(NUMBER, struct output_input, history, OPTIONAL,
              "time between rows of history.csv; default: a hundredth of the run", .unit = "s",
              .below = INFINITY),
    PARAMETER(NUMBER, struct output_input, checkpoint, "10 min",
              "wall-clock time between checkpoints, of which the first is written after a minute "
              "at most; 0: only at the end",
              .unit = "s", .below = INFINITY, .closed = true),
    PARAMETER(MAP, struct output_input, pictures, OPTIONAL,
              "pictures of every snapshot: a list of fields, or pictures by name. Default: the "
              "bodies, in 2-D and 3-D",
              .table = case_picture_table, .size = sizeof(struct picture_input), .listed = true),
    PARAMETER(MAP, struct output_input, maps, OPTIONAL,
              "what is kept of fields over the time, each as a field of its own for pictures, "
              "probes and snapshots: peaks, arrivals, impulses",
              .table = case_map_table, .size = sizeof(struct map_input), .change = CHANGE_NEVER),
    PARAMETER(MAP, struct output_input, histograms, OPTIONAL,
              "how the values of fields are distributed, at every snapshot, by name",
              .table = case_histogram_table, .size = sizeof(struct histogram_input)),
    PARAMETER(FLAG, struct output_input, snapshots, "yes",
              "whether snapshots are written as VTKHDF files"),
    PARAMETER(FLAG, struct output_input, faces, "no",
              "whether faces.csv lists what the maps have on the faces of rigid bodies by the last "
              "snapshot, a row for each face of a cell"),
    PARAMETER(FLAG, struct output_input, fragments, "no",
              "whether fragments.csv lists the fragments into which bodies have broken by the last "
              "snapshot, and snapshots and pictures have their numbers as the field `fragment`"),
    PARAMETER(NUMBER, struct output_input, fragment_link, "0.8",
              "distance up to which two particles of a fragment are connected, over the sum of "
              "their diameters",
              .below = INFINITY),
    PARAMETER_END,
};

static const struct parameter check_table[] = {
    {.kind = PARAMETER_ONE_OF,
     .offset = offsetof(struct check_input, measure),
     .standard = REQUIRED,
     .kind_of_thing = "measure",
     .help = "what is measured"},
    PARAMETER(NUMBER, struct check_input, at, OPTIONAL,
              "time of the measurement, at the first step at or after it; default: the last step",
              .unit = "s", .below = INFINITY, .closed = true),
    PARAMETER(TEXT, struct check_input, of, OPTIONAL, "the measured body; default: all"),
    PARAMETER(VECTOR, struct check_input, between, OPTIONAL,
              "two positions on the axis that bound what is measured", .unit = "m"),
    PARAMETER(CHOICE, struct check_input, axis, "x", "the axis of `between` and of fronts",
              .names = parameter_axes),
    PARAMETER(VECTOR, struct check_input, about, OPTIONAL,
              "a point: positions are distances from it instead of positions on `axis`",
              .unit = "m"),
    PARAMETER(ONE_OF, struct check_input, against, OPTIONAL,
              "the exact solution to compare with; default: that of the case",
              .kind_of_thing = "exact"),
    PARAMETER(TEXT, struct check_input, minus, OPTIONAL,
              "another check, whose value is subtracted"),
    PARAMETER(NAMES, struct check_input, mean_with, OPTIONAL,
              "other checks: the value is the mean of this one's and theirs"),
    PARAMETER(TEXT, struct check_input, relative, OPTIONAL,
              "what the value is divided by: `start`, its value at time zero, or the value of "
              "another check"),
    CASE_LIMITS(struct check_input, ),
    PARAMETER(QUANTITY, struct check_input, scale, OPTIONAL,
              "what error norms are divided by; default: the range of the exact solution"),
    PARAMETER_END,
};

const struct parameter case_table[] = {
    PARAMETER(INTEGER, struct simulation_case, format, REQUIRED, "version of the case format: 1",
              .above = CASE_FORMAT, .below = CASE_FORMAT, .closed = true),
    PARAMETER(TEXT, struct simulation_case, title, OPTIONAL, "one line about the case",
              .change = CHANGE_FREELY),
    PARAMETER(INTEGER, struct simulation_case, dimension, REQUIRED,
              "number of dimensions: 1, 2 or 3", .above = 1, .below = 3, .closed = true),
    PARAMETER(
        CHOICE, struct simulation_case, geometry, "plane-strain",
        "of a 2-D case: plane-strain; plane-stress: a thin plate; axisymmetric about x = 0, where "
        "x is the radius. Of a 1-D case in which x is the radius: cylindrical or spherical",
        .names = geometry_names),
    PARAMETER(NUMBER, struct simulation_case, resolution, REQUIRED, "particle spacing at the start",
              .unit = "m", .below = INFINITY),
    PARAMETER(INTEGER, struct simulation_case, levels, "1",
              "number of levels of cells (gas, also in cfdmp and afdmp): those of the finest are "
              "as wide as `resolution`, beside material points as their cells, those of each next "
              "one twice as wide; where `fine` asks for nothing else, cells are as coarse as can "
              "be",
              .above = 1, .below = 8, .closed = true),
    PARAMETER(MAP, struct simulation_case, fine, OPTIONAL,
              "with several `levels`, where cells are of the finest, by name", .table = fine_table,
              .size = sizeof(struct fine_input)),
    PARAMETER(ONE_OF, struct simulation_case, solver, REQUIRED, "the solver",
              .kind_of_thing = "solver"),
    PARAMETER(MAP, struct simulation_case, materials, REQUIRED, "materials by name",
              .table = case_material_table, .size = sizeof(struct material_input)),
    PARAMETER(MAP, struct simulation_case, bodies, REQUIRED, "bodies by name", .table = body_table,
              .size = sizeof(struct body_input)),
    PARAMETER(TABLE, struct simulation_case, domain, OPTIONAL,
              "the box that is computed (gas, cfdmp, afdmp)", .table = case_domain_table),
    PARAMETER(TABLE, struct simulation_case, start, OPTIONAL,
              "what this case begins with: a blast that another case computes in 1-D (gas, cfdmp, "
              "afdmp), "
              "or the bodies of another run in their state at its end (mpm, sph)",
              .table = case_start_table),
    PARAMETER(MAP, struct simulation_case, boundaries, OPTIONAL,
              "what is outside the faces of the domain, by name: walls, symmetry, periodic faces, "
              "inflow and outflow; and rigid bodies",
              .table = case_boundary_table, .size = sizeof(struct boundary_input),
              .change = CHANGE_FROM_HERE),
    PARAMETER(MAP, struct simulation_case, loads, OPTIONAL,
              "loads on the surfaces of bodies, by name (solvers mpm, sph)",
              .table = case_load_table, .size = sizeof(struct load_input),
              .change_within = CHANGE_FROM_HERE),
    PARAMETER(MAP, struct simulation_case, contacts, OPTIONAL,
              "contact laws, by name; bodies that no law names are bonded, also in tension",
              .table = case_contact_table, .size = sizeof(struct contact_input),
              .change = CHANGE_FROM_HERE),
    PARAMETER(MAP, struct simulation_case, detonations, OPTIONAL,
              "ignition points of explosives, by name", .table = case_detonation_table,
              .size = sizeof(struct detonation_input)),
    PARAMETER(VECTOR, struct simulation_case, gravity, OPTIONAL,
              "acceleration of everything without prescribed motion, one value per dimension; "
              "default: none",
              .unit = "m/s^2", .above = -1e15, .below = 1e15, .change = CHANGE_FROM_HERE),
    PARAMETER(TABLE, struct simulation_case, run, REQUIRED, "when the run ends", .table = run_table,
              .change = CHANGE_FREELY),
    PARAMETER(TABLE, struct simulation_case, output, OPTIONAL, "what is written",
              .table = output_table, .change = CHANGE_FREELY),
    PARAMETER(MAP, struct simulation_case, probes, OPTIONAL,
              "quantities recorded while the case runs, by name", .table = case_probe_table,
              .size = sizeof(struct probe_input), .change = CHANGE_FREELY,
              .change_within = CHANGE_NEVER),
    PARAMETER(MAP, struct simulation_case, profiles, OPTIONAL,
              "fields along an axis, averaged over bins, at every snapshot, by name",
              .table = case_profile_table, .size = sizeof(struct profile_input),
              .change = CHANGE_FREELY),
    PARAMETER(ONE_OF, struct simulation_case, exact, OPTIONAL,
              "the exact solution of the case, for its checks", .kind_of_thing = "exact",
              .change = CHANGE_FREELY),
    PARAMETER(MAP, struct simulation_case, checks, OPTIONAL,
              "values that are measured and compared with limits, by name; without a limit, "
              "measured only",
              .table = check_table, .size = sizeof(struct check_input), .change = CHANGE_FREELY),
    PARAMETER(
        MAP, struct simulation_case, fits, OPTIONAL,
        "lines and power laws through the measured values of a sweep, and their means, by name",
        .table = case_fit_table, .size = sizeof(struct fit_input), .change = CHANGE_FREELY),
    PARAMETER(TEXT, struct simulation_case, repetitions, OPTIONAL,
              "a key of the sweep, such as a seed: runs that differ in it alone are repetitions, "
              "of which the sweep shows means with their confidence",
              .change = CHANGE_FREELY),
    PARAMETER_AS("expected_warnings", MAP, struct simulation_case, expected, OPTIONAL,
                 "warnings of the run that are known and explained, by name; `bolide verify` fails "
                 "on any other",
                 .table = case_expected_table, .size = sizeof(struct expected_warning_input),
                 .change = CHANGE_FREELY),
    PARAMETER(TABLE, struct simulation_case, convergence, OPTIONAL,
              "the study that `bolide verify --convergence` makes of the case",
              .table = case_convergence_table, .change = CHANGE_FREELY),
    PARAMETER(TABLE, struct simulation_case, calibrate, OPTIONAL,
              "the keys that `bolide calibrate` fits, and what to", .table = case_calibrate_table,
              .change = CHANGE_FREELY),
    PARAMETER_END,
};
