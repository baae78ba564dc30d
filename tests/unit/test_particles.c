/* The particle store: append, delete, commit, the order of storage, the hash, and the visitor. */
#include "dice.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model/particles/population.h"
#include "parallel/block.h"
#include "particle/particles.h"

static const struct field_declaration more[] = {
    {"colour", "", "a field of a solver", NUMBER_UINT16, 2, FIELD_STATE},
    {"warmth", "K", "another", NUMBER_DOUBLE, 1, FIELD_STATE},
    {"scratch", NULL, "not of the state", NUMBER_DOUBLE, 3, FIELD_DERIVED},
};

/* A value of its own for every number of particle ID, so that a mixed-up field shows. */
static double value_of(uint64_t id, int field, int component)
{
    struct dice dice = {id * 1000 + (uint64_t)field * 10 + (uint64_t)component};
    return dice_between(&dice, -10.0, 10.0);
}

static size_t row_bytes(const struct field *field)
{
    return number_size(field->declaration.number) * (size_t)field->declaration.components;
}

static void fill(struct particles *p, int32_t i, uint64_t id)
{
    for (int k = 0; k < p->fields; k++) {
        struct field *field = &p->field[k];
        for (int c = 0; c < field->declaration.components; c++) {
            double value = value_of(id, k, c);
            if (field->declaration.number == NUMBER_UINT16)
                ((uint16_t *)field->data)[i * field->declaration.components + c] =
                    (uint16_t)(100.0 * fabs(value));
            else if (field->declaration.number == NUMBER_DOUBLE)
                ((double *)field->data)[i * field->declaration.components + c] = value;
        }
    }
    p->id[i] = id;
    p->material[i] = (uint16_t)(id % 3);
}

/* All fields of particle I still are what fill gave to its id. */
static void assert_whole(const struct particles *p, int32_t i)
{
    for (int k = 3; k < p->fields; k++) {
        const struct field *field = &p->field[k];
        for (int c = 0; c < field->declaration.components; c++) {
            double value = value_of(p->id[i], k, c);
            int at = i * field->declaration.components + c;
            if (field->declaration.number == NUMBER_UINT16)
                assert_int_equal(((uint16_t *)field->data)[at], (uint16_t)(100.0 * fabs(value)));
            else
                assert_true(((double *)field->data)[at] == value);
        }
    }
    assert_int_equal(p->material[i], p->id[i] % 3);
}

static void make(struct particles *p, int dimension, double cell, int count)
{
    assert_success(particles_create(dimension, cell, more, COUNT_OF(more), p));
    int32_t first;
    assert_success(particles_append(p, count, &first));
    for (int i = 0; i < count; i++)
        fill(p, first + i, (uint64_t)(count - i) * 77 % 1009);
    assert_success(particles_commit(p));
}

static void appended_particles_are_zero_and_wait_for_the_commit(void **state)
{
    (void)state;
    struct particles p;
    make(&p, 2, 0.5, 100);
    int32_t first;
    assert_success(particles_append(&p, 3, &first));
    assert_int_equal(first, 100);
    assert_int_equal(p.count, 100);
    assert_int_equal(p.pending, 3);
    for (int k = 0; k < p.fields; k++) {
        const char *data = (const char *)p.field[k].data + (size_t)first * row_bytes(&p.field[k]);
        for (size_t byte = 0; byte < 3 * row_bytes(&p.field[k]); byte++)
            assert_int_equal(data[byte], 0);
    }
    int32_t second;
    assert_success(particles_append(&p, 2, &second));
    assert_int_equal(second, 103);
    for (int32_t i = first; i < second + 2; i++)
        fill(&p, i, 5000 + (uint64_t)i);
    assert_success(particles_commit(&p));
    assert_int_equal(p.count, 105);
    assert_int_equal(p.pending, 0);
    int found = 0;
    for (int32_t i = 0; i < p.count; i++) {
        assert_whole(&p, i);
        found += p.id[i] > 5000;
    }
    assert_int_equal(found, 5);
    particles_destroy(&p);
}

static void deleted_particles_go_at_the_commit_and_the_others_stay_whole(void **state)
{
    (void)state;
    struct particles p;
    make(&p, 3, 3.0, 200);
    int32_t first;
    assert_success(particles_append(&p, 1, &first)); /* one that is born and dies at once */
    fill(&p, first, 9999);
    particles_delete(&p, first);
    int deleted = 0;
    for (int32_t i = 0; i < p.count; i++)
        if (p.id[i] % 4 == 0) {
            particles_delete(&p, i);
            deleted++;
        }
    assert_int_equal(p.count, 200);
    assert_success(particles_commit(&p));
    assert_int_equal(p.count, 200 - deleted);
    for (int32_t i = 0; i < p.count; i++) {
        assert_int_not_equal(p.id[i] % 4, 0);
        assert_int_not_equal(p.id[i], 9999);
        assert_whole(&p, i);
    }
    for (int32_t i = 0; i < p.count; i++)
        particles_delete(&p, i);
    assert_success(particles_commit(&p));
    assert_int_equal(p.count, 0);
    assert_int_equal(p.blocks, 0);
    particles_destroy(&p);
}

