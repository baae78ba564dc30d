/* A case: what a user asks to be computed, as the case file says it, in SI units. The tables of
 * case.c declare every key of it. */
#ifndef BOLIDE_CASE_H
#define BOLIDE_CASE_H

#include "base/parameter.h"
#include "case/watched.h"
#include "document/document.h"
#include "material/burn/afterburn.h"
#include "material/composition.h"
#include "material/eos/common.h"

struct bounds;
/* material/material.h, which few of those who read a case need: it has every model */
struct material;

/* In m/s. */
#define SPEED_OF_LIGHT 299792458.0

/* materials: NAME: {library: aluminium-wilkins} or {eos: ..., strength: ...}; keys beside `library`
 * replace those of the library's file. */
struct material_input {
    char *library;
    char *description, *source;     /* for people; NULL: not given */
    struct one_of eos;              /* "eos" */
    struct one_of strength;         /* "strength"; not given: a fluid */
    struct one_of failure;          /* "failure"; not given: never */
    struct one_of burn;             /* "burn"; not given: instant */
    struct afterburn afterburn;     /* "afterburn" */
    struct composition composition; /* "composition" */
    struct heat heat;               /* "heat" */
    double tensile_strength;        /* Pa; NAN: not known */
    struct material *material;      /* filled by case_read from the above; owned */
};

/* bodies: NAME: {material, a shape, velocity, ...} */
struct body_input {
    char *material;
    struct one_of shape;   /* "shape", inline */
    struct one_of lattice; /* "lattice" */
    struct field_list velocity;
    struct field_value density, pressure, energy, temperature;
    struct field_list stress;  /* xx, yy, zz, xy, yz, zx, as many as the dimension has */
    double resolution;         /* NAN: the case's */
    int64_t weights;           /* points along an axis of a site that weigh it; 0: none do */
    struct name_list replaces; /* bodies whose particles give way inside this shape */
    bool driven;               /* keeps its velocity whatever pushes back */
    bool frozen;               /* keeps all of its state, and moves with its velocity */
    double stop;               /* s, from then on it stands still; NAN: never */
    double remove_at;          /* s, when it is taken away; NAN: never */
    double damping;            /* 1/s, of its velocity, from damped_from on; 0: none */
    double damped_from;        /* s */
    int material_index;        /* filled by case_read */
    bool varies;        /* filled by case_read: its state at the start is one of the position */
    struct point start; /* filled by case_read, unless it varies: the state at the start */
};

/* contacts: NAME: {between: [cube, plate], shear: slip, tension: none}: the law where two bodies
 * meet. Pairs that no contact names stick in shear and carry tension. */
enum contact_shear { SHEAR_STICK, SHEAR_SLIP };
enum contact_tension { TENSION_CARRIED, TENSION_NONE };
enum contact_touch { TOUCH_NODES, TOUCH_SURFACES };
enum contact_normal { NORMAL_MEAN, NORMAL_FIRST, NORMAL_SECOND };
struct contact_input {
    struct name_list between; /* two bodies */
    int shear, tension;
    double friction; /* where they slip */
    int normal;      /* whose surface it is taken from */
    int touch;       /* enum contact_touch; -1: as `tension` has it */
    int body[2];     /* filled by case_read */
};

/* domain: {low: [0 m, 0 m], high: [1 m, 1 m]}: the box that a solver on a grid computes. */
struct domain_input {
    struct vector_value low, high; /* count 0: the boundaries', else the bounds of all bodies */
};

/* fine: NAME: {box: ...}: where cells are of the finest level. */
struct fine_input {
    struct one_of shape; /* "shape" */
};

/* start: {from: FILE}: a blast that another case has computed in 1-D or axisymmetry takes the place
 * of what the bodies say within its reach. With particles: {from: FOLDER}: the bodies that the
 * checkpoint of another run has too continue from there. */
struct start_input {
    char *from;                    /* that case, or its folder; NULL: none */
    double at;                     /* s, how far it is computed; NAN: to its end */
    struct vector_value center;    /* of the blast; count 0: the origin */
    int axis;                      /* that of an axisymmetric case; -1: y */
    bool window;                   /* the domain need not hold all of the blast */
    char *material;                /* that of its denser material, which no body has; may be NULL */
    struct name_list without;      /* bodies of that run that are left out */
    int material_index;            /* filled by case_read; -1: none */
    struct simulation_case *input; /* filled by case_read; owned */
};

