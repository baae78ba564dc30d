/* A detonation with its reaction zone; see znd.h and detonation.h. Behind the shock, where l has
 * burnt, the state lies on the Rayleigh line; time and distance from the shock are
 *
 *   t = int dl/r,   x = int (D - u) dl/r,   r = dl/dt
 *
 * by Gauss's quadrature between the fractions at which terms of the rate end. It is refined towards
 * both ends of each such range, where the rate may vanish. */
#include "exact/znd.h"

#include "exact/detonation.h"
#include "exact/waves.h"

enum { PANELS = 120, RANGES = BURN_ENDS + 1, NODES = PANELS * RANGES };

struct znd {
    struct detonation detonation;
    double at, velocity;
    double rest; /* temperature of the explosive ahead, K */
    int count;   /* of nodes beyond the first; each has its state */
    double time[NODES + 1], distance[NODES + 1];
    struct detonation_state state[NODES + 1];
};

const struct parameter exact_znd_table[] = {
    PARAMETER(TEXT, struct exact_znd, material, REQUIRED,
              "an explosive that burns at a rate: a material of the case; in `bolide exact`, of "
              "the library"),
    PARAMETER(NUMBER, struct exact_znd, density, OPTIONAL,
              "density ahead of the front, less than that of the solid in a porous explosive; "
              "default: that of the solid",
              .unit = "kg/m^3", .below = INFINITY),
    PARAMETER(NUMBER, struct exact_znd, at, "0 mm", "position of the front at the start",
              .unit = "m"),
    PARAMETER(NUMBER, struct exact_znd, velocity, "0 m/s",
              "velocity of the explosive ahead of the front", .unit = "m/s"),
    PARAMETER_END,
};

static const char *znd_material_name(const void *parameters, int index, const char **key)
{
    *key = "material";
    return index ? NULL : ((const struct exact_znd *)parameters)->material;
}

static void znd_take_material(void *parameters, int index, const struct material *material)
{
    (void)index;
    ((struct exact_znd *)parameters)->models = *material;
}

/* The fractions burnt, in order, between which the rate is smooth. */
static void find_ranges(const struct material *material, double range[RANGES + 1])
{
    range[0] = 0.0;
    range[RANGES] = 1.0;
    burn_rate_ends(&material->burn, range + 1);
    for (int i = 2; i < RANGES; i++)
        for (int k = i; k > 1 && range[k] < range[k - 1]; k--) {
            const double smaller = range[k];
            range[k] = range[k - 1];
            range[k - 1] = smaller;
        }
}

/* Adds the range from LOW to HIGH. False where the explosive does not burn. */
static bool add_range(struct znd *z, const struct material *material, double low, double high)
{
    static const double place[3] = {-0.774596669241483377, 0.0, 0.774596669241483377},
                        weight[3] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
    for (int panel = 0; panel < PANELS; panel++) {
        double time = 0.0, distance = 0.0, rate;
        for (int k = 0; k < 3; k++) {
            const double s = (panel + 0.5 + 0.5 * place[k]) / PANELS, rest = 1.0 - s;
            const double burnt = low + (high - low) * s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
            const double step =
                (high - low) * 30.0 * s * s * rest * rest * 0.5 * weight[k] / PANELS;
            const struct detonation_state state =
                detonation_zone(material, &z->detonation, burnt, &rate);
            if (!(rate > 0.0))
                return false;
            time += step / rate;
            distance += step * (z->detonation.speed - state.velocity) / rate;
        }
        const double s = (panel + 1.0) / PANELS;
        const double burnt = low + (high - low) * s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
        z->time[z->count + 1] = z->time[z->count] + time;
        z->distance[z->count + 1] = z->distance[z->count] + distance;
        z->state[++z->count] = detonation_zone(material, &z->detonation, burnt, &rate);
    }
    return true;
}

static struct error *znd_solve(const void *parameters, void *solved)
{
    const struct exact_znd *given = parameters;
    const struct material *material = &given->models;
    struct znd *z = solved;
    z->at = given->at;
    z->velocity = given->velocity;
    z->count = 0;
    if (!burn_has_rate(&material->burn))
        return error_new(ERROR_INPUT,
                         "%s does not burn at a rate, as with `burn: ignition-growth`; "
                         "slab-detonation has the wave of explosives that are lit",
                         given->material);
    const double solid = material_density(material),
                 ahead = isnan(given->density) ? solid : given->density;
    if (!detonation_solve(material, ahead, &z->detonation))
        return error_new(ERROR_INPUT, "%s of %g kg/m^3 carries no detonation", given->material,
                         ahead);
    if (isnan(z->detonation.spike.density))
        return error_new(ERROR_INPUT,
                         "no shock of %g m/s, the speed of detonation, compresses %s of %g kg/m^3",
                         z->detonation.speed, given->material, ahead);
    double range[RANGES + 1];
    find_ranges(material, range);
    z->time[0] = z->distance[0] = 0.0;
    z->state[0] = z->detonation.spike;
    for (int k = 0; k < RANGES; k++)
        if (range[k + 1] > range[k] && !add_range(z, material, range[k], range[k + 1]))
            return error_new(ERROR_INPUT, "%s stops burning where %g to %g of it has burnt",
                             given->material, range[k], range[k + 1]);
    z->rest = detonation_temperature(material, solid, 0.0, 0.0, 1.0);
    return NULL;
}

