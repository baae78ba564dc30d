/* A run before its particles: walls, contact groups and their laws, phases. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/clock.h"
#include "build_case.h"
#include "model/particles/population.h"
#include "particle/particles.h"

enum { BODIES = 30, CONTACTS = 30 };

/* A case of BODIES bodies with the given contacts or walls; nothing of it needs a shape. */
struct workshop {
    struct simulation_case input;
    char *names[BODIES];
    struct body_input bodies[BODIES];
    struct contact_input contacts[CONTACTS];
    struct boundary_input walls[3];
};

static void open_workshop(struct workshop *w, int bodies)
{
    *w = (struct workshop){.input = {.dimension = 2}};
    for (int i = 0; i < BODIES; i++)
        w->names[i] = "a";
    w->input.bodies = (struct named_map){bodies, w->names, w->bodies, {0}};
    w->input.contacts = (struct named_map){0, w->names, w->contacts, {0}};
    w->input.boundaries = (struct named_map){0, w->names, w->walls, {0}};
}

static void add_contact(struct workshop *w, int first, int second, int shear, int tension)
{
    w->contacts[w->input.contacts.count++] =
        (struct contact_input){.shear = shear, .tension = tension, .body = {first, second}};
}

static void add_wall(struct workshop *w, int axis, enum face_side side, double at)
{
    w->walls[w->input.boundaries.count++] =
        (struct boundary_input){.axis = axis, .side = side, .at = at, .place = at};
}

/* The law between two bodies, as a solver finds it. */
static int law_between(const struct simulation *s, int first, int second)
{
    return s->problem->law[s->problem->group_of_body[first]][s->problem->group_of_body[second]];
}

static void assert_refused(const struct workshop *w, const char *words)
{
    const struct ranks alone = ranks_alone();
    struct simulation simulation;
    struct error *error = simulation_create(&w->input, &alone, 1, &simulation);
    assert_non_null(error);
    assert_int_equal(error_kind(error), ERROR_INPUT);
    if (!strstr(error_message(error, 0), words))
        fail_msg("\"%s\" does not tell of \"%s\"", error_message(error, 0), words);
    error_free(error);
}

static void every_pair_of_bodies_has_the_law_of_its_contact(void **state)
{
    (void)state;
    const struct ranks alone = ranks_alone();
    struct workshop w;
    open_workshop(&w, 5);
    add_contact(&w, 0, 1, SHEAR_SLIP, TENSION_CARRIED);
    add_contact(&w, 3, 1, SHEAR_STICK, TENSION_NONE);
    add_contact(&w, 3, 4, SHEAR_SLIP, TENSION_NONE);
    struct simulation s;
    assert_null(simulation_create(&w.input, &alone, 2, &s));
    for (int i = 0; i < 5; i++)
        for (int j = 0; j < 5; j++) {
            int wanted = 0;
            for (int k = 0; k < w.input.contacts.count; k++) {
                const struct contact_input *c = &w.contacts[k];
                if ((c->body[0] == i && c->body[1] == j) || (c->body[0] == j && c->body[1] == i))
                    wanted = (c->shear == SHEAR_SLIP ? LAW_SLIP : 0) |
                             (c->tension == TENSION_NONE ? LAW_NO_TENSION : 0);
            }
            assert_int_equal(law_between(&s, i, j), wanted);
        }
    assert_int_equal(s.threads, 2);
    simulation_destroy(&s);
}

static void bodies_without_contacts_share_one_group(void **state)
{
    (void)state;
    const struct ranks alone = ranks_alone();
    struct workshop w;
    open_workshop(&w, BODIES);
    struct simulation s;
    assert_null(simulation_create(&w.input, &alone, 1, &s));
    for (int i = 0; i < BODIES; i++)
        assert_int_equal(s.problem->group_of_body[i], 0);
    simulation_destroy(&s);
}

