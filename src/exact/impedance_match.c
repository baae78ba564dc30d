/* Planar impact by impedance match; see impedance_match.h.
 *
 * With w = u_left - u* and W = u_left - u_right, both sides have the pressure rho (C + S |u* - u|)
 * |u* - u|:
 *   rho_l (C_l + S_l w) w = rho_r (C_r + S_r (W - w)) (W - w),
 * a quadratic in w. Behind a shock 1/rho = (1 - w/U_s)/rho_0 and E = w^2/2, (1.65), (1.66). Source:
 * Parshikov (2013), section 1.6. */
#include "exact/impedance_match.h"

#include "exact/waves.h"
#include "material/material.h"

struct impact_problem {
    struct waves waves;    /* first: waves.h */
    double shock_speed[2]; /* U_s relative to the material ahead */
};

static const struct parameter material_table[] = {
    {"material", PARAMETER_TEXT, offsetof(struct exact_shock_material, name), .standard = OPTIONAL,
     .help = "a material with `eos: mie-grueneisen`, of the case or, in `bolide exact`, of the "
             "library; gives density, sound and slope"},
    {"density", PARAMETER_NUMBER, offsetof(struct exact_shock_material, density), "kg/m^3",
     OPTIONAL, .above = 0.0, .below = INFINITY,
     .help = "density at the start, at zero pressure; default: that of the material"},
    {"sound", PARAMETER_NUMBER, offsetof(struct exact_shock_material, sound), "m/s", OPTIONAL,
     .above = 0.0, .below = INFINITY,
     .help = "C of the shock relation U_s = C + S U_p; default: that of the material"},
    {"slope", PARAMETER_NUMBER, offsetof(struct exact_shock_material, slope), "", OPTIONAL,
     .above = 0.0, .below = INFINITY, .closed = true,
     .help = "S of the shock relation U_s = C + S U_p; default: that of the material"},
    {"velocity", PARAMETER_NUMBER, offsetof(struct exact_shock_material, velocity), "m/s", "0 m/s",
     .help = "velocity at the start, positive to the right"},
    PARAMETER_END,
};

const struct parameter exact_impedance_match_table[] = {
    {"left", PARAMETER_TABLE, offsetof(struct exact_impedance_match, material[SIDE_LEFT]),
     .standard = REQUIRED, .help = "the material left of the contact", .table = material_table},
    {"right", PARAMETER_TABLE, offsetof(struct exact_impedance_match, material[SIDE_RIGHT]),
     .standard = REQUIRED, .help = "the material right of the contact", .table = material_table},
    {"at", PARAMETER_NUMBER, offsetof(struct exact_impedance_match, at), "m", "0 mm",
     .help = "position of the contact at the start"},
    PARAMETER_END,
};

static const char *impact_material_name(const void *parameters, int index, const char **key)
{
    *key = index == SIDE_LEFT ? "left.material" : "right.material";
    return ((const struct exact_impedance_match *)parameters)->material[index].name;
}

/* What is given goes before what the material says. */
static void impact_take_material(void *parameters, int index, const struct material *material)
{
    struct exact_shock_material *own =
        &((struct exact_impedance_match *)parameters)->material[index];
    const struct eos_traits traits = eos_traits(&material->eos);
    own->density = isnan(own->density) ? material_density(material) : own->density;
    own->sound = isnan(own->sound) ? traits.shock_sound : own->sound;
    own->slope = isnan(own->slope) ? traits.shock_slope : own->slope;
}

/* Of the closing speed CLOSING the part w that the shock of the left material takes up. */
static double left_share(const struct exact_shock_material *left,
                         const struct exact_shock_material *right, double closing)
{
    double left_square = left->density * left->slope, right_square = right->density * right->slope;
    double a = left_square - right_square;
    double b =
        left->density * left->sound + right->density * right->sound + 2.0 * right_square * closing;
    double c = (right->density * right->sound + right_square * closing) * closing;
    /* The form without cancellation; a may have either sign or be zero. */
    return 2.0 * c / (b + sqrt(b * b + 4.0 * a * c));
}

