/* The contact of two bodies at a node of the material point method. */
#include "dice.h"

#include "mpm/contact.h"

static const struct vec3 along_x = {1.0, 0.0, 0.0};

static void equal_bodies_head_on_stop_each_other(void **state)
{
    (void)state;
    const struct contact_rule rule = {0.0, true};
    const struct contact_side a = {2.0, {14.0, 0.0, 0.0}}, b = {2.0, {-14.0, 0.0, 0.0}};
    const struct contact_push push = contact_push(a, b, along_x, rule);
    assert_near(a.momentum.x + push.impulse.x, 0.0, 1e-14);
    assert_near(b.momentum.x - push.impulse.x, 0.0, 1e-14);
    assert_int_equal(push.state, CONTACT_STICKS);
}

static void without_friction_momenta_along_the_surface_stay(void **state)
{
    (void)state;
    struct dice dice = {3};
    const struct contact_rule rule = {0.0, true};
    for (int trial = 0; trial < 100; trial++) {
        const struct contact_side a = {dice_between(&dice, 0.1, 3.0),
                                       {5.0, dice_between(&dice, -9.0, 9.0), 2.0}},
                                  b = {dice_between(&dice, 0.1, 3.0),
                                       {-1.0, dice_between(&dice, -9.0, 9.0), -4.0}};
        const struct contact_push push = contact_push(a, b, along_x, rule);
        assert_true(push.impulse.y == 0.0 && push.impulse.z == 0.0);
        assert_near((a.momentum.x + push.impulse.x) / a.mass,
                    (b.momentum.x - push.impulse.x) / b.mass, 1e-13);
    }
}

static void with_endless_friction_both_get_the_velocity_of_one_field(void **state)
{
    (void)state;
    const struct contact_rule rule = {(double)INFINITY, true};
    const struct contact_side a = {2.0, {5.0, 3.0, -1.0}}, b = {3.0, {-4.0, 1.0, 2.0}};
    const struct contact_push push = contact_push(a, b, along_x, rule);
    const struct vec3 one = vec3_scale(1.0 / 5.0, vec3_add(a.momentum, b.momentum));
    const struct vec3 u = vec3_scale(1.0 / a.mass, vec3_add(a.momentum, push.impulse)),
                      v = vec3_scale(1.0 / b.mass, vec3_sub(b.momentum, push.impulse));
    assert_near(u.x, one.x, 1e-15);
    assert_near(u.y, one.y, 1e-15);
    assert_near(v.y, one.y, 1e-15);
    assert_near(v.z, one.z, 1e-15);
}

static void friction_is_no_more_than_its_share_of_the_push(void **state)
{
    (void)state;
    const struct contact_rule rule = {0.25, true};
    const struct contact_side a = {1.0, {4.0, 8.0, 0.0}}, b = {1.0, {-4.0, -8.0, 0.0}};
    const struct contact_push push = contact_push(a, b, along_x, rule);
    assert_int_equal(push.state, CONTACT_SLIPS);
    assert_near(push.impulse.x, -4.0, 1e-15);
    assert_near(push.impulse.y, -1.0, 1e-15);
}

static void bodies_that_part_are_left_alone(void **state)
{
    (void)state;
    const struct contact_side a = {1.0, {-4.0, 8.0, 0.0}}, b = {1.0, {4.0, -8.0, 0.0}};
    struct contact_rule rule = {0.25, true};
    assert_int_equal(contact_push(a, b, along_x, rule).state, CONTACT_NONE);
    assert_true(contact_push(a, b, along_x, rule).impulse.y == 0.0);
    rule.opens = false; /* it carries tension */
    assert_near(contact_push(a, b, along_x, rule).impulse.x, 4.0, 1e-15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_bodies_head_on_stop_each_other),
        cmocka_unit_test(without_friction_momenta_along_the_surface_stay),
        cmocka_unit_test(with_endless_friction_both_get_the_velocity_of_one_field),
        cmocka_unit_test(friction_is_no_more_than_its_share_of_the_push),
        cmocka_unit_test(bodies_that_part_are_left_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
