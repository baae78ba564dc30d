/* The state of a body at the start, at one place of it: two of density, pressure and energy are
 * free, the equation of state gives the third. A temperature stands for the energy, the mean of a
 * stress for the pressure. */
#include "case/internal.h"
#include "material/material.h"

static double pressure_at(const struct eos *eos, double density, double energy, unsigned *status)
{
    const double history[POINT_HISTORY] = {0.0};
    struct eos_value value = eos_evaluate(eos, density, energy, history);
    *status = value.status | (isfinite(value.pressure) ? 0u : POINT_OUT_OF_RANGE);
    return value.pressure;
}

/* The energy that is given at DENSITY, by itself or by a temperature; zero when neither is. */
static double energy_at(const struct start_given *given, const struct material *material,
                        double density)
{
    if (!isnan(given->temperature))
        return heat_energy(&material->heat, &material->eos, density, given->temperature);
    return isnan(given->energy) ? 0.0 : given->energy;
}

/* The density nearest to the reference density at which the energy given there gives PRESSURE; NAN
 * when there is none between a hundredth and a hundred times that. Steps outwards as long as
 * pressure grows with density, then bisects to the last bit. */
static double density_of_pressure(const struct start_given *given, const struct material *material,
                                  double pressure)
{
    static const double step = 1.02, reach = 100.0;
    unsigned status;
    const struct eos *eos = &material->eos;
    double reference = eos_reference_density(eos);
    double start =
        pressure_at(eos, reference, energy_at(given, material, reference), &status) - pressure;
    if (start == 0.0 && !status)
        return reference;
    double factor = start < 0.0 ? step : 1.0 / step;
    double near = reference, far = reference, now = start;
    while ((now < 0.0) == (start < 0.0)) {
        near = far;
        far *= factor;
        const double before = now;
        now = pressure_at(eos, far, energy_at(given, material, far), &status) - pressure;
        bool grows = start < 0.0 ? now > before : now < before;
        if (status || !grows || far > reach * reference || far * reach < reference)
            return NAN;
    }
    for (double middle = 0.5 * (near + far); middle != near && middle != far;
         middle = 0.5 * (near + far)) {
        double value =
            pressure_at(eos, middle, energy_at(given, material, middle), &status) - pressure;
        if (value == 0.0)
            return middle;
        if ((value < 0.0) == (start < 0.0))
            near = middle;
        else
            far = middle;
    }
    return far;
}

/* The energy at which DENSITY gives PRESSURE, by Newton's method; NAN when there is none. */
static double energy_of_pressure(const struct eos *eos, double pressure, double density)
{
    const double history[POINT_HISTORY] = {0.0};
    double energy = 0.0;
    for (int i = 0; i < 50; i++) {
        struct eos_value value = eos_evaluate(eos, density, energy, history);
        double missing = pressure - value.pressure;
        if (!isfinite(missing / value.dp_de))
            return NAN;
        energy += missing / value.dp_de;
        if (fabs(missing) <= 1e-14 * (fabs(pressure) + fabs(value.dp_de * energy)))
            return energy;
    }
    return NAN;
}

static bool depends_on_energy(const struct eos *eos)
{
    const double history[POINT_HISTORY] = {0.0};
    return eos_evaluate(eos, eos_reference_density(eos), 0.0, history).dp_de != 0.0;
}

/* PRESSURE is given, and perhaps one of density and energy. */
static const char *from_pressure(const struct start_given *given, const struct material *material,
                                 double pressure, struct point *point)
{
    const struct eos *eos = &material->eos;
    if (!isnan(given->density)) {
        if (!depends_on_energy(eos))
            return "pressure follows from density here, as the equation of state has no energy: "
                   "give "
                   "one of the two";
        point->energy = energy_of_pressure(eos, pressure, point->density);
        return isnan(point->energy) ? "no energy gives this pressure at this density" : NULL;
    }
    double density = density_of_pressure(given, material, pressure);
    if (!isnan(density)) {
        point->density = density;
        point->energy = energy_at(given, material, density);
        return NULL;
    }
    if (isnan(given->energy) && isnan(given->temperature) && depends_on_energy(eos))
        point->energy = energy_of_pressure(eos, pressure, point->density);
    else
        point->energy = NAN;
    return isnan(point->energy) ? "the equation of state does not reach this pressure" : NULL;
}