/* boundaries: NAME: {kind: reflecting, axis: x, side: low, at: 0 mm}: what is outside a face, of
 * which bodies are on the high side for `low` and on the low side for `high`; or a rigid body among
 * them. What a face is that nothing names is the solver's to say. Other spellings of such entries
 * are in spelling.c. */
enum face_side { SIDE_LOW, SIDE_HIGH };
enum boundary_kind {
    BOUNDARY_REFLECTING,   /* a rigid slip wall */
    BOUNDARY_SYMMETRY,     /* the same: a plane of symmetry */
    BOUNDARY_TRANSMITTING, /* waves leave through it */
    BOUNDARY_OUTFLOW,      /* particles leave through it */
    BOUNDARY_INFLOW,       /* the state outside is given */
    BOUNDARY_PERIODIC,     /* what leaves comes in at the opposite face */
    BOUNDARY_RIGID_BODY, /* no face: a body at rest that blocks the cells whose centres it holds */
    BOUNDARY_KINDS
};
struct boundary_input {
    int axis, side; /* side: enum face_side; -1: not given, both of a periodic axis */
    int kind;       /* enum boundary_kind */
    double at;      /* m, of the face; NAN: that of the domain */
    double place,
        opposite; /* filled by case_read: where the face is, and both of a periodic axis */
    /* "shape", which holds the part of the face, or is the rigid body; not given: all of it */
    struct one_of part;
    struct field_value density, energy; /* of what flows in, at a place and time */
    struct field_value pressure;        /* of that, or outside an outflow */
    struct field_list velocity;
};

/* {mass: 5 kg, at: [0 m, 1 m]}: a charge whose blast pushes. */
struct blast_input {
    double mass;            /* kg of TNT; NAN: not given */
    int charge;             /* enum kingery_charge */
    struct vector_value at; /* count 0: not given */
    double time;            /* s, of the detonation */
};

/* {from: gas.yaml, probe: wall}: the pressure that another case records on a line pushes. */
struct record_input {
    char *from, *probe;            /* NULL: not given */
    struct vector_value center;    /* count 0: the origin */
    double time, ambient;          /* s, Pa; NAN: the pressure of each point at the start */
    struct simulation_case *input; /* filled by case_read: that case; owned */
};

/* loads: NAME: {on: bar, pressure: 1 MPa}: what pushes on the surface of a body. */
struct load_input {
    char *on;
    struct blast_input blast;
    struct record_input record;
    struct field_value pressure; /* of the time */
    /* of the time, on the surface that faces `side` of `axis`; count 0: not given */
    struct field_list traction;
    int axis, side;              /* side: enum face_side; -1: both */
    struct vector_value between; /* positions along `axis`; count 0: everywhere */
    double after, before;        /* s; before NAN: to the end */
    int body;                    /* filled by case_read */
};

/* detonations: NAME: {at: [0 mm, 0 mm], of: charge}: where and when explosives are lit. */
struct detonation_input {
    struct vector_value at, to; /* to.count 0: a point */
    double time;
    char *of; /* a body; NULL: all that burn */
    int body; /* filled by case_read; -1: all */
};

struct run_input {
    double until;        /* s */
    int64_t max_steps;   /* 0: no limit */
    int64_t rebalance;   /* steps; 0: when needed */
    double energy_drift; /* relative, stops the run when exceeded; 0: never; NAN: a warning */
};

