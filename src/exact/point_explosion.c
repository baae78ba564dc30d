/* The explosion with counter-pressure; see point_explosion.h. Rows are joined by cubics through
 * values and slopes. Nearer than the first row the blast is Sedov's: overpressure as r^-nu, time as
 * r^((nu + 2)/2). */
#include "exact/point_explosion.h"

#include "exact/point_explosion_rows.h"
#include "exact/radial.h"
#include "exact/waves.h"

struct explosion {
    const struct front_row *row;
    int rows;
    double nu, size, density, pressure, sound, age; /* size: d */
    struct vector_value center;
};

static const double gamma_air = 1.4;

static const char *const geometry_names[] = {"plane", "line", "point", NULL};

const struct parameter exact_point_explosion_table[] = {
    PARAMETER_AS("source", CHOICE, struct exact_point_explosion, geometry, REQUIRED,
                 "where the energy is released; positions are distances from it",
                 .names = geometry_names),
    PARAMETER(QUANTITY, struct exact_point_explosion, energy, REQUIRED,
              "released energy: J at a point, J/m along a line, J/m^2 on a plane (to both sides)"),
    PARAMETER(NUMBER, struct exact_point_explosion, density, REQUIRED,
              "density of the undisturbed gas, whose gamma is 1.4", .unit = "kg/m^3",
              .below = INFINITY),
    PARAMETER(NUMBER, struct exact_point_explosion, pressure, REQUIRED,
              "pressure of the undisturbed gas", .unit = "Pa", .below = INFINITY),
    PARAMETER(VECTOR, struct exact_point_explosion, center, OPTIONAL,
              "position of the source, for probes; default: the origin", .unit = "m"),
    PARAMETER(NUMBER, struct exact_point_explosion, age, "0 s",
              "time since the release of the energy at the start of the case", .unit = "s",
              .below = INFINITY, .closed = true),
    PARAMETER_END,
};

static struct error *explosion_solve(const void *parameters, void *solved)
{
    static const char *const units[RADIAL_GEOMETRIES] = {"J/m^2", "J/m", "J"};
    static const struct {
        const struct front_row *row;
        int rows;
    } fronts[RADIAL_GEOMETRIES] = {{plane_rows, COUNT_OF(plane_rows)},
                                   {line_rows, COUNT_OF(line_rows)},
                                   {point_rows, COUNT_OF(point_rows)}};
    const struct exact_point_explosion *input = parameters;
    struct explosion *e = solved;
    struct unit unit;
    TRY(unit_parse(units[input->geometry], &unit));
    if (!dimension_equal(unit.dimension, input->energy.dimension) || !(input->energy.value > 0.0))
        return error_new(ERROR_INPUT, "the energy of a %s must be in %s, above zero",
                         geometry_names[input->geometry], units[input->geometry]);
    const double nu = radial_dimensions(input->geometry);
    const double energy = input->energy.value * (input->geometry == RADIAL_SLAB ? 0.5 : 1.0);
    *e = (struct explosion){fronts[input->geometry].row,
                            fronts[input->geometry].rows,
                            nu,
                            pow(energy / input->pressure, 1.0 / nu),
                            input->density,
                            input->pressure,
                            sqrt(gamma_air * input->pressure / input->density),
                            input->age,
                            input->center};
    return NULL;
}

/* The front at a scaled distance: p_s/p_0 - 1 and c_0 t/d. */
struct front {
    double strength, time;
};

static double cubic(double part, double width, const double value[2], const double slope[2])
{
    const double rest = 1.0 - part;
    return value[0] * rest * rest * (1.0 + 2.0 * part) +
           value[1] * part * part * (3.0 - 2.0 * part) +
           width * part * rest * (slope[0] * rest - slope[1] * part);
}

