/* The keys of a material. */
#include "case/internal.h"

/* Of struct heat; NAN where a case says nothing. */
static const struct parameter heat_table[] = {
    PARAMETER(NUMBER, struct heat, capacity, OPTIONAL,
              "specific heat at constant volume; default: that of the strength, if it has one",
              .unit = "J/(kg*K)", .below = INFINITY),
    PARAMETER(NUMBER, struct heat, conductivity, OPTIONAL, "thermal conductivity",
              .unit = "W/(m*K)", .below = INFINITY, .closed = true),
    PARAMETER(NUMBER, struct heat, temperature, "293 K",
              "temperature of the state without pressure and energy", .unit = "K",
              .below = INFINITY),
    PARAMETER_END,
};

static const struct parameter afterburn_table[] = {
    PARAMETER(NUMBER, struct afterburn, energy, OPTIONAL,
              "Q: heat per mass of the products; default: none", .unit = "J/kg", .below = INFINITY,
              .closed = true),
    PARAMETER(NUMBER, struct afterburn, rate, OPTIONAL,
              "a of dl/dt = a (1 - l)^m (p/0.1 MPa)^n, l the fraction that has burnt",
              .unit = "1/s", .below = INFINITY, .closed = true),
    PARAMETER(NUMBER, struct afterburn, depletion, "0", "m: exponent of 1 - l", .below = INFINITY,
              .closed = true),
    PARAMETER(NUMBER, struct afterburn, power, "0", "n: exponent of the pressure",
              .below = INFINITY, .closed = true),
    PARAMETER(NUMBER, struct afterburn, slow_energy, OPTIONAL,
              "heat per mass of the products in a second stage, after the first; default: none",
              .unit = "J/kg", .below = INFINITY, .closed = true),
    PARAMETER(NUMBER, struct afterburn, slow_rate, OPTIONAL,
              "rate of the second stage: dl/dt = rate (1 - l)", .unit = "1/s", .below = INFINITY,
              .closed = true),
    PARAMETER(NUMBER, struct afterburn, air, "0",
              "mass of air that a mass of products takes to burn; burning ends when that of the "
              "domain at the start is used up; default: there is always enough",
              .below = INFINITY, .closed = true),
    PARAMETER(NUMBER, struct afterburn, mixing, OPTIONAL,
              "rate at which products mix with the air after the first stage, to a gas of the "
              "pressure that equilibrium gives the room; in place of a second stage; default: not "
              "at all",
              .unit = "1/s", .below = INFINITY),
    PARAMETER(NUMBER, struct afterburn, load, OPTIONAL,
              "mass of products over the volume of the room in which they mix; default: that of "
              "the domain",
              .unit = "kg/m^3", .below = INFINITY),
    PARAMETER_END,
};

static const struct parameter composition_table[] = {
    PARAMETER(NUMBER, struct composition, carbon, "0", "atoms of a formula unit", .below = INFINITY,
              .closed = true),
    PARAMETER(NUMBER, struct composition, hydrogen, "0", "atoms of a formula unit",
              .below = INFINITY, .closed = true),
    PARAMETER(NUMBER, struct composition, nitrogen, "0", "atoms of a formula unit",
              .below = INFINITY, .closed = true),
    PARAMETER(NUMBER, struct composition, oxygen, "0", "atoms of a formula unit", .below = INFINITY,
              .closed = true),
    PARAMETER(NUMBER, struct composition, formation, OPTIONAL,
              "heat of formation per mass, at 25 degrees Celsius; default: 0", .unit = "J/kg"),
    PARAMETER_END,
};

const struct parameter case_material_table[] = {
    PARAMETER(
        TEXT, struct material_input, library, OPTIONAL,
        "a material of the library (`bolide materials`); other keys beside it replace its values"),
    PARAMETER(TEXT, struct material_input, description, OPTIONAL, "one line about the material",
              .change = CHANGE_FREELY),
    PARAMETER(TEXT, struct material_input, source, OPTIONAL, "source of its values",
              .change = CHANGE_FREELY),
    PARAMETER(ONE_OF, struct material_input, eos, REQUIRED, "the equation of state",
              .kind_of_thing = "eos"),
    PARAMETER(ONE_OF, struct material_input, strength, OPTIONAL,
              "the strength; default: none, a fluid", .kind_of_thing = "strength"),
    PARAMETER(ONE_OF, struct material_input, failure, OPTIONAL,
              "how a solid breaks; default: none, it bears any tension and strain",
              .kind_of_thing = "failure", .change_within = CHANGE_FROM_HERE),
    PARAMETER(ONE_OF, struct material_input, burn, OPTIONAL,
              "how an explosive turns into the products of its equation of state; default: burnt "
              "from the start",
              .kind_of_thing = "burn"),
    PARAMETER(TABLE, struct material_input, afterburn, OPTIONAL,
              "how products burn in the air around them, with the solver gas; default: not at all",
              .table = afterburn_table),
    PARAMETER(TABLE, struct material_input, composition, OPTIONAL,
              "what an explosive consists of, for the equilibrium of its products in a room",
              .table = composition_table),
    PARAMETER(TABLE, struct material_input, heat, OPTIONAL,
              "its thermal constants, needed for temperatures", .table = heat_table),
    PARAMETER(
        NUMBER, struct material_input, tensile_strength, OPTIONAL,
        "the mean tension above which the run gives a warning, without any effect on results; "
        "default: the tension limit of its models, else a twentieth of the bulk modulus",
        .unit = "Pa", .below = INFINITY, .change = CHANGE_FREELY),
    PARAMETER_END,
};
