/* The strong blast; see sedov.h.
 *
 * With xi = r/r_s, v = (2/(nu+2)) (r/t) V, density rho_0 G and c^2 = (2 r/((nu+2) t))^2 Z the
 * energy within any xi is constant in time, which gives
 *
 *   Z = gamma (gamma - 1) (1 - V) V^2/(2 (gamma V - 1)),
 *
 * and with A = nu + 2, B = (gamma - 1) nu + 2 continuity and entropy become quadratures of rational
 * functions of V:
 *
 *   dln(xi)/dV = [2/V - gamma - 2 - gamma (1 - V)/(gamma V - 1)]/(B V - A)
 *   dln(G)/dV  = [1 + nu V dln(xi)/dV]/(1 - V)
 *
 * V falls from 2/(gamma + 1) at the shock to 1/gamma at the centre as long as gamma < 7 at a point,
 * for any gamma elsewhere. At a point and gamma = 7 V is 1/4 everywhere, G = (4/3) xi and the
 * pressure goes as xi^3 (Primakoff's solution). w = gamma V - 1 is the parameter. The partial
 * fractions of the second line at V = 1 and V = A/B fall together at gamma = 2; they are summed so
 * that nothing cancels. */
#include "exact/sedov.h"

#include "exact/radial.h"
#include "exact/root.h"
#include "exact/waves.h"

struct sedov {
    int geometry;
    double nu, gamma, density, energy, age;
    double heavy;           /* B */
    double a, b, c;         /* ln(xi) = a ln(V) + b ln(gamma V - 1) + c ln(A - B V) + constant */
    double alone, together; /* ln(G): coefficients of the two terms at V = 1 and A/B */
    double slack;           /* ln(xi) is nearer than this to -b depth */
    double alpha;           /* E t^2 = alpha rho_0 r_s^(nu + 2) */
};

/* Logarithms of xi, G/G_s and p/p_s where w = w_s exp(-depth). */
struct sedov_place {
    double v, xi, density, pressure;
};

/* The integral of the energy, layer by layer from the shock, each twice as deep; near gamma = 7 the
 * first are thin. Beyond the last only exp(-nu b depth) is left. */
enum { LAYER_PANELS = 16, CORE_DEPTH = 40 };
#define THIN_LAYER 0x1p-20

static const char *const geometry_names[] = {"plane", "line", "point", NULL};

const struct parameter exact_sedov_table[] = {
    PARAMETER_AS("source", CHOICE, struct exact_sedov, geometry, REQUIRED,
                 "where the energy is released; positions are distances from it",
                 .names = geometry_names),
    PARAMETER(QUANTITY, struct exact_sedov, energy, REQUIRED,
              "released energy: J at a point, J/m along a line, J/m^2 on a plane (to both sides)"),
    PARAMETER(NUMBER, struct exact_sedov, density, REQUIRED, "density of the undisturbed gas",
              .unit = "kg/m^3", .below = INFINITY),
    PARAMETER(
        NUMBER, struct exact_sedov, gamma, REQUIRED,
        "ratio of specific heats; at most 7 for a point source, above which a vacuum opens there",
        .unit = "", .above = 1.0, .below = INFINITY),
    PARAMETER(NUMBER, struct exact_sedov, age, "0 s",
              "time since the release of the energy at the start of the case", .unit = "s",
              .below = INFINITY, .closed = true),
    PARAMETER_END,
};

/* ln(1 + e x)/e, x at e = 0. */
static double log_ratio(double e, double x) { return e == 0.0 ? x : log1p(e * x) / e; }

static bool is_linear(const struct sedov *s)
{
    return s->geometry == RADIAL_BALL && s->gamma == 7.0;
}

