/* Takes steps of small cases. It is run under callgrind (instructions.py), which counts what
 * happens in the function `counted`, called once for each of the cases that are printed.
 *
 * Usage: count_steps TABLE GROUP: the cases of TABLE (cases.txt) whose names begin with GROUP */
#include "bench.h"

#include "base/isa.h"
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
        count_case(&entry);
    }
    fclose(table);
    return 0;
}
