/* The keys of output.maps.NAME; model/maps.c keeps what they say. */
#include <string.h>

#include "case/checking.h"
#include "case/internal.h"

static const struct parameter over_table[] = {
    PARAMETER(TEXT, struct map_over, field, OPTIONAL, "a field or a component of one"),
    PARAMETER(QUANTITY, struct map_over, above, OPTIONAL, "the value that counts as none"),
    PARAMETER_END,
};

const struct parameter case_map_table[] = {
    PARAMETER(TEXT, struct map_input, peak, OPTIONAL,
              "a field or a component of one (`velocity.x`), whose largest value is kept"),
    PARAMETER(TABLE, struct map_input, arrival, OPTIONAL,
              "the time at which the field is first at `above` or over it", .table = over_table),
    PARAMETER(TABLE, struct map_input, impulse, OPTIONAL,
              "the largest value until now of the integral over the time of the field less `above`",
              .table = over_table),
    PARAMETER_END,
};

void case_check_map(struct checking *checking, int index)
{
    const struct map_input *map = case_map(checking->input, index);
    const int given = !!map->peak + !!map->arrival.field + !!map->impulse.field;
    const bool half = (map->arrival.field != NULL) == isnan(map->arrival.above.value) ||
                      (map->impulse.field != NULL) == isnan(map->impulse.above.value);
    if (half)
        case_wrong(checking, "", "arrival and impulse need both `field` and `above`");
    else if (given != 1)
        case_wrong(checking, "", "give one of peak, arrival and impulse");
    if (strpbrk(checking->name, ". ") || checking->name[0] == '\0')
        case_wrong(checking, "", "the map is a field: its name has no dots and blanks");
    else if (strlen(checking->name) >= MAP_NAME)
        case_wrong(checking, "", "a name of a map has at most %d bytes", MAP_NAME - 1);
    if (index == MAPS_MOST)
        case_wrong(checking, "", "there can be at most %d maps", MAPS_MOST);
}