static struct sedov_place place_at(const struct sedov *s, double depth)
{
    double g = s->gamma, nu = s->nu, a = nu + 2.0, b = s->heavy, vs = 2.0 / (g + 1.0);
    double w = (g - 1.0) / (g + 1.0) * exp(-depth), v = (1.0 + w) / g;
    double gap = b - a, free_shock = 1.0 / (1.0 - vs), free = 1.0 / (1.0 - v);
    double log_v = log(v / vs), log_gap = log((a - b * v) / (a - b * vs));
    double log_free = log((1.0 - v) / (1.0 - vs));
    double core = nu / (2.0 * g + nu - 2.0);
    double both = log_ratio(gap, (free_shock - free) / (b - gap * free_shock));
    double rest = s->alone * log_free + s->together * both;
    struct sedov_place place = {.v = v};
    place.xi = s->a * log_v - s->b * depth + s->c * log_gap;
    place.density = rest - core * depth;
    /* G xi^2 Z: the powers of w cancel. */
    place.pressure = rest + 2.0 * (s->a * log_v + s->c * log_gap) + log_free + 2.0 * log_v;
    return place;
}

/* -dln(xi)/ddepth. */
static double slope_at(const struct sedov *s, double depth, double v)
{
    double g = s->gamma, w = (g - 1.0) / (g + 1.0) * exp(-depth);
    return ((2.0 / v - g - 2.0) * w - g * (1.0 - v)) / (g * (s->heavy * v - s->nu - 2.0));
}

/* (rho v^2/2 + p/(gamma - 1)) xi^(nu-1) dxi/ddepth, in units of rho_0 (2 r_s/((nu+2) t))^2: the
 * energy density is G V^3 xi^2 (gamma - 1)/(2 w). */
static double energy_share(const void *context, double depth)
{
    const struct sedov *s = context;
    double g = s->gamma;
    struct sedov_place at = place_at(s, depth);
    double density = (g + 1.0) / (g - 1.0) * exp(at.density + depth + (s->nu + 2.0) * at.xi);
    return density * at.v * at.v * at.v * (g + 1.0) / 2.0 * slope_at(s, depth, at.v);
}

/* The integral of energy_share from the shock to the centre. */
static double whole_energy(const struct sedov *s)
{
    double integral = 0.0, low = 0.0;
    for (double high = THIN_LAYER; low < CORE_DEPTH; high *= 2.0) {
        integral += radial_integral(energy_share, s, low, high, LAYER_PANELS);
        low = high;
    }
    return integral + energy_share(s, low) / (s->nu * s->b);
}

static struct error *sedov_solve(const void *parameters, void *solved)
{
    static const char *const units[RADIAL_GEOMETRIES] = {"J/m^2", "J/m", "J"};
    const struct exact_sedov *input = parameters;
    struct sedov *s = solved;
    struct unit unit;
    TRY(unit_parse(units[input->geometry], &unit));
    if (!dimension_equal(unit.dimension, input->energy.dimension) || !(input->energy.value > 0.0))
        return error_new(ERROR_INPUT, "the energy of a %s must be in %s, above zero",
                         geometry_names[input->geometry], units[input->geometry]);
    double g = input->gamma, nu = radial_dimensions(input->geometry);
    if (input->geometry == RADIAL_BALL && g > 7.0)
        return error_new(ERROR_INPUT, "a vacuum opens at the point: gamma is %g, above 7", g);
    double a = nu + 2.0, b = (g - 1.0) * nu + 2.0, gap = b - a, spread = 2.0 * g + nu - 2.0;
    *s = (struct sedov){.geometry = input->geometry, .nu = nu, .gamma = g};
    s->density = input->density;
    s->energy = input->energy.value;
    s->age = input->age;
    s->heavy = b;
    s->a = -2.0 / a;
    s->b = (g - 1.0) / spread;
    s->c = (2.0 * b / a - g - 2.0 - g * gap / spread) / b;
    s->together = nu * a * s->c;
    s->alone = nu * (g / b + a / b * (2.0 / a - g / spread)) - 1.0;
    double vs = 2.0 / (g + 1.0), gap_change = log((a - b / g) / (a - b * vs));
    s->slack = fabs(s->a * log(g * vs)) + fabs(s->c * gap_change);
    double integral = is_linear(s) ? 1.0 / 72.0 : whole_energy(s);
    s->alpha = radial_surface(s->geometry) * square(2.0 / a) * integral;
    return NULL;
}

