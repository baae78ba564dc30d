/* The pressure of a closed room; see closed_room.h. Beside it the fit to measurements with TNT of
 * H. R. W. Weibull, Pressures recorded in partially closed chambers at explosion of TNT charges,
 * Ann. N. Y. Acad. Sci. 152 (1968) 357, recalled: 2.25 MPa (W/V)^0.72 up to 5 kg/m^3. */
#include "exact/closed_room.h"

#include "exact/waves.h"
#include "material/equilibrium.h"
#include "material/material.h"

static const double WEIBULL = 2.25e6, WEIBULL_EXPONENT = 0.72, WEIBULL_MOST = 5.0; /* kg/m^3 */

struct closed_room {
    struct exact_closed_room room;
    struct room_gas gas;
};

const struct parameter exact_closed_room_table[] = {
    PARAMETER(
        TEXT, struct exact_closed_room, explosive, REQUIRED,
        "an explosive with a `composition`: a material of the case; in `bolide exact`, of the "
        "library"),
    PARAMETER(NUMBER, struct exact_closed_room, load, REQUIRED,
              "mass of the explosive over the volume of the room", .unit = "kg/m^3",
              .below = INFINITY),
    PARAMETER(NUMBER, struct exact_closed_room, pressure, "101.325 kPa",
              "pressure of the air before", .unit = "Pa", .below = INFINITY),
    PARAMETER(NUMBER, struct exact_closed_room, temperature, "288.15 K",
              "temperature of the air before", .unit = "K", .above = 100.0, .below = 1000.0),
    PARAMETER_END,
};

static const char *room_material_name(const void *parameters, int index, const char **key)
{
    *key = "explosive";
    return index ? NULL : ((const struct exact_closed_room *)parameters)->explosive;
}

static void room_take_material(void *parameters, int index, const struct material *material)
{
    (void)index;
    ((struct exact_closed_room *)parameters)->of = material->composition;
}

static struct error *room_solve(const void *parameters, void *solved)
{
    struct closed_room *closed = solved;
    closed->room = *(const struct exact_closed_room *)parameters;
    const struct composition *of = &closed->room.of;
    const struct room room = {
        closed->room.load,
        equilibrium_density_of_air(closed->room.pressure, closed->room.temperature),
        closed->room.temperature};
    if (!composition_is_known(of))
        return error_new(ERROR_INPUT, "explosive: \"%s\" has no `composition`",
                         closed->room.explosive);
    closed->gas = equilibrium_of_room(of, &room);
    return NULL;
}

static struct exact_state room_sample(const void *solved, enum exact_side side, double x,
                                      double time)
{
    const struct closed_room *closed = solved;
    (void)side;
    (void)x;
    (void)time;
    return (struct exact_state){NAN, NAN, closed->gas.pressure, NAN, NAN, NAN, NAN, NAN};
}

static int room_numbers(const void *solved, double time, struct exact_number *numbers)
{
    const struct closed_room *closed = solved;
    struct number_list list = {numbers, 0};
    (void)time;
    number_add(&list, "load", "kg/m^3", closed->room.load);
    number_add(&list, "gas pressure", "Pa", closed->gas.pressure);
    number_add(&list, "overpressure", "Pa", closed->gas.pressure - closed->room.pressure);
    number_add(&list, "gas temperature", "K", closed->gas.temperature);
    if (closed->room.load <= WEIBULL_MOST)
        number_add(&list, "overpressure by Weibull's fit for TNT", "Pa",
                   WEIBULL * pow(closed->room.load, WEIBULL_EXPONENT));
    return list.count;
}

const struct exact_class exact_closed_room_class = {
    .size = sizeof(struct closed_room),
    .material_name = room_material_name,
    .take_material = room_take_material,
    .solve = room_solve,
    .sample = room_sample,
    .numbers = room_numbers,
    .known = EXACT_PRESSURE,
};