/* checks: NAME: {a measure, of: body, between: [a, b], axis: x, is: ..., within: ...} */
struct check_input {
    struct one_of measure;       /* "measure", inline: `mean: pressure`, `conserved: momentum` */
    char *of;                    /* a body; NULL: all */
    struct vector_value between; /* positions along `axis`; count 0: everywhere */
    int axis;
    struct vector_value about; /* positions are distances from this point; count 0: along `axis` */
    struct one_of against;     /* "exact"; not given: the case's own */
    struct quantity is;        /* wanted value; NAN: none */
    struct quantity within;    /* allowed distance from `is`: a fraction of it, or a quantity */
    struct quantity at_most, at_least;
    double at;                  /* s, when it is measured; NAN: at the end */
    char *minus;                /* the check whose value is subtracted; NULL: none */
    int minus_check;            /* filled by case_read: that check; -1: none */
    struct name_list mean_with; /* checks: the value is the mean with theirs */
    /* what the value is divided by: "start", its own then, or a check; NULL: nothing */
    char *relative;
    int relative_check;        /* filled by case_read: that check; -1: none */
    struct quantity scale;     /* divides error norms; NAN: the exact solution's own range */
    char *source;              /* where the wanted value comes from, shown in the table */
    char *known_deviation;     /* why the limit is not met; NULL: it must be */
    double known_deviation_if; /* above 0: `known_deviation` holds */
    /* How much worse than `recorded` it may be: a fraction of the error, or a quantity; NAN: no
     * bound. */
    struct quantity regression_bound;
    struct quantity recorded; /* filled by case_read from the record; NAN: none */
};

/* False where a check only measures. */
static inline bool check_has_limit(const struct check_input *check)
{
    return !isnan(check->within.value) || !isnan(check->at_most.value) ||
           !isnan(check->at_least.value) || !isnan(check->regression_bound.value);
}

/* fits: NAME: {of: CHECK, over: KEY, take: slope, is: ..., within: ...}: a line or a power law
 * through what the runs of a sweep measured. */
struct fit_input {
    char *of, *over;          /* a check; a swept key or a check */
    int form, take;           /* enum fit_form, fit_take */
    struct quantity from, to; /* of `over`: other runs do not count; NAN: no bound */
    struct check_input check; /* its limits, source and known deviation; the rest is not used */
};
enum fit_form { FIT_LINE, FIT_POWER };
enum fit_take { FIT_SLOPE, FIT_INTERCEPT, FIT_MISFIT, FIT_MEAN, FIT_DEVIATION, FIT_CONFIDENCE };

/* expected_warnings: NAME: {warning: tension, of: [copper], reason: ...}: what `bolide verify` lets
 * pass. */
struct expected_warning_input {
    int warning;         /* enum warning_kind of the run */
    struct name_list of; /* materials; count 0: all */
    char *reason;
};

/* convergence: order: CHECK: {at_least: 0.8}: what order of accuracy is wanted. */
struct order_input {
    double at_least, at_most; /* NAN: not given */
    char *source, *known_deviation;
};

/* convergence: {vary: n, values: [250, 500, 1000]}: a study of the case on several resolutions. */
struct convergence_input {
    char *vary;                /* a name of let or a path */
    struct name_list values;   /* count 0: the resolution times 4, 2 and 1 */
    struct name_list of;       /* checks; count 0: all that have an exact value */
    struct name_list estimate; /* checks without an exact value */
    struct named_map order;    /* struct order_input, by check */
};

/* calibrate: keys: A: {from: 300 MPa, to: 500 MPa}: what is fitted, a name of let or a path. */
enum { CALIBRATED_KEYS_MAX = 12 };
enum key_scale { KEY_LINEAR, KEY_LOG };
struct calibrated_key {
    struct quantity from, to, start; /* start NAN: the middle */
    int scale;                       /* enum key_scale */
};

/* calibrate: targets: NAME: {check: length, is: 0.75}: what it is fitted to: what a check measures,
 * or a column of a probe over the time. */
struct calibration_target {
    char *check, *probe;         /* one of them; NULL: not given */
    char *of;                    /* "case": the file name of one of `cases`; NULL: the case */
    struct quantity is;          /* NAN: that of the check */
    struct quantity deviation;   /* NAN: what the check allows */
    char *field, *data;          /* of a probe: its column, and the measured table */
    char *time, *value;          /* columns of that; NULL: the first and the second */
    struct vector_value between; /* s; count 0: all times */
    char *shift;                 /* a time, or "fit" */
    double shift_time;           /* s, filled by case_read; NAN: fitted */
};

struct calibrate_input {
    struct named_map keys;    /* struct calibrated_key; count 0: nothing is calibrated */
    struct named_map targets; /* struct calibration_target */
    struct name_list cases;   /* files beside this case with the same keys */
    int64_t runs;
    double within;
};

