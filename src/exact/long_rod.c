/* The penetration of a long rod; see long_rod.h. With L the length and P the depth,
 *
 *   rho_p L dv/dt = -F,   dL/dt = -(v - u),   dP/dt = u.
 *
 * While the rod erodes F = Y and u follows from Bernoulli's equation. If Y < R that ends where u =
 * 0, and the rest of the rod is spent on a target that resists. If Y > R it ends where u = v; then
 * the rod is rigid, and F = R + rho_t v^2/2. The variable of integration is v, and L = L_0 exp(-s):
 * in both phases and at their ends the derivatives by v are finite,
 *
 *   ds/dv = -rho_p (v - u)/F,   dP/dv = -rho_p L u/F,   dt/dv = -rho_p L/F.
 *
 * Without strength of the rod v is constant until the rod is spent. */
#include "exact/long_rod.h"

#include "exact/waves.h"

/* The rod at a velocity of its tail; s is ln(L_0/L). */
struct rod {
    double v, s, depth, time;
};

struct penetration {
    struct exact_long_rod start;
    double turn; /* m/s, of the tail where erosion (Y > R) or penetration (Y <= R) ends */
    struct rod first, end;
};

enum {
    STEPS = 512,         /* of a phase, at least */
    STEPS_PER_UNIT = 256 /* of s */
};

static const double spent = 40.0; /* s of a rod of which nothing is left */

const struct parameter exact_long_rod_table[] = {
    PARAMETER(NUMBER, struct exact_long_rod, length, REQUIRED, "length of the rod at the start",
              .unit = "m", .below = INFINITY),
    PARAMETER(NUMBER, struct exact_long_rod, speed, REQUIRED, "speed of the rod at the start",
              .unit = "m/s", .below = INFINITY),
    PARAMETER(NUMBER, struct exact_long_rod, rod_density, REQUIRED, "density of the rod",
              .unit = "kg/m^3", .below = INFINITY),
    PARAMETER(NUMBER, struct exact_long_rod, target_density, REQUIRED, "density of the target",
              .unit = "kg/m^3", .below = INFINITY),
    PARAMETER(NUMBER, struct exact_long_rod, rod_strength, REQUIRED, "Y: flow stress of the rod",
              .unit = "Pa", .below = INFINITY, .closed = true),
    PARAMETER(NUMBER, struct exact_long_rod, target_strength, REQUIRED,
              "R: resistance of the target, about Y_t (2/3 + ln(0.57 E/Y_t)) with its yield "
              "strength Y_t (Tate 1986)",
              .unit = "Pa", .below = INFINITY, .closed = true),
    PARAMETER_END,
};

static bool erodes(const struct penetration *run, double v)
{
    return run->start.rod_strength <= run->start.target_strength || v > run->turn;
}

/* u at V, from Bernoulli's equation as a quadratic for u, in a form that equal densities suit. */
static double nose_velocity(const struct penetration *run, double v)
{
    const struct exact_long_rod *start = &run->start;
    if (!erodes(run, v))
        return v;
    double a = start->rod_density - start->target_density, b = start->rod_density * v;
    double c = b * v + 2.0 * (start->rod_strength - start->target_strength);
    return c > 0.0 ? minimum(v, c / (b + sqrt(maximum(square(b) - a * c, 0.0)))) : 0.0;
}

static double nose_pressure(const struct penetration *run, double v)
{
    double u = nose_velocity(run, v);
    return u > 0.0 || !erodes(run, v)
               ? run->start.target_strength + 0.5 * run->start.target_density * square(u)
               : run->start.rod_strength + 0.5 * run->start.rod_density * square(v);
}

static double length_at(const struct penetration *run, const struct rod *rod)
{
    return run->start.length * exp(-rod->s);
}

/* The derivatives by v. */
static struct rod slopes(const struct penetration *run, const struct rod *rod)
{
    double u = nose_velocity(run, rod->v), density = run->start.rod_density;
    double force = erodes(run, rod->v) ? run->start.rod_strength : nose_pressure(run, rod->v);
    double mass = density * length_at(run, rod);
    return (struct rod){1.0, -density * (rod->v - u) / force, -mass * u / force, -mass / force};
}

static struct rod moved(const struct rod *rod, const struct rod *slope, double dv)
{
    return (struct rod){rod->v + dv, rod->s + dv * slope->s, rod->depth + dv * slope->depth,
                        rod->time + dv * slope->time};
}

/* One step of the classical method of Runge and Kutta; DV is negative. */
static struct rod stepped(const struct penetration *run, const struct rod *rod, double dv)
{
    struct rod a = slopes(run, rod), at = moved(rod, &a, 0.5 * dv);
    struct rod b = slopes(run, &at);
    at = moved(rod, &b, 0.5 * dv);
    struct rod c = slopes(run, &at);
    at = moved(rod, &c, dv);
    struct rod d = slopes(run, &at);
    struct rod mean = {1.0, (a.s + 2.0 * (b.s + c.s) + d.s) / 6.0,
                       (a.depth + 2.0 * (b.depth + c.depth) + d.depth) / 6.0,
                       (a.time + 2.0 * (b.time + c.time) + d.time) / 6.0};
    return moved(rod, &mean, dv);
}