const char *start_state(const struct start_given *given, const struct material *material,
                        struct point *result, const char **key)
{
    struct point point = {.density =
                              isnan(given->density) ? material_density(material) : given->density};
    point.energy = energy_at(given, material, point.density);
    double pressure = given->pressure;
    if (given->stressed) {
        pressure = -sym3_trace(given->stress) / 3.0;
        const struct sym3 mean = {pressure, pressure, pressure, 0.0, 0.0, 0.0};
        point.deviator = sym3_add(given->stress, mean);
    }
    *key = given->stressed ? "stress" : "pressure";
    const char *wrong = isnan(pressure) ? NULL : from_pressure(given, material, pressure, &point);
    if (wrong)
        return wrong;
    struct response response = material_evaluate(material, &point);
    if (given->stressed && sym3_mises(point.deviator) > (1.0 + 1e-12) * response.yield)
        return "this is above the yield stress: the material would flow at once";
    *key = "";
    if (response.status & POINT_OUT_OF_RANGE || !isfinite(point.pressure))
        return "the state at the start is outside the range of the equation of state";
    if (response.sound_long > SPEED_OF_LIGHT)
        return "at this start state sound would be faster than light";
    if (response.status & POINT_NO_SOUND)
        return isnan(pressure) && isnan(given->energy) && isnan(given->temperature)
                   ? "at this start state sound does not travel: give `pressure` or `energy`"
                   : "at this start state sound does not travel: give a larger `pressure` or "
                     "`energy`";
    *result = point;
    return NULL;
}

bool body_varies(const struct body_input *body)
{
    bool varies = body->density.varying || body->pressure.varying || body->energy.varying ||
                  body->temperature.varying;
    for (int i = 0; i < body->stress.count; i++)
        varies = varies || body->stress.at[i].varying;
    return varies;
}

const char *body_start_wrong(const struct body_input *body, const struct material *material,
                             const char **key)
{
    bool stress = body->stress.count > 0, pressure = field_is_given(&body->pressure);
    bool energy = field_is_given(&body->energy), temperature = field_is_given(&body->temperature);
    *key = "stress";
    if (stress && !material_has_strength(material))
        return "a fluid has no stress but its pressure: give `pressure`";
    if (stress && pressure)
        return "its mean is the pressure: `pressure` cannot be given beside it";
    *key = "pressure";
    if (pressure && material_is_lit(material))
        return "an unburnt explosive has no pressure: leave this out";
    *key = "temperature";
    if (energy && temperature)
        return "energy follows from it: `energy` cannot be given beside it";
    *key = energy ? "energy" : "temperature";
    if (field_is_given(&body->density) && (stress || pressure) && (energy || temperature))
        return "at most two of density, pressure (or stress) and energy (or temperature) can be "
               "given";
    return NULL;
}

/* FIELD at PLACE, which must be more than LEAST. */
static const char *value_at(const struct field_value *field, const char *name, struct vec3 place,
                            double least, double *value, const char **key)
{
    *value = field_at(field, place, 0.0);
    *key = name;
    if (field->varying && !isfinite(*value))
        return "the value is not finite";
    return *value <= least ? "the value must be more than zero" : NULL;
}

static const char *components_at(const struct field_list *list, const char *name, struct vec3 place,
                                 double *values, const char **key)
{
    for (int i = 0; i < list->count; i++) {
        const char *wrong = value_at(&list->at[i], name, place, -INFINITY, &values[i], key);
        if (wrong)
            return wrong;
    }
    return NULL;
}

const char *body_state_at(const struct body_input *body, const struct material *material,
                          struct vec3 place, struct point *point, const char **key)
{
    struct start_given given = {.stressed = body->stress.count > 0};
    double stress[FIELD_COMPONENTS] = {0.0};
    const char *wrong = value_at(&body->density, "density", place, 0.0, &given.density, key);
    if (!wrong)
        wrong = value_at(&body->pressure, "pressure", place, -INFINITY, &given.pressure, key);
    if (!wrong)
        wrong = value_at(&body->energy, "energy", place, -INFINITY, &given.energy, key);
    if (!wrong)
        wrong = value_at(&body->temperature, "temperature", place, 0.0, &given.temperature, key);
    if (!wrong)
        wrong = components_at(&body->stress, "stress", place, stress, key);
    if (wrong)
        return wrong;
    given.stress = (struct sym3){stress[0], stress[1], stress[2], stress[3], stress[4], stress[5]};
    return start_state(&given, material, point, key);
}

const char *body_start_at(const struct body_input *body, const struct material *material,
                          struct vec3 place, struct point *point, double velocity[3],
                          const char **key)
{
    if (body->varies) {
        const char *wrong = body_state_at(body, material, place, point, key);
        if (wrong)
            return wrong;
    } else {
        *point = body->start;
    }
    const char *wrong = components_at(&body->velocity, "velocity", place, velocity, key);
    for (int i = 0; i < body->velocity.count && !wrong; i++)
        if (fabs(velocity[i]) > SPEED_OF_LIGHT)
            wrong = "this is faster than light";
    return wrong;
}
