/* What a case says of what is watched and written while it runs: probes, profiles, histograms,
 * pictures, maps over the time, files. A part of case.h. */
#ifndef BOLIDE_WATCHED_H
#define BOLIDE_WATCHED_H

#include "base/parameter.h"

/* probes: NAME: {a probe, of: body, fields: [...], every: ...}: what is recorded while the case
 * runs. */
struct probe_input {
    struct one_of probe;         /* "probe", inline: `tracer: [1 mm, 0 mm]`, `body: plate` */
    char *of;                    /* a body; NULL: all */
    struct name_list fields;     /* count 0: all */
    int axis;                    /* 0, 1, 2; -1: not given */
    struct vector_value between; /* positions along `axis`; count 0: everywhere */
    double every;                /* s; NAN: every step */
};

/* profiles: NAME: {fields: [...], along: x, bins: 100}: means over bins at every snapshot. */
enum profile_by { PROFILE_BY_NOTHING, PROFILE_BY_MATERIAL, PROFILE_BY_BODY };
enum { PROFILE_BINS = 100000 };
struct profile_input {
    struct name_list fields;
    int along;                   /* an axis */
    int64_t bins;                /* where no width is given */
    double width;                /* m, of a bin; NAN: not given */
    char *of;                    /* a body; NULL: all */
    struct vector_value between; /* positions along the axis; count 0: everywhere */
    int by;                      /* enum profile_by */
};

/* output.pictures: [pressure, ...], or NAME: {field: pressure, ...} */
enum picture_view { VIEW_SECTION, VIEW_PERSPECTIVE };
enum picture_palette { PALETTE_SEQUENTIAL, PALETTE_DIVERGING, PALETTE_CATEGORIES, PALETTE_GREY };
struct picture_plane {
    double at[3]; /* m, along each axis; NAN: not given */
};
struct picture_window {
    struct vector_value from, to; /* count 0: not given */
};
struct picture_range {
    struct quantity low, high; /* NAN: not given */
    struct vector_value percentiles;
};
struct picture_schlieren {
    char *field;
    double strength;
};
struct picture_input {
    struct name_list field;        /* count 0: the name of the picture */
    int view, up, palette;         /* -1: not given; up: x, y, z, -x, -y, -z */
    struct vector_value direction; /* azimuth, elevation, degrees */
    bool parallel, log, mirror, outlines;
    struct picture_plane plane;
    double slab, dot;
    struct name_list cut, bodies, without;
    struct picture_window window;
    struct picture_range range;
    struct picture_schlieren schlieren;
};

/* output.maps: NAME: {peak: pressure}, or {arrival: {field: pressure, above: 1 MPa}}, or impulse:
 * what is kept of a field over the time. */
enum { MAPS_MOST = 6, MAP_NAME = 40 };
struct map_over {
    char *field; /* NULL: not given */
    struct quantity above;
};
struct map_input {
    char *peak; /* NULL: not given */
    struct map_over arrival, impulse;
};

/* How much each particle or cell counts. */
enum weighing { WEIGHT_NUMBER, WEIGHT_MASS, WEIGHT_VOLUME };
extern const char *const weight_names[];

/* output.histograms: NAME: {field: speed, of: [cube], bins: 50, weight: mass}: how the values of a
 * field are distributed, at every snapshot. */
struct histogram_range {
    struct quantity low, high; /* NAN: the least, the largest value there is */
};
struct histogram_input {
    char *field;
    struct name_list of; /* bodies; count 0: all */
    int64_t bins;
    struct histogram_range range;
    bool log;   /* bins of equal ratio */
    int weight; /* enum weighing */
};

/* output: {every, pictures: [pressure, ...], ...} */
struct output_input {
    double every;                /* s, between snapshots; NAN: only the first and the last state */
    double history;              /* s, between rows of history.csv; NAN: a hundredth of the run */
    double checkpoint;           /* s of wall clock between checkpoints; 0: at the end only */
    struct named_map pictures;   /* struct picture_input; drawn at every snapshot */
    struct named_map maps;       /* struct map_input */
    struct named_map histograms; /* struct histogram_input */
    bool snapshots;              /* write VTKHDF files */
    bool faces;                  /* write faces.csv */
    bool fragments;              /* write fragments.csv and the field `fragment` */
    double fragment_link; /* up to which their particles are connected (measure/connected.h) */
};

#endif