/* sweep: {U0: [500 m/s, 1 km/s]}: one value that a run of the sweep, or of a study, takes. */
struct sweep_value {
    int entry;        /* of the sweep, from 0; values of keys that change together share it */
    char *key, *text; /* as they stand in the case */
    struct quantity quantity; /* what the text comes to; value NAN: it is no quantity */
};

/* What a case of one or two dimensions stands for. */
enum case_geometry {
    GEOMETRY_PLANE_STRAIN,
    GEOMETRY_PLANE_STRESS,
    GEOMETRY_AXISYMMETRIC,
    GEOMETRY_CYLINDRICAL, /* of one dimension */
    GEOMETRY_SPHERICAL    /* of one dimension */
};

/* The power of x that a volume has, which is per radian or steradian: 0 unless x is a radius. */
static inline int geometry_power(int geometry)
{
    return geometry == GEOMETRY_SPHERICAL                                          ? 2
           : geometry == GEOMETRY_AXISYMMETRIC || geometry == GEOMETRY_CYLINDRICAL ? 1
                                                                                   : 0;
}

struct simulation_case {
    int64_t format;
    char *title;
    int64_t dimension;
    int geometry; /* enum case_geometry; plane strain stands for a plane wave in 1-D, too */
    double resolution;
    int64_t levels;             /* of cells, the finest of `resolution` */
    struct named_map fine;      /* struct fine_input */
    struct one_of solver;       /* "solver" */
    struct named_map materials; /* struct material_input */
    struct named_map bodies;    /* struct body_input */
    struct domain_input domain;
    struct start_input start;
    struct named_map boundaries;  /* struct boundary_input */
    struct named_map loads;       /* struct load_input */
    struct named_map contacts;    /* struct contact_input */
    struct named_map detonations; /* struct detonation_input */
    struct vector_value gravity;  /* m/s^2; count 0: none */
    struct run_input run;
    struct output_input output;
    struct named_map probes;   /* struct probe_input */
    struct named_map profiles; /* struct profile_input */
    struct one_of exact;       /* "exact": what checks measure against; not given: nothing */
    struct named_map checks;   /* struct check_input */
    struct named_map fits;     /* struct fit_input */
    char *repetitions;         /* a key of the sweep; NULL: none */
    struct named_map expected; /* "expected_warnings", struct expected_warning_input */
    struct convergence_input convergence;
    struct calibrate_input calibrate;
    int sweep_runs;   /* filled by case_read: runs that a sweep asks for; 0: it has none */
    int sweep_values; /* of this run of it; 0: the case itself */
    struct sweep_value *sweep;
    char *name; /* filled by case_read: the name of the case's folder or file */
    /* filled by case_read: "normal", or "short" or "long" where it has what was asked for */
    const char *form;
    const struct catalogue *catalogue;
    struct error *notes;       /* filled by case_read: what it was read as; NULL: as it is; owned */
    struct document *document; /* for located messages; owned */
};

/* Options of the command line that shape a case. */
struct case_options {
    const char *const *settings; /* --set */
    int setting_count;
    const char *form; /* "short" or "long": that form of it; NULL: neither */
    int sweep_run;    /* the run of the case's sweep, from 1; 0: the case itself */
    bool recording;   /* the record is being made: nothing is read from it */
    bool convergence; /* the runs of its convergence study take the place of those of its sweep */
    bool source;      /* another case is computed with it first: it must not ask for more */
    const char *const *library_paths; /* folders with material files */
    int library_count;
};

/* The table of a whole case file, for help and reference. */
extern const struct parameter case_table[];

/* Keys that shape a case before that table reads it: include, let, short, long, sweep. For help. */
extern const struct parameter case_shaping_table[];

/* Reads and checks PATH. Materials are resolved, start states found, references between names
 * checked; every mistake comes in one ERROR_INPUT. */
struct error *case_read(const char *path, const struct case_options *options,
                        const struct catalogue *catalogue, struct simulation_case **result);

/* The path that KEY, a name of let or a path, is about, in fresh memory. ERROR_INPUT at the entry
 * KEY of the map TOLD where it is neither. */
struct error *case_find_key(const struct simulation_case *input, const char *told, const char *key,
                            char **path);

