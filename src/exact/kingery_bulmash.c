/* The curves of Kingery and Bulmash as a solution with a centre; see kingery_bulmash.h. */
#include "exact/kingery_bulmash.h"

#include "exact/kingery_curves.h"
#include "exact/waves.h"

static const char *const charge_names[] = {"free-air", "surface", NULL};

const struct parameter exact_kingery_bulmash_table[] = {
    PARAMETER(NUMBER, struct exact_kingery_bulmash, mass, REQUIRED, "mass of TNT", .unit = "kg",
              .below = INFINITY),
    PARAMETER(CHOICE, struct exact_kingery_bulmash, charge, "free-air",
              "free-air: a sphere far from the ground; surface: a hemisphere on the ground",
              .names = charge_names),
    PARAMETER(FLAG, struct exact_kingery_bulmash, reflected, "no",
              "whether pressures are those on a rigid wall that faces the charge, in place of "
              "those of the passing wave"),
    PARAMETER(VECTOR, struct exact_kingery_bulmash, center, OPTIONAL,
              "position of the charge, for probes; default: the origin", .unit = "m"),
    PARAMETER(NUMBER, struct exact_kingery_bulmash, ambient, "101.325 kPa",
              "pressure of the air before the blast", .unit = "Pa", .below = INFINITY,
              .closed = true),
    PARAMETER(NUMBER, struct exact_kingery_bulmash, age, "0 s",
              "time since the detonation at the start of the case", .unit = "s", .below = INFINITY,
              .closed = true),
    PARAMETER(NUMBER, struct exact_kingery_bulmash, distance, OPTIONAL,
              "distance for which `bolide exact` prints the wave; default: 1 m for 1 kg",
              .unit = "m", .below = INFINITY),
    PARAMETER_END,
};

static struct error *kingery_solve(const void *parameters, void *solved)
{
    struct exact_kingery_bulmash *k = solved;
    *k = *(const struct exact_kingery_bulmash *)parameters;
    const double size = cbrt(k->mass), nearest = kingery_nearest((enum kingery_charge)k->charge),
                 farthest = kingery_farthest((enum kingery_charge)k->charge);
    if (isnan(k->distance))
        k->distance = size;
    if (!(k->distance >= nearest * size && k->distance <= farthest * size))
        return error_new(ERROR_INPUT,
                         "the curves go from %g to %g m/kg^(1/3), here from %.3g to %.3g m",
                         nearest, farthest, nearest * size, farthest * size);
    return NULL;
}

static struct blast_wave kingery_blast(const void *solved, double distance)
{
    const struct exact_kingery_bulmash *k = solved;
    struct blast_wave wave =
        kingery_wave((enum kingery_charge)k->charge, k->mass, distance, k->reflected);
    wave.arrival -= k->age;
    return wave;
}

static struct exact_state kingery_sample(const void *solved, enum exact_side side, double x,
                                         double time)
{
    (void)side;
    const struct exact_kingery_bulmash *k = solved;
    const struct blast_wave wave = kingery_blast(k, fabs(x));
    return (struct exact_state){NAN, NAN, k->ambient + blast_wave_at(&wave, time), NAN, NAN, NAN,
                                NAN, NAN};
}

/* By bisection: the arrival grows with the distance. */
static double kingery_front(const void *solved, double time)
{
    const struct exact_kingery_bulmash *k = solved;
    const enum kingery_charge charge = (enum kingery_charge)k->charge;
    const double size = cbrt(k->mass);
    double low = kingery_nearest(charge) * size * (1.0 + 1e-12),
           high = kingery_farthest(charge) * size * (1.0 - 1e-12);
    if (!(time >= kingery_blast(k, low).arrival && time <= kingery_blast(k, high).arrival))
        return NAN;
    for (int i = 0; i < 60; i++) {
        const double middle = 0.5 * (low + high);
        if (kingery_blast(k, middle).arrival <= time)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static const struct vector_value *kingery_center(const void *solved)
{
    return &((const struct exact_kingery_bulmash *)solved)->center;
}

static int kingery_numbers(const void *solved, double time, struct exact_number *numbers)
{
    const struct exact_kingery_bulmash *k = solved;
    const enum kingery_charge charge = (enum kingery_charge)k->charge;
    const double z = k->distance / cbrt(k->mass);
    const struct blast_wave passing = kingery_wave(charge, k->mass, k->distance, false),
                            wall = kingery_wave(charge, k->mass, k->distance, true);
    struct number_list list = {numbers, 0};
    number_add(&list, "distance", "m", k->distance);
    number_add(&list, "scaled distance", "m/kg^(1/3)", z);
    number_add(&list, "arrival", "s", passing.arrival);
    number_add(&list, "incident overpressure", "Pa", passing.overpressure);
    number_add(&list, "incident impulse", "Pa*s", passing.impulse);
    number_add(&list, "positive duration", "s", passing.duration);
    number_add(&list, "reflected overpressure", "Pa", wall.overpressure);
    number_add(&list, "reflected impulse", "Pa*s", wall.impulse);
    number_add(&list, "front speed", "m/s", 1e3 * kingery_curve(charge, KINGERY_SPEED, z));
    if (time + k->age > 0.0)
        number_add(&list, "front radius", "m", kingery_front(k, time));
    return list.count;
}

const struct exact_class exact_kingery_bulmash_class = {
    .size = sizeof(struct exact_kingery_bulmash),
    .solve = kingery_solve,
    .sample = kingery_sample,
    .numbers = kingery_numbers,
    .known = EXACT_PRESSURE,
    .center = kingery_center,
    .blast = kingery_blast,
    .front = kingery_front,
};