static struct error *impact_solve(const void *parameters, void *solved)
{
    const struct exact_impedance_match *input = parameters;
    struct impact_problem *problem = solved;
    const struct exact_shock_material *left = &input->material[SIDE_LEFT];
    const struct exact_shock_material *right = &input->material[SIDE_RIGHT];
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
        const struct exact_shock_material *one = &input->material[side];
        if (isnan(one->density) || isnan(one->sound) || isnan(one->slope))
            return error_new(ERROR_INPUT,
                             "%s: give a `material` with `eos: mie-grueneisen`, or `density`, "
                             "`sound` and `slope`",
                             side == SIDE_LEFT ? "left" : "right");
    }
    double closing = left->velocity - right->velocity;
    if (!(closing >= 0.0))
        return error_new(ERROR_INPUT, "the bodies separate at %g m/s: there is no impact",
                         -closing);
    double share = left_share(left, right, closing);
    double jump[2] = {share, left_share(right, left, closing)};
    /* The mean of both sides' star values keeps the solution symmetric to the last bit. */
    double velocity =
        0.5 * ((left->velocity - jump[SIDE_LEFT]) + (right->velocity + jump[SIDE_RIGHT]));
    double pressure = 0.0;
    *problem = (struct impact_problem){.waves = {.at = input->at}};
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
        const struct exact_shock_material *material = &input->material[side];
        problem->shock_speed[side] = material->sound + material->slope * jump[side];
        pressure += 0.5 * material->density * problem->shock_speed[side] * jump[side];
    }
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
        const struct exact_shock_material *material = &input->material[side];
        double fast = problem->shock_speed[side];
        if (!(fast > jump[side]))
            return error_new(ERROR_INPUT,
                             "%s material: its shock relation gives no density at a particle "
                             "velocity of %g m/s",
                             side == SIDE_LEFT ? "left" : "right", jump[side]);
        struct wave wave = {.kind = WAVE_SHOCK};
        wave.head = wave.tail = material->velocity + side_direction(side) * fast;
        wave.behind.density = material->density * fast / (fast - jump[side]);
        wave.behind.velocity = velocity;
        wave.behind.pressure = pressure;
        wave.behind.energy = 0.5 * square(jump[side]);
        wave.behind.stress = -pressure;
        problem->waves.start[side].density = material->density;
        problem->waves.start[side].velocity = material->velocity;
        problem->waves.count[side] = 1;
        problem->waves.wave[side][0] = wave;
    }
    return NULL;
}

static int impact_numbers(const void *solved, double time, struct exact_number *numbers)
{
    const struct impact_problem *problem = solved;
    struct exact_state left = waves_star(solved, SIDE_LEFT), right = waves_star(solved, SIDE_RIGHT);
    struct number_list list = {numbers, 0};
    number_add(&list, "star pressure", "Pa", left.pressure);
    number_add(&list, "star velocity", "m/s", left.velocity);
    number_add(&list, "left star density", "kg/m^3", left.density);
    number_add(&list, "right star density", "kg/m^3", right.density);
    number_add(&list, "left star energy", "J/kg", left.energy);
    number_add(&list, "right star energy", "J/kg", right.energy);
    number_add(&list, "left shock speed in the material", "m/s", problem->shock_speed[SIDE_LEFT]);
    number_add(&list, "right shock speed in the material", "m/s", problem->shock_speed[SIDE_RIGHT]);
    waves_add_numbers(&problem->waves, time, &list);
    return list.count;
}

const struct exact_class exact_impedance_match_class = {
    .size = sizeof(struct impact_problem),
    .material_name = impact_material_name,
    .take_material = impact_take_material,
    .solve = impact_solve,
    .sample = waves_sample,
    .star = waves_star,
    .numbers = impact_numbers,
    .contact = waves_contact,
};