/* "U0=500_m_s": the folder of the run of a sweep that takes these COUNT values, and its name in the
 * record; of keys that change together the first alone, where the name would be long. NULL when
 * memory is out; free it. */
char *sweep_run_name(const struct sweep_value *values, int count);

void case_free(struct simulation_case *input);
void sweep_values_free(struct sweep_value *values, int count);

/* Writes the case as run: YAML with every default filled in, that case_read takes again. */
struct error *case_write(const struct simulation_case *input, FILE *file);

/* `reflecting`: the kind of a boundary. */
const char *boundary_kind_name(int kind);

/* Whether a boundary of KIND closes the part of its face that it names. */
static inline bool boundary_kind_closes(int kind)
{
    return kind == BOUNDARY_REFLECTING || kind == BOUNDARY_SYMMETRY;
}

/* A face and where it stands in the case, for messages. */
struct face_place {
    double at; /* m */
    const char *section, *name;
};

/* The low or high face across AXIS: of `domain`, else of a boundary, else of the bodies. */
struct face_place domain_face(const struct simulation_case *input, int axis, int side);

/* All faces; infinite in dimensions that the case has not. */
struct bounds domain_bounds(const struct simulation_case *input);

/* The rigid body at PLACE, an index of boundaries; -1: none is there. */
int rigid_body_at(const struct simulation_case *input, struct vec3 place);
bool has_rigid_body(const struct simulation_case *input);

/* The state and the velocity of what flows in through BOUNDARY at PLACE and TIME: NULL, or what is
 * wrong, and *key the key that it is about. */
const char *boundary_state_at(const struct boundary_input *boundary,
                              const struct material *material, struct vec3 place, double time,
                              struct point *point, double velocity[3], const char **key);

/* State and velocity, as many components as the case has, at PLACE of a BODY that has been
 * checked: NULL, or what is wrong, and *key the key of the body that it is about. */
const char *body_start_at(const struct body_input *body, const struct material *material,
                          struct vec3 place, struct point *point, double velocity[3],
                          const char **key);

/* The index of the body called NAME; -1 when there is none, or NAME is NULL. */
int case_find_body(const struct simulation_case *input, const char *name);

/* Body BY names body OF in `replaces`; all such pairs of a case, sorted. Free `at`. */
struct replacement {
    int by, of;
};
struct replacements {
    int count;
    struct replacement *at;
};
struct error *case_replacements(const struct simulation_case *input, struct replacements *result);
bool replaces(const struct replacements *replacements, int by, int of);

bool detonation_lights(const struct simulation_case *input, int index, int body);

/* When the first of the detonations that light BODY arrives at PLACE, s; zero where nothing
 * does. */
double detonation_arrival(const struct simulation_case *input, int body, struct vec3 place);

/* The items of a case's maps. */
#define CASE_ITEM(name, map)                                                                   \
    static inline struct name##_input *case_##name(const struct simulation_case *c, int index) \
    {                                                                                          \
        return (struct name##_input *)c->map.items + index;                                    \
    }
CASE_ITEM(material, materials)
CASE_ITEM(body, bodies)
CASE_ITEM(boundary, boundaries)
CASE_ITEM(fine, fine)
CASE_ITEM(load, loads)
CASE_ITEM(contact, contacts)
CASE_ITEM(detonation, detonations)
CASE_ITEM(probe, probes)
CASE_ITEM(profile, profiles)
CASE_ITEM(map, output.maps)
CASE_ITEM(histogram, output.histograms)
CASE_ITEM(order, convergence.order)
CASE_ITEM(fit, fits)
CASE_ITEM(expected_warning, expected)
CASE_ITEM(check, checks)
#undef CASE_ITEM

static inline struct calibrated_key *case_calibrated(const struct simulation_case *c, int index)
{
    return (struct calibrated_key *)c->calibrate.keys.items + index;
}
static inline struct calibration_target *case_target(const struct simulation_case *c, int index)
{
    return (struct calibration_target *)c->calibrate.targets.items + index;
}

/* The material of a body. */
static inline const struct material *body_material(const struct simulation_case *c, int body)
{
    return case_material(c, case_body(c, body)->material_index)->material;
}

#endif