static struct front front_at(const struct explosion *e, double x)
{
    const struct front_row *row = e->row, *last = row + e->rows - 1;
    if (x <= row->x)
        return (struct front){exp(row->y - e->nu * (x - row->x)),
                              (exp(row->x) - exp(row->z)) *
                                  exp(0.5 * (e->nu + 2.0) * (x - row->x))};
    if (!(x < last->x))
        return (struct front){NAN, NAN};
    while (row[1].x <= x)
        row++;
    const double width = row[1].x - row->x, part = (x - row->x) / width;
    double late[2], late_slope[2]; /* ln(c_0 t/r), a straight line while the blast is strong */
    for (int k = 0; k < 2; k++) {
        const double ahead = exp(row[k].z - row[k].x);
        late[k] = log1p(-ahead);
        late_slope[k] = ahead * (1.0 - row[k].z_slope) / (1.0 - ahead);
    }
    const double y = cubic(part, width, (double[]){row->y, row[1].y},
                           (double[]){row->y_slope, row[1].y_slope}),
                 w = cubic(part, width, late, late_slope);
    return (struct front){exp(y), exp(x + w)};
}

static struct blast_wave explosion_blast(const void *solved, double distance)
{
    const struct explosion *e = solved;
    const struct front front = front_at(e, log(distance / e->size));
    return (struct blast_wave){front.time * e->size / e->sound - e->age,
                               front.strength * e->pressure, NAN, NAN};
}

/* By bisection of the logarithm of the distance: the front moves outwards. */
static double explosion_front(const void *solved, double time)
{
    const struct explosion *e = solved;
    const double wanted = (time + e->age) * e->sound / e->size;
    double low = e->row->x - 30.0, high = e->row[e->rows - 1].x - 1e-9;
    if (!(wanted > 0.0) || !(front_at(e, high).time >= wanted))
        return wanted > 0.0 ? NAN : 0.0;
    for (int i = 0; i < 80; i++) {
        const double middle = 0.5 * (low + high);
        if (front_at(e, middle).time <= wanted)
            low = middle;
        else
            high = middle;
    }
    return e->size * exp(low);
}

static struct exact_state explosion_sample(const void *solved, enum exact_side side, double x,
                                           double time)
{
    (void)side;
    const struct explosion *e = solved;
    if (fabs(x) <= explosion_front(e, time))
        return (struct exact_state){NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
    return (struct exact_state){.density = e->density,
                                .pressure = e->pressure,
                                .energy = e->pressure / ((gamma_air - 1.0) * e->density),
                                .stress = -e->pressure};
}

static const struct vector_value *explosion_center(const void *solved)
{
    return &((const struct explosion *)solved)->center;
}

static int explosion_numbers(const void *solved, double time, struct exact_number *numbers)
{
    const struct explosion *e = solved;
    struct number_list list = {numbers, 0};
    number_add(&list, "scale of length", "m", e->size);
    number_add(&list, "scale of time", "s", e->size / e->sound);
    if (time + e->age > 0.0) {
        const double radius = explosion_front(e, time),
                     over = explosion_blast(e, radius).overpressure / e->pressure;
        const double mach = sqrt(1.0 + (gamma_air + 1.0) / (2.0 * gamma_air) * over);
        number_add(&list, "shock radius", "m", radius);
        number_add(&list, "shock speed", "m/s", mach * e->sound);
        number_add(&list, "overpressure behind the shock", "Pa", over * e->pressure);
        number_add(&list, "velocity behind the shock", "m/s", e->sound * over / (gamma_air * mach));
        number_add(&list, "density behind the shock", "kg/m^3",
                   e->density * (1.0 + (gamma_air + 1.0) / (2.0 * gamma_air) * over) /
                       (1.0 + (gamma_air - 1.0) / (2.0 * gamma_air) * over));
    }
    return list.count;
}

const struct exact_class exact_point_explosion_class = {
    .size = sizeof(struct explosion),
    .solve = explosion_solve,
    .sample = explosion_sample,
    .numbers = explosion_numbers,
    .known = EXACT_NO_FIELD,
    .center = explosion_center,
    .blast = explosion_blast,
    .front = explosion_front,
};
