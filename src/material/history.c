/* The names of history slots; see history.h. */
#include "material/history.h"

#define HISTORY_SLOT(slot, unit, help, range) {#slot, unit, help, range},

const struct history_slot history_slots[POINT_HISTORY] = {HISTORY_LIST(HISTORY_SLOT)};
