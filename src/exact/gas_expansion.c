/* The even expansion of a gas into a vacuum; see gas_expansion.h.
 *
 *   rho = rho_c (R_0/R)^nu (1 - r^2/R^2)^(1/(gamma - 1))
 *   p = p_c (R_0/R)^(nu gamma) (1 - r^2/R^2)^(gamma/(gamma - 1))
 *
 * obey continuity and p/rho^gamma = const for any R(t), and momentum when, with X = R/R_0, n = nu
 * (gamma - 1) and T = R_0/c sqrt((gamma - 1)/2), c the sound speed at the centre at the start,
 *
 *   T^2 X'' = X^(-n-1),   thus   T^2 X'^2 = (2/n) (1 - X^-n).
 *
 * X = cosh(q)^(2/n) turns the second into t = T sqrt(2/n) times the integral of cosh^(2/n) from 0
 * to q. */
#include "exact/gas_expansion.h"

#include "exact/radial.h"
#include "exact/root.h"
#include "exact/waves.h"

struct expansion {
    struct exact_gas_expansion gas;
    double nu, n, time; /* time: T sqrt(2/n) */
};

/* X and the rate of its growth at a time. */
struct stretch {
    double ratio, rate;
};

enum { PANELS_A_UNIT = 4 };

const struct parameter exact_gas_expansion_table[] = {
    PARAMETER(CHOICE, struct exact_gas_expansion, geometry, REQUIRED,
              "shape of the gas; positions are distances from its centre",
              .names = (const char *const[]){"slab", "cylinder", "ball", NULL}),
    PARAMETER(NUMBER, struct exact_gas_expansion, radius, REQUIRED,
              "radius at the start; of a slab, half its thickness", .unit = "m", .below = INFINITY),
    PARAMETER(NUMBER, struct exact_gas_expansion, density, REQUIRED,
              "density at the centre at the start", .unit = "kg/m^3", .below = INFINITY),
    PARAMETER(NUMBER, struct exact_gas_expansion, pressure, REQUIRED,
              "pressure at the centre at the start", .unit = "Pa", .below = INFINITY),
    PARAMETER(NUMBER, struct exact_gas_expansion, gamma, REQUIRED, "ratio of specific heats",
              .unit = "", .above = 1.0, .below = INFINITY),
    PARAMETER_END,
};

static struct error *expansion_solve(const void *parameters, void *solved)
{
    struct expansion *e = solved;
    e->gas = *(const struct exact_gas_expansion *)parameters;
    double sound = sqrt(e->gas.gamma * e->gas.pressure / e->gas.density);
    e->nu = radial_dimensions(e->gas.geometry);
    e->n = e->nu * (e->gas.gamma - 1.0);
    e->time = e->gas.radius / sound * sqrt((e->gas.gamma - 1.0) / e->n);
    return NULL;
}

static double ratio_at(const void *solved, double q)
{
    const struct expansion *e = solved;
    return pow(cosh(q), 2.0 / e->n);
}

struct moment {
    const struct expansion *expansion;
    double time;
};

/* The time at which q is reached, less the one that is sought. */
static struct root_value time_of(const void *context, double q)
{
    const struct moment *moment = context;
    const struct expansion *e = moment->expansion;
    int panels = 1 + (int)(PANELS_A_UNIT * q * (1.0 + 2.0 / e->n));
    double passed = e->time * radial_integral(ratio_at, e, 0.0, q, panels);
    return (struct root_value){passed - moment->time, e->time * ratio_at(e, q)};
}

static struct stretch stretch_at(const struct expansion *e, double time)
{
    if (!(time > 0.0))
        return (struct stretch){1.0, 0.0};
    /* q grows at no more than 1/time, X at no more than its last speed; from there Newton's method
     * comes down the convex curve. */
    struct moment moment = {e, time};
    double high = time / e->time, far = 1.0 + 2.0 / e->n * high;
    double guess = minimum(high, acosh(pow(far, 0.5 * e->n)));
    double q = root_find(time_of, &moment, 0.0, high, guess), ratio = ratio_at(e, q);
    /* dX/dt = (2/n) tanh(q) X dq/dt. */
    return (struct stretch){ratio, 2.0 / e->n * tanh(q) / e->time};
}

static struct exact_state expansion_sample(const void *solved, enum exact_side side, double x,
                                           double time)
{
    (void)side;
    const struct expansion *e = solved;
    double g = e->gas.gamma;
    struct stretch stretch = stretch_at(e, time);
    double inside = 1.0 - square(x / (e->gas.radius * stretch.ratio));
    struct exact_state state = {0};
    if (!(inside > 0.0))
        return state;
    state.density = e->gas.density * pow(stretch.ratio, -e->nu) * pow(inside, 1.0 / (g - 1.0));
    state.velocity = x * stretch.rate / stretch.ratio;
    state.pressure = e->gas.pressure * pow(stretch.ratio, -e->nu * g) * pow(inside, g / (g - 1.0));
    state.energy =
        e->gas.pressure / ((g - 1.0) * e->gas.density) * pow(stretch.ratio, -e->n) * inside;
    state.stress = -state.pressure;
    return state;
}

static int expansion_numbers(const void *solved, double time, struct exact_number *numbers)
{
    const struct expansion *e = solved;
    struct number_list list = {numbers, 0};
    struct exact_state centre = expansion_sample(e, SIDE_LEFT, 0.0, time);
    struct stretch stretch = stretch_at(e, time);
    double sound = sqrt(e->gas.gamma * e->gas.pressure / e->gas.density);
    number_add(&list, "last speed of the edge", "m/s",
               2.0 * sound / ((e->gas.gamma - 1.0) * sqrt(e->nu)));
    if (time > 0.0) {
        number_add(&list, "radius", "m", e->gas.radius * stretch.ratio);
        number_add(&list, "speed of the edge", "m/s", e->gas.radius * stretch.rate);
        number_add(&list, "density at the centre", "kg/m^3", centre.density);
        number_add(&list, "pressure at the centre", "Pa", centre.pressure);
    }
    return list.count;
}

const struct exact_class exact_gas_expansion_class = {
    .size = sizeof(struct expansion),
    .solve = expansion_solve,
    .sample = expansion_sample,
    .numbers = expansion_numbers,
};
