/* Verney's shell; see verney.h. With radii a and b, b^2 - a^2 = B^2, u = w/r, w = a da/dt,
 * L = ln(b/a), k = 2Y/sqrt(3), the kinetic energy, pi rho w^2 L, is what is left of the plastic
 * work:
 *
 *   rho w^2 L/2 = k int_{a_f}^a a' L(a') da' = k [F(a) - F(a_f)],
 *   F = [b^2 ln b^2 - a^2 ln a^2]/4,   t = int_a^{a_0} a' da'/|w|.
 *
 * a^2 = a_f^2 + q^2 makes the last integrand finite at the stop. The momentum equation with free
 * surfaces leaves sigma_r = rho w^2/2 [(1/a^2 - 1/b^2) ln(r/a)/L + 1/r^2 - 1/a^2]; S_r = k/2, and
 * the work on a particle that came from R is k ln(R/r). */
#include "exact/verney.h"

#include "exact/radial.h"
#include "exact/root.h"
#include "exact/waves.h"

struct shell {
    struct exact_verney start;
    double thickness2; /* B^2 */
    double flow;       /* k */
    double stop2;      /* a_f^2 */
    double span;       /* q at the start */
    double stop_time;
};

enum { PANELS = 64 };

const struct parameter exact_verney_table[] = {
    PARAMETER(NUMBER, struct exact_verney, inner_radius, REQUIRED,
              "radius of the inner surface at the start", .unit = "m", .below = INFINITY),
    PARAMETER(NUMBER, struct exact_verney, outer_radius, REQUIRED,
              "radius of the outer surface at the start", .unit = "m", .below = INFINITY),
    PARAMETER(NUMBER, struct exact_verney, density, REQUIRED, "density, constant", .unit = "kg/m^3",
              .below = INFINITY),
    PARAMETER(NUMBER, struct exact_verney, yield, REQUIRED, "yield strength in simple tension",
              .unit = "Pa", .below = INFINITY),
    PARAMETER(NUMBER, struct exact_verney, speed, REQUIRED,
              "speed of the inner surface at the start, inward", .unit = "m/s", .below = INFINITY),
    PARAMETER_END,
};

/* L at the square of the inner radius. */
static double log_ratio(const struct shell *shell, double inner2)
{
    return 0.5 * log1p(shell->thickness2 / inner2);
}

/* F(a) - F(LOW) where a^2 = LOW2 + RISE, without the difference of large numbers. */
static double work_between(const struct shell *shell, double low2, double rise)
{
    double outer2 = low2 + shell->thickness2;
    return 0.25 * (2.0 * rise * log_ratio(shell, low2 + rise) + outer2 * log1p(rise / outer2) -
                   low2 * log1p(rise / low2));
}

/* |w| at q. */
static double swirl(const struct shell *shell, double q)
{
    double work = work_between(shell, shell->stop2, square(q));
    double scale = shell->start.density * log_ratio(shell, shell->stop2 + square(q));
    return sqrt(2.0 * shell->flow * work / scale);
}

/* dt/dq, going outward. */
static double pace(const void *context, double q) { return q / swirl(context, q); }

struct share {
    const struct shell *shell;
    double wanted;
};

/* What is left of the wanted work at the square of a final radius: increasing. */
static struct root_value work_left(const void *context, double final2)
{
    const struct share *share = context;
    const struct shell *shell = share->shell;
    double rise = square(shell->start.inner_radius) - final2;
    return (struct root_value){share->wanted - work_between(shell, final2, rise),
                               0.5 * log_ratio(shell, final2)};
}

/* Time passed at span - BACK, less the wanted one. */
static struct root_value time_passed(const void *context, double back)
{
    const struct share *share = context;
    const struct shell *shell = share->shell;
    double q = shell->span - back;
    double passed = radial_integral(pace, shell, q, shell->span, PANELS);
    return (struct root_value){passed - share->wanted, q > 0.0 ? pace(shell, q) : NAN};
}

