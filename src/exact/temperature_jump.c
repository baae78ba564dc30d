/* The decay of a jump of temperature; see temperature_jump.h. With a = lambda/(rho C_V), e =
 * sqrt(lambda rho C_V) and x from the contact, an infinite rod has
 *
 *   T* = (e_1 T_1 + e_2 T_2)/(e_1 + e_2)                                                   (1.51)
 * T = T* + (T* - T_1) erf(x/(2 sqrt(a_1 t))) left, T* + (T_2 - T*) erf(x/(2 sqrt(a_2 t))) right
 * (1.50)
 *
 * A rod of insulated ends is the series T = mean + sum c_n X_n(x) exp(-mu_n^2 t), where X_n is A
 * cos(mu (x + l_1)/sqrt(a_1)) left and B cos(mu (l_2 - x)/sqrt(a_2)) right. With theta = mu
 * l/sqrt(a), temperature and flux at the contact are continuous where
 *
 *   A cos(theta_1) = B cos(theta_2),   e_1 A sin(theta_1) + e_2 B sin(theta_2) = 0.
 *
 * The norm is int rho C_V X^2 = (rho_1 C_1 l_1 A^2 + rho_2 C_2 l_2 B^2)/2. Source: Parshikov
 * (2013), section 1.3; Carslaw and Jaeger, Conduction of heat in solids, 2.15 and 3.9. */
#include "exact/temperature_jump.h"

#include "base/base.h"
#include "exact/root.h"
#include "exact/waves.h"

enum { TERMS = 4096 };

static const double pi = 3.14159265358979323846;
/* exp(-mu^2 t) beyond this is nothing beside one. */
static const double faded = 40.0;
/* An end farther than this many 2 sqrt(a t) has not felt the jump: erfc(6) = 2e-17. */
static const double unfelt = 6.0;

struct heat_body {
    double temperature, diffusivity, effusivity, capacity; /* rho C_V, J/(m^3 K) */
    double end;                                            /* place of its insulated end */
    double span; /* l/sqrt(a), sqrt(s); INFINITY without an end */
};

struct heat_term {
    double mu;
    double amplitude[2]; /* c_n A, c_n B */
};

struct heat_problem {
    struct heat_body body[2];
    double at, contact, mean; /* mean: final temperature of the finite rod */
    int terms;                /* 0: an infinite rod */
    struct heat_term term[TERMS];
};

#define BODY(member) offsetof(struct exact_heat_body, member)
static const struct parameter body_table[] = {
    {"density", PARAMETER_NUMBER, BODY(density), "kg/m^3", REQUIRED, .above = 0.0,
     .below = INFINITY, .help = "density"},
    {"capacity", PARAMETER_NUMBER, BODY(capacity), "J/(kg*K)", REQUIRED, .above = 0.0,
     .below = INFINITY, .help = "specific heat at constant volume"},
    {"conductivity", PARAMETER_NUMBER, BODY(conductivity), "W/(m*K)", REQUIRED, .above = 0.0,
     .below = INFINITY, .help = "thermal conductivity"},
    {"temperature", PARAMETER_NUMBER, BODY(temperature), "K", REQUIRED, .above = 0.0,
     .below = INFINITY, .closed = true, .help = "temperature at the start"},
    PARAMETER_END,
};

#define JUMP(member) offsetof(struct exact_temperature_jump, member)
const struct parameter exact_temperature_jump_table[] = {
    {"left", PARAMETER_TABLE, JUMP(body[SIDE_LEFT]), .standard = REQUIRED,
     .help = "the body left of the contact", .table = body_table},
    {"right", PARAMETER_TABLE, JUMP(body[SIDE_RIGHT]), .standard = REQUIRED,
     .help = "the body right of the contact", .table = body_table},
    {"at", PARAMETER_NUMBER, JUMP(at), "m", "0 mm", .help = "position of the contact"},
    {"from", PARAMETER_NUMBER, JUMP(from), "m", OPTIONAL,
     .help = "insulated left end, together with `to`; default: an infinite rod"},
    {"to", PARAMETER_NUMBER, JUMP(to), "m", OPTIONAL, .help = "insulated right end"},
    PARAMETER_END,
};