/* Between nodes K and K + 1 at the fraction SHARE of the way. */
static struct detonation_state between(const struct znd *z, int k, double share)
{
    const struct detonation_state *a = &z->state[k], *b = &z->state[k + 1];
    const double other = 1.0 - share;
    return (struct detonation_state){
        .density = other * a->density + share * b->density,
        .pressure = other * a->pressure + share * b->pressure,
        .velocity = other * a->velocity + share * b->velocity,
        .energy = other * a->energy + share * b->energy,
        .sound = other * a->sound + share * b->sound,
        .temperature = other * a->temperature + share * b->temperature,
        .burnt = other * a->burnt + share * b->burnt,
    };
}

/* The last node before the one at which VALUE is passed in COLUMN, which rises. */
static int node_before(const struct znd *z, const double *column, double value)
{
    int low = 0, high = z->count;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        *(column[middle] > value ? &high : &low) = middle;
    }
    return low;
}

static double front_at(const void *solved, double time)
{
    const struct znd *z = solved;
    return z->at + (z->detonation.speed + z->velocity) * time;
}

static struct exact_state znd_sample(const void *solved, enum exact_side side, double x,
                                     double time)
{
    (void)side;
    const struct znd *z = solved;
    const double passed = front_at(solved, time) - x;
    if (passed < 0.0)
        return (struct exact_state){
            .density = z->detonation.ahead, .velocity = z->velocity, .temperature = z->rest};
    struct detonation_state s = z->detonation.cj;
    if (passed < z->distance[z->count]) {
        const int k = node_before(z, z->distance, passed);
        s = between(z, k, (passed - z->distance[k]) / (z->distance[k + 1] - z->distance[k]));
    }
    return (struct exact_state){.density = s.density,
                                .velocity = z->velocity + s.velocity,
                                .pressure = s.pressure,
                                .energy = s.energy,
                                .stress = -s.pressure,
                                .temperature = s.temperature,
                                .burnt = s.burnt};
}

/* The node before that at which BURNT has burnt, and the fraction of the way from it. */
static int node_of(const struct znd *z, double burnt, double *share)
{
    int k = 0;
    while (k < z->count - 1 && z->state[k + 1].burnt < burnt)
        k++;
    *share = (burnt - z->state[k].burnt) / (z->state[k + 1].burnt - z->state[k].burnt);
    return k;
}

static int znd_numbers(const void *solved, double time, struct exact_number *numbers)
{
    const struct znd *z = solved;
    static const struct {
        double burnt;
        const char *pressure, *density, *time, *distance;
    } places[] = {
        {0.5, "pressure at 0.5 burnt", "density at 0.5 burnt", "time to 0.5 burnt",
         "distance to 0.5 burnt"},
        {0.9, "pressure at 0.9 burnt", "density at 0.9 burnt", "time to 0.9 burnt",
         "distance to 0.9 burnt"},
        {0.99, "pressure at 0.99 burnt", "density at 0.99 burnt", "time to 0.99 burnt",
         "distance to 0.99 burnt"},
    };
    const struct detonation_state *cj = &z->detonation.cj, *spike = &z->detonation.spike;
    struct number_list list = {numbers, 0};
    number_add(&list, "detonation speed", "m/s", z->detonation.speed);
    number_add(&list, "CJ pressure", "Pa", cj->pressure);
    number_add(&list, "CJ density", "kg/m^3", cj->density);
    number_add(&list, "CJ velocity", "m/s", cj->velocity);
    number_add(&list, "CJ sound speed", "m/s", cj->sound);
    number_add(&list, "CJ temperature", "K", cj->temperature);
    number_add(&list, "spike pressure", "Pa", spike->pressure);
    number_add(&list, "spike density", "kg/m^3", spike->density);
    number_add(&list, "spike velocity", "m/s", spike->velocity);
    number_add(&list, "spike temperature", "K", spike->temperature);
    for (size_t i = 0; i < COUNT_OF(places); i++) {
        double share;
        const int k = node_of(z, places[i].burnt, &share);
        const struct detonation_state s = between(z, k, share);
        const double distance = z->distance[k] + share * (z->distance[k + 1] - z->distance[k]);
        number_add(&list, places[i].pressure, "Pa", s.pressure);
        number_add(&list, places[i].density, "kg/m^3", s.density);
        number_add(&list, places[i].time, "s", z->time[k] + share * (z->time[k + 1] - z->time[k]));
        if (!(time > 0.0))
            number_add(&list, places[i].distance, "m", distance);
        else if (i + 1 == COUNT_OF(places))
            number_add(&list, "0.99 burnt", "m", front_at(solved, time) - distance);
    }
    if (time > 0.0)
        number_add(&list, "front", "m", front_at(solved, time));
    return list.count;
}

const struct exact_class exact_znd_class = {
    .size = sizeof(struct znd),
    .burns = true,
    .material_name = znd_material_name,
    .take_material = znd_take_material,
    .solve = znd_solve,
    .sample = znd_sample,
    .numbers = znd_numbers,
    .contact = front_at,
};