static void a_store_grows_to_many_particles_by_small_appends(void **state)
{
    (void)state;
    struct particles p;
    make(&p, 1, 0.1, 1);
    for (int k = 0; k < 300; k++) {
        int32_t first;
        assert_success(particles_append(&p, k % 7, &first));
        for (int i = 0; i < k % 7; i++)
            fill(&p, first + i, 2000 + (uint64_t)k * 10 + (uint64_t)i);
        if (k % 13 == 0)
            assert_success(particles_commit(&p));
    }
    assert_success(particles_commit(&p));
    for (int32_t i = 0; i < p.count; i++)
        assert_whole(&p, i);
    assert_ptr_equal(particles_field(&p, "position"), p.position);
    assert_ptr_equal(particles_field(&p, "warmth"), p.field[p.fields - 2].data);
    particles_destroy(&p);
}

/* The cell of a particle along an axis, and what it sorts by. */
struct sort_place {
    uint64_t block;
    uint16_t material;
    int64_t cell;
    uint64_t id;
};

static struct sort_place place_of(const struct particles *p, int32_t i)
{
    static const int cells[] = {0, 64, 8, 4};
    int64_t at[3] = {0, 0, 0}, cell = 0;
    for (int axis = 0; axis < p->dimension; axis++) {
        int64_t index = (int64_t)floor(p->position[i][axis] / p->cell);
        at[axis] = (int64_t)floor((double)index / cells[p->dimension]);
        cell = cell * cells[p->dimension] + index - at[axis] * cells[p->dimension];
    }
    return (struct sort_place){block_key(at), p->material[i], cell, p->id[i]};
}

static int compare(struct sort_place a, struct sort_place b)
{
    if (a.block != b.block)
        return a.block < b.block ? -1 : 1;
    if (a.material != b.material)
        return a.material < b.material ? -1 : 1;
    if (a.cell != b.cell)
        return a.cell < b.cell ? -1 : 1;
    return a.id < b.id ? -1 : a.id > b.id;
}

static void storage_is_ordered_by_block_material_cell_and_id(void **state)
{
    (void)state;
    for (int dimension = 1; dimension <= 3; dimension++)
        for (double cell = 0.03; cell < 30.0; cell *= 4.0) {
            struct particles p;
            make(&p, dimension, cell, 600);
            int32_t next = 0;
            for (int32_t b = 0; b < p.blocks; b++) {
                assert_int_equal(p.block[b].first, next);
                assert_true(p.block[b].count > 0);
                next += p.block[b].count;
                for (int32_t i = p.block[b].first; i < next; i++)
                    assert_true(place_of(&p, i).block == p.block[b].key);
            }
            assert_int_equal(next, p.count);
            for (int32_t i = 1; i < p.count; i++)
                assert_true(compare(place_of(&p, i - 1), place_of(&p, i)) < 0);
            for (int32_t i = 0; i < p.count; i++)
                assert_whole(&p, i);
            particles_destroy(&p);
        }
}

static void a_block_key_gives_its_coordinates_back(void **state)
{
    (void)state;
    struct dice dice = {1};
    for (int k = 0; k < 1000; k++) {
        int64_t at[3], back[3];
        for (int axis = 0; axis < 3; axis++)
            at[axis] = dice_below(&dice, 1 << 21) - (1 << 20);
        block_coordinates(block_key(at), back);
        assert_memory_equal(at, back, sizeof at);
    }
}

static void what_flies_off_is_still_stored(void **state)
{
    (void)state;
    struct particles p;
    make(&p, 3, 1e-3, 50);
    p.position[3][0] = 1e300;
    p.position[7][1] = -1e300;
    p.position[9][2] = 1e18;
    uint64_t hash = particles_hash(&p);
    assert_success(particles_sort(&p));
    assert_int_equal(p.count, 50);
    assert_true(particles_hash(&p) == hash);
    particles_destroy(&p);
}

static void the_hash_is_the_same_for_any_order_of_storage(void **state)
{
    (void)state;
    struct particles p;
    make(&p, 3, 1.0, 500);
    uint64_t hash = particles_hash(&p);
    for (double cell = 0.05; cell < 100.0; cell *= 3.0) {
        p.cell = cell;
        assert_success(particles_sort(&p));
        assert_true(particles_hash(&p) == hash);
    }
    particles_destroy(&p);
}