/* A mode is where theta_1 + psi = n pi with tan(psi) = (e_2/e_1) tan(theta_2), psi continuous: that
 * sum grows with mu, so that each n has its one root and none is missed. */
struct mode {
    const struct heat_body *body;
    double turns; /* n pi */
};

static struct root_value phase(const void *context, double mu)
{
    const struct mode *mode = context;
    const struct heat_body *left = &mode->body[SIDE_LEFT], *right = &mode->body[SIDE_RIGHT];
    double theta = mu * right->span, s = sin(theta), c = cos(theta);
    double e1 = left->effusivity, e2 = right->effusivity;
    double ahead = atan2((e2 - e1) * s * c, e1 * c * c + e2 * s * s);
    double slope = e1 * e2 / (square(e1 * c) + square(e2 * s));
    return (struct root_value){mu * left->span + theta + ahead - mode->turns,
                               left->span + right->span * slope};
}

/* c_n A and c_n B of the mode MU. Of the two conditions at the contact that gives A : B which is
 * not 0 : 0. */
static struct heat_term term_of(const struct heat_problem *problem, double mu)
{
    const struct heat_body *left = &problem->body[SIDE_LEFT], *right = &problem->body[SIDE_RIGHT];
    double s1 = sin(mu * left->span), c1 = cos(mu * left->span);
    double s2 = sin(mu * right->span), c2 = cos(mu * right->span);
    bool by_value = maximum(c1 * c1, c2 * c2) > 0.25;
    double a = by_value ? c2 : right->effusivity * s2, b = by_value ? c1 : -left->effusivity * s1;
    double norm = 0.5 * (left->effusivity * left->span * a * a +
                         right->effusivity * right->span * b * b); /* rho C l = e span */
    double start = left->temperature * left->effusivity * a * s1 +
                   right->temperature * right->effusivity * b * s2;
    double c = start / (mu * norm);
    return (struct heat_term){mu, {c * a, c * b}};
}

static struct error *find_terms(struct heat_problem *problem)
{
    const struct heat_body *left = &problem->body[SIDE_LEFT], *right = &problem->body[SIDE_RIGHT];
    double shorter = minimum(left->span, right->span), both = left->span + right->span;
    /* Before an end feels the jump the rod is as good as infinite; after that so many modes
     * live. */
    double modes = sqrt(faded) * 2.0 * unfelt / shorter * both / pi;
    if (!(modes < TERMS))
        return error_new(ERROR_INPUT,
                         "heat crosses one part of the rod %g times faster than the other; the "
                         "series serves up to %g",
                         square(both / shorter - 1.0), square(TERMS / 24.2 - 1.0));
    problem->terms = (int)modes + 1;
    for (int n = 1; n <= problem->terms; n++) {
        struct mode mode = {problem->body, n * pi};
        double mu =
            root_find(phase, &mode, (n - 0.5) * pi / both, (n + 0.5) * pi / both, n * pi / both);
        problem->term[n - 1] = term_of(problem, mu);
    }
    return NULL;
}

static struct error *jump_solve(const void *parameters, void *solved)
{
    const struct exact_temperature_jump *input = parameters;
    struct heat_problem *problem = solved;
    problem->at = input->at;
    problem->terms = 0;
    if (isnan(input->from) != isnan(input->to))
        return error_new(ERROR_INPUT, "a rod has two ends: give both `from` and `to`, or neither");
    if (!isnan(input->from) && !(input->from < input->at && input->at < input->to))
        return error_new(ERROR_INPUT, "the contact `at` must lie between `from` and `to`");
    double warmth = 0.0, heat = 0.0;
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
        const struct exact_heat_body *body = &input->body[side];
        struct heat_body *b = &problem->body[side];
        b->temperature = body->temperature;
        b->capacity = body->density * body->capacity;
        b->diffusivity = body->conductivity / b->capacity;
        b->effusivity = sqrt(body->conductivity * b->capacity);
        b->end = side == SIDE_LEFT ? input->from : input->to;
        double length = fabs(b->end - input->at);
        b->span = isnan(b->end) ? (double)INFINITY : length / sqrt(b->diffusivity);
        warmth += length * b->capacity * b->temperature;
        heat += length * b->capacity;
    }
    const struct heat_body *left = &problem->body[SIDE_LEFT], *right = &problem->body[SIDE_RIGHT];
    problem->contact =
        (left->effusivity * left->temperature + right->effusivity * right->temperature) /
        (left->effusivity + right->effusivity);
    problem->mean = warmth / heat;
    return isnan(input->from) ? NULL : find_terms(problem);
}