static struct error *shell_solve(const void *parameters, void *solved)
{
    struct shell *shell = solved;
    shell->start = *(const struct exact_verney *)parameters;
    double inner2 = square(shell->start.inner_radius);
    shell->thickness2 = square(shell->start.outer_radius) - inner2;
    shell->flow = 2.0 * shell->start.yield / sqrt(3.0);
    if (!(shell->thickness2 > 0.0))
        return error_new(ERROR_INPUT, "outer_radius: must be larger than inner_radius");
    double energy =
        0.5 * shell->start.density * inner2 * square(shell->start.speed) * log_ratio(shell, inner2);
    struct share share = {shell, energy / shell->flow};
    double least = 1e-12 * inner2;
    if (!(work_left(&share, least).value < 0.0))
        return error_new(ERROR_INPUT, "speed: %g m/s closes the shell before it stops",
                         shell->start.speed);
    shell->stop2 = root_find(work_left, &share, least, inner2, 0.5 * inner2);
    shell->span = sqrt(inner2 - shell->stop2);
    shell->stop_time = radial_integral(pace, shell, 0.0, shell->span, PANELS);
    return NULL;
}

/* q at TIME. */
static double place_at(const struct shell *shell, double time)
{
    if (!(time > 0.0))
        return shell->span;
    if (time >= shell->stop_time)
        return 0.0;
    struct share share = {shell, time};
    double guess = shell->span * time / shell->stop_time;
    return shell->span - root_find(time_passed, &share, 0.0, shell->span, guess);
}

static struct exact_state shell_sample(const void *solved, enum exact_side side, double x,
                                       double time)
{
    (void)side;
    const struct shell *shell = solved;
    double q = place_at(shell, time), inner2 = shell->stop2 + square(q);
    double outer2 = inner2 + shell->thickness2, r2 = square(x);
    struct exact_state state = {0};
    if (r2 < inner2 || r2 > outer2)
        return state;
    double w = q > 0.0 ? swirl(shell, q) : 0.0;
    double share = 0.5 * log(r2 / inner2) / log_ratio(shell, inner2);
    double push = (1.0 / inner2 - 1.0 / outer2) * share + 1.0 / r2 - 1.0 / inner2;
    double moved = square(shell->start.inner_radius) - inner2;
    state.density = shell->start.density;
    state.velocity = -w / x;
    state.stress = 0.5 * shell->start.density * square(w) * push;
    state.deviator = 0.5 * shell->flow;
    state.pressure = state.deviator - state.stress;
    state.energy = 0.5 * shell->flow / shell->start.density * log1p(moved / r2);
    return state;
}

/* Kinetic energy a unit length of the whole ring at q. */
static double kinetic_energy(const struct shell *shell, double q)
{
    double w = q > 0.0 ? swirl(shell, q) : 0.0;
    return M_PI * shell->start.density * square(w) * log_ratio(shell, shell->stop2 + square(q));
}

static int shell_numbers(const void *solved, double time, struct exact_number *numbers)
{
    const struct shell *shell = solved;
    struct number_list list = {numbers, 0};
    number_add(&list, "inner radius at the stop", "m", sqrt(shell->stop2));
    number_add(&list, "outer radius at the stop", "m", sqrt(shell->stop2 + shell->thickness2));
    number_add(&list, "time of the stop", "s", shell->stop_time);
    number_add(&list, "kinetic energy at the start", "J/m", kinetic_energy(shell, shell->span));
    if (time > 0.0) {
        double q = place_at(shell, time), inner2 = shell->stop2 + square(q);
        double w = q > 0.0 ? swirl(shell, q) : 0.0;
        number_add(&list, "inner radius", "m", sqrt(inner2));
        number_add(&list, "outer radius", "m", sqrt(inner2 + shell->thickness2));
        number_add(&list, "velocity of the inner surface", "m/s", -w / sqrt(inner2));
        number_add(&list, "share of the kinetic energy", "",
                   kinetic_energy(shell, q) / kinetic_energy(shell, shell->span));
    }
    return list.count;
}

const struct exact_class exact_verney_class = {
    .size = sizeof(struct shell),
    .solve = shell_solve,
    .sample = shell_sample,
    .numbers = shell_numbers,
};