static double shock_radius(const struct sedov *s, double time)
{
    return pow(s->energy * square(time) / (s->alpha * s->density), 1.0 / (s->nu + 2.0));
}

static double shock_speed(const struct sedov *s, double time)
{
    return 2.0 / (s->nu + 2.0) * shock_radius(s, time) / time;
}

struct sought {
    const struct sedov *sedov;
    double log_xi;
};

static struct root_value depth_of(const void *context, double depth)
{
    const struct sought *sought = context;
    struct sedov_place at = place_at(sought->sedov, depth);
    return (struct root_value){sought->log_xi - at.xi, slope_at(sought->sedov, depth, at.v)};
}

/* The place inside the blast where xi has this logarithm. */
static struct sedov_place place_of(const struct sedov *s, double log_xi)
{
    if (is_linear(s))
        return (struct sedov_place){0.25, log_xi, log_xi, 3.0 * log_xi};
    struct sought sought = {s, log_xi};
    double deepest = (s->slack - log_xi) / s->b;
    return place_at(s, root_find(depth_of, &sought, 0.0, deepest, 0.0));
}

static double sedov_front(const void *solved, double time)
{
    const struct sedov *s = solved;
    return time + s->age > 0.0 ? shock_radius(s, time + s->age) : 0.0;
}

static struct exact_state sedov_sample(const void *solved, enum exact_side side, double x,
                                       double time)
{
    (void)side;
    const struct sedov *s = solved;
    struct exact_state state = {.density = s->density};
    time += s->age;
    double g = s->gamma, radius = time > 0.0 ? shock_radius(s, time) : 0.0, r = fabs(x);
    if (!(r < radius))
        return state;
    /* Nearer to the centre than this there is nothing but pressure. */
    struct sedov_place at = place_of(s, log(maximum(r / radius, 1e-9)));
    state.density = s->density * (g + 1.0) / (g - 1.0) * exp(at.density);
    state.velocity = 2.0 / (s->nu + 2.0) * (x / time) * at.v;
    state.pressure = 2.0 / (g + 1.0) * s->density * square(shock_speed(s, time)) * exp(at.pressure);
    state.energy = state.pressure / ((g - 1.0) * state.density);
    state.stress = -state.pressure;
    return state;
}

static int sedov_numbers(const void *solved, double time, struct exact_number *numbers)
{
    const struct sedov *s = solved;
    struct number_list list = {numbers, 0};
    number_add(&list, "alpha", "", s->alpha);
    number_add(&list, "density behind the shock", "kg/m^3",
               s->density * (s->gamma + 1.0) / (s->gamma - 1.0));
    double since = time + s->age;
    if (since > 0.0) {
        double speed = shock_speed(s, since);
        number_add(&list, "shock radius", "m", shock_radius(s, since));
        number_add(&list, "shock speed", "m/s", speed);
        number_add(&list, "velocity behind the shock", "m/s", 2.0 / (s->gamma + 1.0) * speed);
        number_add(&list, "pressure behind the shock", "Pa",
                   2.0 / (s->gamma + 1.0) * s->density * square(speed));
        number_add(&list, "pressure at the centre", "Pa",
                   sedov_sample(s, SIDE_LEFT, 0.0, time).pressure);
    }
    return list.count;
}

const struct exact_class exact_sedov_class = {
    .size = sizeof(struct sedov),
    .solve = sedov_solve,
    .sample = sedov_sample,
    .numbers = sedov_numbers,
    .front = sedov_front,
};
