/* Takes steps of small cases. It is run under callgrind (instructions.py), which counts what
 * happens in the function `counted`, called once for each of the cases that are printed.
 *
 * Usage: count_steps TABLE GROUP: the cases of TABLE (cases.txt) whose names begin with GROUP */
#include "bench.h"

#include "base/isa.h"
#include "gas_kernel.h"
#include "model/simulation.h"

enum { FIELDS_MAX = 8, LINE_MAX_LENGTH = 512 };

/* A line of the table. */
struct entry {
    const char *name, *file;
    int steps;
    const char *setting[FIELDS_MAX];
    int settings;
};

/* Calls RUN. External, so that it keeps its name. */
void counted(void (*run)(void *of, int times), void *of, int times);
__attribute__((noinline, noclone)) void counted(void (*run)(void *of, int times), void *of,
                                                int times)
{
    run(of, times);
}

static void report(const struct entry *entry, int members)
{
    printf("%s,%d,%d\n", entry->name, members, entry->steps);
    fflush(stdout);
}

static void steps(void *of, int times) { take_steps(of, times); }

/* The difference of runs of 2 N and of N steps is what steps N + 1 to 2 N take. */
static void count_case(const struct entry *entry)
{
    char path[2 * LINE_MAX_LENGTH];
    snprintf(path, sizeof path, "%s/tests/speed/cases/%s.yaml", BOLIDE_SOURCE_DIR, entry->file);
    struct started s = start_with(path, entry->setting, entry->settings, 1);
    take_steps(&s, entry->steps);
    report(entry, (int32_t)simulation_members(s.simulation));
    counted(steps, &s, entry->steps);
    finish(&s);
}

ISA_CHOOSE(void, gas_lax_wendroff,
           (struct gas_row * row, const struct lax_wendroff *scheme, double r,
            struct gas_numbers *flux),
           (row, scheme, r, flux))
ISA_CHOOSE(void, gas_muscl_hancock, (struct gas_row * row, double r, struct gas_numbers *flux),
           (row, r, flux))

/* A row of gas at two pressures that moves along it and across. */
static struct gas_row row_of_gas(const struct eos *eos)
{
    struct gas_row row = {.eos = eos, .cells = ROW_CELLS};
    for (int k = 0; k < ROW_ROOM; k++) {
        const double density = k < ROW_ROOM / 2 ? 1.0 : 0.125, pressure = density;
        row.u.of[GAS_DENSITY][k] = density;
        row.u.of[GAS_MOMENTUM][k] = 0.1 * density;
        row.u.of[GAS_MOMENTUM + 1][k] = 0.2 * density;
        row.u.of[GAS_ENERGY][k] = pressure / 0.4 + 0.5 * density * (square(0.1) + square(0.2));
    }
    return row;
}

/* A row and the scheme of its sweeps, or NULL for MUSCL-Hancock. */
struct swept {
    struct gas_row row;
    const struct lax_wendroff *scheme;
};

static void sweeps(void *of, int times)
{
    struct swept *swept = of;
    struct gas_numbers flux;
    for (int k = 0; k < times; k++)
        if (swept->scheme)
            gas_lax_wendroff(&swept->row, swept->scheme, 0.01, &flux);
        else
            gas_muscl_hancock(&swept->row, 0.01, &flux);
}

/* The file of ENTRY is the name of a sweep. */
static void count_sweeps(const struct entry *entry)
{
    const struct eos_ideal_gas ideal = {1.0, 1.4};
    const struct eos eos = eos_make_ideal_gas(&ideal);
    const struct lax_wendroff richtmyer = {LAX_WENDROFF_RICHTMYER, VISCOSITY_OF_FACES, 0.5},
                              printed = {LAX_WENDROFF_PRINTED, VISCOSITY_OF_CELLS, 0.5};
    struct swept swept = {.row = row_of_gas(&eos)};
    if (!strcmp(entry->file, "lax-wendroff"))
        swept.scheme = &richtmyer;
    if (!strcmp(entry->file, "lax-wendroff-printed"))
        swept.scheme = &printed;
    report(entry, swept.row.cells);
    counted(sweeps, &swept, entry->steps);
}

/* NAME | STEPS | FILE [| SETTING]..., cut up in place; false for comments and empty lines. */
static bool parse(char *line, struct entry *entry)
{
    char *field[FIELDS_MAX];
    int count = 0;
    line[strcspn(line, "#\n")] = '\0';
    for (char *rest = line; rest && count < FIELDS_MAX;) {
        char *end = strchr(rest, '|');
        if (end)
            *end = '\0';
        rest += strspn(rest, " ");
        for (size_t k = strlen(rest); k > 0 && rest[k - 1] == ' '; k--)
            rest[k - 1] = '\0';
        field[count++] = rest;
        rest = end ? end + 1 : NULL;
    }
    if (count < 3)
        return false;
    *entry = (struct entry){.name = field[0], .steps = atoi(field[1]), .file = field[2]};
    for (int k = 3; k < count; k++)
        entry->setting[entry->settings++] = field[k];
    return true;
}

int main(int count, char **arguments)
{
    if (count != 3) {
        fprintf(stderr, "usage: count_steps TABLE GROUP\n");
        return ERROR_INPUT;
    }
    FILE *table = fopen(arguments[1], "r");
    if (!table) {
        perror(arguments[1]);
        return ERROR_SYSTEM;
    }
    printf("v%d\n", 2 + (int)isa_best());
    char line[LINE_MAX_LENGTH];
    while (fgets(line, sizeof line, table)) {
        struct entry entry;
        if (!parse(line, &entry) || strncmp(entry.name, arguments[2], strlen(arguments[2])) != 0)
            continue;
        if (!strncmp(entry.name, "gas/", 4))
            count_sweeps(&entry);
        else
            count_case(&entry);
    }
    fclose(table);
    return 0;
}
