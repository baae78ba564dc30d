/* Holes and craters lie about an axis normal to a plate. Of the plate count the fragments that have
 * at least half of the mass of the heaviest, so that a plate that a hole divides counts on both
 * sides and debris does not. */
#ifndef BOLIDE_BROKEN_AXIS_H
#define BOLIDE_BROKEN_AXIS_H

#include "measure/broken.h"

struct broken_axis {
    int along;
    int across[2], count; /* the other axes of the case */
    double center[2];     /* m, where it is on them */
    bool mirror[2];       /* a mirror wall goes through it, normal to them */
    bool round;           /* it is that of axisymmetry: across is the radius */
};

/* A particle beside mirror walls through the axis counts with its images: itself and up to
 * three. */
enum { BROKEN_IMAGES = 4 };

/* Image IMAGE of the place AT, relative to AXIS, in ACROSS; false where there is no such image. */
bool broken_image(const struct broken_axis *axis, const double at[3], int image, double across[2]);

/* The axis ALONG through CENTER (count 0: the origin) of the plate that the check is `of`, which it
 * must name and cross; in 1-D there is none. */
struct error *broken_find_axis(const struct measurement *measurement, int along,
                               const struct vector_value *center, struct broken_axis *axis);

/* Where the face of the check's body on the high (else low) side of axis ALONG was at the start. */
double broken_face(const struct measurement *measurement, int along, bool high);

/* What is left of a plate. */
struct broken_plate {
    int64_t fragments; /* of the body; 0: nothing is left */
    bool *is_part;     /* of each owned particle */
    double *diameter;
};

/* Collective: the plate that the check is `of`. Free it also after an error. */
struct error *broken_find_plate(const struct measurement *measurement, double link,
                                struct broken_plate *plate);
void broken_plate_free(struct broken_plate *plate);

#endif