static void the_hash_sees_every_bit_of_the_state_and_nothing_else(void **state)
{
    (void)state;
    struct particles p;
    make(&p, 2, 1.0, 20);
    uint64_t hash = particles_hash(&p);
    for (int k = 0; k < p.fields; k++) {
        size_t bytes = row_bytes(&p.field[k]);
        unsigned char *data = (unsigned char *)p.field[k].data + 11 * bytes;
        bool of_state = p.field[k].declaration.kind & FIELD_STATE;
        for (size_t bit = 0; bit < 8 * bytes; bit++) {
            data[bit / 8] ^= (unsigned char)(1u << bit % 8);
            assert_true((particles_hash(&p) != hash) == of_state);
            data[bit / 8] ^= (unsigned char)(1u << bit % 8);
        }
    }
    /* Two particles that swap a value are not the same state. */
    double other = p.energy[4];
    p.energy[4] = p.energy[5];
    p.energy[5] = other;
    assert_true(particles_hash(&p) != hash);
    particles_destroy(&p);
}

/* A visitor that keeps arrays in memory, or gives them back. */
struct kept {
    char name[64];
    void *data;
    size_t bytes;
};
struct keeper {
    struct visitor visitor;
    bool loading;
    int count;
    struct kept kept[PARTICLES_FIELDS + 1];
};

static struct error *keep(struct visitor *visitor, const char *name, enum number number, void *data,
                          int64_t count, int components)
{
    struct keeper *keeper = (struct keeper *)visitor;
    size_t bytes = number_size(number) * (size_t)count * (size_t)components;
    if (!keeper->loading) {
        struct kept *kept = &keeper->kept[keeper->count++];
        snprintf(kept->name, sizeof kept->name, "%s", name);
        kept->data = malloc(bytes + 1);
        kept->bytes = bytes;
        memcpy(kept->data, data, bytes);
        return NULL;
    }
    for (int k = 0; k < keeper->count; k++)
        if (strcmp(keeper->kept[k].name, name) == 0 && keeper->kept[k].bytes == bytes) {
            memcpy(data, keeper->kept[k].data, bytes);
            return NULL;
        }
    return error_new(ERROR_INPUT, "no array %s of %zu bytes", name, bytes);
}

static void a_visitor_saves_the_state_and_loads_it_again(void **state)
{
    (void)state;
    struct keeper keeper = {.visitor = {keep}};
    struct particles p, q, r;
    make(&p, 3, 0.7, 333);
    uint64_t hash = particles_hash(&p);
    assert_success(particles_visit(&p, &keeper.visitor));
    assert_true(particles_hash(&p) == hash);
    int states = 0;
    for (int k = 0; k < p.fields; k++)
        states += (p.field[k].declaration.kind & FIELD_STATE) != 0;
    assert_int_equal(keeper.count, 1 + states);
    assert_string_equal(keeper.kept[0].name, "particles/count");

    keeper.loading = true;
    assert_success(particles_create(3, 5.0, more, COUNT_OF(more), &q)); /* an empty store */
    assert_success(particles_visit(&q, &keeper.visitor));
    assert_int_equal(q.count, 333);
    assert_int_equal(q.pending, 0);
    assert_true(particles_hash(&q) == hash);
    assert_success(particles_sort(&q));
    assert_true(particles_hash(&q) == hash);

    make(&r, 3, 0.7, 1000); /* one that held more */
    assert_success(particles_visit(&r, &keeper.visitor));
    assert_int_equal(r.count, 333);
    assert_true(particles_hash(&r) == hash);
    assert_success(particles_sort(&r));
    for (int32_t i = 0; i < r.count; i++)
        assert_true(r.id[i] == p.id[i]);

    for (int k = 0; k < keeper.count; k++)
        free(keeper.kept[k].data);
    particles_destroy(&p);
    particles_destroy(&q);
    particles_destroy(&r);
}

static void ids_tell_bodies_and_sites_apart(void **state)
{
    (void)state;
    assert_true(particle_id(0, 0) == 0);
    assert_true(particle_id(3, 5) == ((uint64_t)3 << 48 | 5));
    assert_true(particle_id(65534, ((int64_t)1 << 48) - 1) >> 48 == 65534);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(appended_particles_are_zero_and_wait_for_the_commit),
        cmocka_unit_test(deleted_particles_go_at_the_commit_and_the_others_stay_whole),
        cmocka_unit_test(a_store_grows_to_many_particles_by_small_appends),
        cmocka_unit_test(storage_is_ordered_by_block_material_cell_and_id),
        cmocka_unit_test(a_block_key_gives_its_coordinates_back),
        cmocka_unit_test(what_flies_off_is_still_stored),
        cmocka_unit_test(the_hash_is_the_same_for_any_order_of_storage),
        cmocka_unit_test(the_hash_sees_every_bit_of_the_state_and_nothing_else),
        cmocka_unit_test(a_visitor_saves_the_state_and_loads_it_again),
        cmocka_unit_test(ids_tell_bodies_and_sites_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