static void many_grains_that_slip_on_one_plate_share_a_group(void **state)
{
    (void)state;
    const struct ranks alone = ranks_alone();
    struct workshop w;
    open_workshop(&w, BODIES);
    for (int i = 1; i < BODIES; i++)
        add_contact(&w, i, 0, SHEAR_SLIP, TENSION_CARRIED);
    struct simulation s;
    assert_null(simulation_create(&w.input, &alone, 1, &s));
    for (int i = 1; i < BODIES; i++) {
        assert_int_equal(law_between(&s, 0, i), LAW_SLIP);
        assert_int_equal(law_between(&s, 1, i), 0);
    }
    simulation_destroy(&s);
}

static void grains_that_slip_on_each_other_never_share_a_group(void **state)
{
    (void)state;
    const struct ranks alone = ranks_alone();
    struct workshop w;
    open_workshop(&w, CONTACT_GROUPS);
    for (int i = 0; i + 1 < CONTACT_GROUPS; i++)
        add_contact(&w, i, i + 1, SHEAR_SLIP, TENSION_CARRIED);
    struct simulation s;
    assert_null(simulation_create(&w.input, &alone, 1, &s));
    for (int i = 0; i < CONTACT_GROUPS; i++)
        for (int j = 0; j < CONTACT_GROUPS; j++)
            assert_int_equal(law_between(&s, i, j), i - j == 1 || j - i == 1 ? LAW_SLIP : 0);
    simulation_destroy(&s);
    w.input.bodies.count++;
    assert_refused(&w, "contacts: the bodies fall into more than 16 groups");
}

static void a_contact_named_twice_or_with_itself_is_refused(void **state)
{
    (void)state;
    struct workshop w;
    open_workshop(&w, 3);
    add_contact(&w, 0, 1, SHEAR_SLIP, TENSION_CARRIED);
    add_contact(&w, 1, 0, SHEAR_STICK, TENSION_CARRIED);
    assert_refused(&w, "another contact names the same two bodies");
    w.input.contacts.count = 0;
    add_contact(&w, 2, 2, SHEAR_SLIP, TENSION_CARRIED);
    assert_refused(&w, "two different bodies");
}

static void walls_become_mirrors(void **state)
{
    (void)state;
    const struct ranks alone = ranks_alone();
    struct workshop w;
    open_workshop(&w, 1);
    add_wall(&w, 0, SIDE_LOW, -1.0);
    add_wall(&w, 0, SIDE_HIGH, 2.0);
    add_wall(&w, 1, SIDE_HIGH, 3.0);
    struct simulation s;
    assert_null(simulation_create(&w.input, &alone, 1, &s));
    assert_true(s.problem->images.low[0] == -1.0 && s.problem->images.high[0] == 2.0 &&
                s.problem->images.high[1] == 3.0);
    assert_true(isnan(s.problem->images.low[1]) && isnan(s.problem->images.low[2]) &&
                isnan(s.problem->images.high[2]));
    simulation_destroy(&s);
}

static void seconds_of_a_phase_add_up_and_those_of_blocks_are_work(void **state)
{
    (void)state;
    struct simulation s = {0};
    const double begin = clock_seconds();
    simulation_start_phase(&s);
    simulation_end_phase(&s, PHASE_SHARED, "lists");
    simulation_end_phase(&s, PHASE_BLOCKS, "pairs");
    while (clock_seconds() - begin < 1e-4)
        continue;
    simulation_end_phase(&s, PHASE_SHARED, "lists");
    assert_int_equal(s.phases, 2);
    assert_true(s.phase[0].seconds > 0.0 && s.phase[1].seconds >= 0.0);
    assert_true(s.phase[0].seconds + s.phase[1].seconds <= s.phase_end - begin);
    assert_true(s.partition.work == s.phase[1].seconds);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_pair_of_bodies_has_the_law_of_its_contact),
        cmocka_unit_test(bodies_without_contacts_share_one_group),
        cmocka_unit_test(many_grains_that_slip_on_one_plate_share_a_group),
        cmocka_unit_test(grains_that_slip_on_each_other_never_share_a_group),
        cmocka_unit_test(a_contact_named_twice_or_with_itself_is_refused),
        cmocka_unit_test(walls_become_mirrors),
        cmocka_unit_test(seconds_of_a_phase_add_up_and_those_of_blocks_are_work),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