static double temperature_at(const struct heat_problem *problem, enum exact_side side, double x,
                             double time)
{
    const struct heat_body *body = &problem->body[side];
    double shorter = minimum(problem->body[SIDE_LEFT].span, problem->body[SIDE_RIGHT].span);
    if (problem->terms) /* beyond an end: as at the end */
        x = maximum(minimum(x, problem->body[SIDE_RIGHT].end), problem->body[SIDE_LEFT].end);
    double away = fabs(x - problem->at);
    if (time <= 0.0)
        return body->temperature;
    if (shorter > 2.0 * unfelt * sqrt(time))
        return problem->contact + (body->temperature - problem->contact) *
                                      erf(away / (2.0 * sqrt(body->diffusivity * time)));
    double from_end = fabs(x - body->end) / sqrt(body->diffusivity), sum = problem->mean;
    for (int n = 0; n < problem->terms; n++) {
        const struct heat_term *term = &problem->term[n];
        double fade = square(term->mu) * time;
        if (fade > faded)
            break;
        sum += term->amplitude[side] * cos(term->mu * from_end) * exp(-fade);
    }
    return sum;
}

static struct exact_state jump_sample(const void *solved, enum exact_side side, double x,
                                      double time)
{
    struct exact_state state = {0};
    state.temperature = temperature_at(solved, side, x, time);
    return state;
}

static struct exact_state jump_star(const void *solved, enum exact_side side)
{
    const struct heat_problem *problem = solved;
    struct exact_state state = {0};
    (void)side;
    state.temperature = problem->contact;
    return state;
}

static double jump_contact(const void *solved, double time)
{
    const struct heat_problem *problem = solved;
    (void)time;
    return problem->at;
}

static int jump_numbers(const void *solved, double time, struct exact_number *numbers)
{
    const struct heat_problem *problem = solved;
    const struct heat_body *left = &problem->body[SIDE_LEFT], *right = &problem->body[SIDE_RIGHT];
    struct number_list list = {numbers, 0};
    number_add(&list, "contact temperature", "K", problem->contact);
    number_add(&list, "left diffusivity", "m^2/s", left->diffusivity);
    number_add(&list, "right diffusivity", "m^2/s", right->diffusivity);
    number_add(&list, "left effusivity", "J/(m^2*K*s^0.5)", left->effusivity);
    number_add(&list, "right effusivity", "J/(m^2*K*s^0.5)", right->effusivity);
    if (problem->terms)
        number_add(&list, "final temperature", "K", problem->mean);
    if (time > 0.0) {
        double both = 1.0 / left->effusivity + 1.0 / right->effusivity;
        number_add(&list, "heat crossed, infinite rod", "J/m^2",
                   2.0 * (right->temperature - left->temperature) / both * sqrt(time / pi));
        bool ends = problem->terms > 0;
        number_add(&list, ends ? "left end" : "left reach of the jump", "m",
                   ends ? left->end : problem->at - 5.0 * sqrt(left->diffusivity * time));
        number_add(&list, "contact", "m", problem->at);
        number_add(&list, ends ? "right end" : "right reach of the jump", "m",
                   ends ? right->end : problem->at + 5.0 * sqrt(right->diffusivity * time));
    }
    return list.count;
}

const struct exact_class exact_temperature_jump_class = {
    .size = sizeof(struct heat_problem),
    .thermal = true,
    .solve = jump_solve,
    .sample = jump_sample,
    .star = jump_star,
    .numbers = jump_numbers,
    .contact = jump_contact,
};
