/* Sampling and listing of a self-similar solution; see waves.h. */
#include "exact/waves.h"

/* Names of a wave's fronts: the whole of a jump or the head of a fan, and a fan's tail. */
struct wave_names {
    const char *head_speed, *tail_speed, *head_place, *tail_place;
};

static const struct wave_names names_of[WAVE_KINDS][2] = {
    [WAVE_SHOCK] = {{"left shock speed", NULL, "left shock place", NULL},
                    {"right shock speed", NULL, "right shock place", NULL}},
    [WAVE_FAN] = {{"left fan head speed", "left fan tail speed", "left fan head place",
                   "left fan tail place"},
                  {"right fan head speed", "right fan tail speed", "right fan head place",
                   "right fan tail place"}},
    [WAVE_ELASTIC] = {{"left elastic speed", NULL, "left elastic place", NULL},
                      {"right elastic speed", NULL, "right elastic place", NULL}},
    [WAVE_ELASTIC_FAN] = {{"left elastic head speed", "left elastic tail speed",
                           "left elastic head place", "left elastic tail place"},
                          {"right elastic head speed", "right elastic tail speed",
                           "right elastic head place", "right elastic tail place"}},
    [WAVE_PLASTIC] = {{"left plastic speed", NULL, "left plastic place", NULL},
                      {"right plastic speed", NULL, "right plastic place", NULL}},
    [WAVE_PLASTIC_FAN] = {{"left plastic head speed", "left plastic tail speed",
                           "left plastic head place", "left plastic tail place"},
                          {"right plastic head speed", "right plastic tail speed",
                           "right plastic head place", "right plastic tail place"}},
};

struct exact_state waves_star(const void *solved, enum exact_side side)
{
    const struct waves *waves = solved;
    int count = waves->count[side];
    return count > 0 ? waves->wave[side][count - 1].behind : waves->start[side];
}

double waves_contact(const void *solved, double time)
{
    const struct waves *waves = solved;
    return waves->at + waves_star(waves, SIDE_LEFT).velocity * time;
}

struct exact_state waves_sample(const void *solved, enum exact_side side, double x, double time)
{
    const struct waves *waves = solved;
    struct exact_state state = waves->start[side];
    if (time <= 0.0)
        return state;
    double speed = (x - waves->at) / time;
    double direction = side_direction(side);
    for (int i = 0; i < waves->count[side]; i++) {
        const struct wave *wave = &waves->wave[side][i];
        if (direction * speed >= direction * wave->head)
            return state;
        if (direction * speed > direction * wave->tail)
            return waves->in_fan(solved, side, speed);
        state = wave->behind;
    }
    return state;
}

void number_add(struct number_list *list, const char *name, const char *unit, double value)
{
    assert(list->count < EXACT_NUMBERS);
    list->numbers[list->count++] = (struct exact_number){name, unit, value};
}

static void add_fronts(const struct waves *waves, int side, double time, struct number_list *list)
{
    for (int i = 0; i < waves->count[side]; i++) {
        const struct wave *wave = &waves->wave[side][i];
        const struct wave_names *names = &names_of[wave->kind][side];
        if (time > 0.0) {
            number_add(list, names->head_place, "m", waves->at + wave->head * time);
            if (names->tail_place)
                number_add(list, names->tail_place, "m", waves->at + wave->tail * time);
        } else {
            number_add(list, names->head_speed, "m/s", wave->head);
            if (names->tail_speed)
                number_add(list, names->tail_speed, "m/s", wave->tail);
        }
    }
}

void waves_add_numbers(const struct waves *waves, double time, struct number_list *list)
{
    add_fronts(waves, SIDE_LEFT, 0.0, list);
    add_fronts(waves, SIDE_RIGHT, 0.0, list);
    if (time > 0.0) {
        add_fronts(waves, SIDE_LEFT, time, list);
        number_add(list, "contact place", "m", waves_contact(waves, time));
        add_fronts(waves, SIDE_RIGHT, time, list);
    }
}