/* From ROD on until its tail has the velocity LOW, the rod is spent or TIME is reached. */
static struct rod integrated(const struct penetration *run, struct rod rod, double low, double time)
{
    double longest = (rod.v - low) / STEPS;
    while (rod.v > low && rod.s < spent && rod.time < time) {
        double thick = fabs(slopes(run, &rod).s) * STEPS_PER_UNIT;
        double dv = longest / maximum(1.0, thick * longest);
        if (rod.v - dv < low + 1e-9 * longest)
            dv = rod.v - low;
        struct rod next = stepped(run, &rod, -dv);
        if (next.time > time) {
            double under = 0.0, over = dv;
            for (int i = 0; i < 60; i++) {
                dv = 0.5 * (under + over);
                next = stepped(run, &rod, -dv);
                *(next.time > time ? &over : &under) = dv;
            }
            next.time = time;
        }
        if (dv == rod.v - low)
            next.v = low;
        rod = next;
    }
    return rod;
}

/* A rod without strength keeps its velocity: L falls at the constant rate v - u. */
static struct rod steady(const struct penetration *run, double time)
{
    double v = run->start.speed, u = nose_velocity(run, v);
    double left = run->start.length - (v - u) * time;
    if (left <= 0.0) {
        time = run->start.length / (v - u);
        return (struct rod){v, INFINITY, u * time, time};
    }
    return (struct rod){v, log(run->start.length / left), u * time, time};
}

static struct rod rod_at(const struct penetration *run, double time)
{
    if (!(run->start.rod_strength > 0.0))
        return steady(run, time);
    struct rod rod = integrated(run, run->first, run->turn, time);
    return rod.s < spent ? integrated(run, rod, 0.0, time) : rod;
}

static struct error *rod_solve(const void *parameters, void *solved)
{
    struct penetration *run = solved;
    run->start = *(const struct exact_long_rod *)parameters;
    const struct exact_long_rod *start = &run->start;
    double excess = start->rod_strength - start->target_strength;
    if (excess > 0.0 && !(start->target_strength > 0.0))
        return error_new(ERROR_INPUT, "target_strength: must be above 0 if the rod has strength; "
                                      "the rod would never stop");
    run->turn = excess > 0.0 ? sqrt(2.0 * excess / start->target_density)
                             : sqrt(-2.0 * excess / start->rod_density);
    run->turn = minimum(run->turn, start->speed);
    run->first = (struct rod){.v = start->speed};
    run->end = rod_at(run, INFINITY);
    return NULL;
}

static struct exact_state rod_star(const void *solved, enum exact_side side)
{
    const struct penetration *run = solved;
    struct exact_state state = {0};
    state.density = side == SIDE_LEFT ? run->start.rod_density : run->start.target_density;
    state.velocity = nose_velocity(run, run->start.speed);
    state.pressure = nose_pressure(run, run->start.speed);
    state.stress = -state.pressure;
    return state;
}

static struct exact_state rod_sample(const void *solved, enum exact_side side, double x,
                                     double time)
{
    const struct penetration *run = solved;
    struct rod rod = rod_at(run, time);
    struct exact_state state = {0};
    if (side == SIDE_RIGHT) {
        state.density = run->start.target_density;
    } else if (x >= rod.depth - length_at(run, &rod)) {
        state.density = run->start.rod_density;
        state.velocity = rod.v;
    }
    return state;
}

static double rod_contact(const void *solved, double time)
{
    const struct penetration *run = solved;
    return time > 0.0 ? rod_at(run, time).depth : 0.0;
}

static int rod_numbers(const void *solved, double time, struct exact_number *numbers)
{
    const struct penetration *run = solved;
    const struct exact_long_rod *start = &run->start;
    struct number_list list = {numbers, 0};
    number_add(&list, "nose velocity at the start", "m/s", nose_velocity(run, start->speed));
    number_add(&list, "nose pressure at the start", "Pa", nose_pressure(run, start->speed));
    bool eroding = start->rod_strength <= start->target_strength;
    number_add(&list,
               eroding ? "tail velocity where penetration ends"
                       : "tail velocity where erosion ends",
               "m/s", run->turn);
    number_add(&list, "final depth", "m", run->end.depth);
    number_add(&list, "final depth over length", "", run->end.depth / start->length);
    number_add(&list, "hydrodynamic depth over length", "",
               sqrt(start->rod_density / start->target_density));
    number_add(&list, "final length", "m", length_at(run, &run->end));
    number_add(&list, "time of the end", "s", run->end.time);
    if (time > 0.0) {
        struct rod rod = rod_at(run, time);
        bool over = time >= run->end.time;
        number_add(&list, "depth", "m", rod.depth);
        number_add(&list, "length of the rod", "m", length_at(run, &rod));
        number_add(&list, "tail velocity", "m/s", rod.v);
        number_add(&list, "nose velocity", "m/s", over ? 0.0 : nose_velocity(run, rod.v));
    }
    return list.count;
}

const struct exact_class exact_long_rod_class = {
    .size = sizeof(struct penetration),
    .solve = rod_solve,
    .sample = rod_sample,
    .star = rod_star,
    .numbers = rod_numbers,
    .contact = rod_contact,
};
