/* Memory of the machine (sysconf), of the control group and its parents (memory.max, or
 * memory.limit_in_bytes of the older interface), and of the process (getrlimit); see machine.h. */
#include "base/machine.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/base.h"

/* The number in the file PATH; INFINITY where there is none, or "max". */
static double number_in(const char *path)
{
    char text[64], *end;
    FILE *file = fopen(path, "re");
    const bool there = file && fgets(text, sizeof text, file);
    if (file)
        fclose(file);
    const double value = there ? strtod(text, &end) : 0.0;
    return there && end > text && value > 0.0 ? value : INFINITY;
}

/* The least of the file NAME in ROOT/GROUP and all of its parents: a process in a container may see
 * its own group as the root. */
static double least_of_groups(const char *root, const char *group, const char *name)
{
    char within[512], path[768];
    double least = INFINITY;
    snprintf(within, sizeof within, "%s", group);
    for (char *slash = within + strlen(within); slash; slash = strrchr(within, '/')) {
        *slash = '\0';
        snprintf(path, sizeof path, "%s%s/%s", root, within, name);
        least = minimum(least, number_in(path));
    }
    return least;
}

static double memory_of_group(void)
{
    char line[640];
    double least = INFINITY;
    FILE *file = fopen("/proc/self/cgroup", "re");
    while (file && fgets(line, sizeof line, file)) {
        line[strcspn(line, "\n")] = '\0';
        char *controllers = strchr(line, ':');
        char *group = controllers ? strchr(controllers + 1, ':') : NULL;
        if (!group)
            continue;
        *group++ = '\0';
        if (controllers[1] == '\0') {
            least = minimum(least, least_of_groups("/sys/fs/cgroup", group, "memory.max"));
            least = minimum(least, least_of_groups("/sys/fs/cgroup/unified", group, "memory.max"));
        } else if (strstr(controllers + 1, "memory")) {
            least = minimum(
                least, least_of_groups("/sys/fs/cgroup/memory", group, "memory.limit_in_bytes"));
        }
    }
    if (file)
        fclose(file);
    return least;
}

double machine_memory(void)
{
    const double pages = (double)sysconf(_SC_PHYS_PAGES), page = (double)sysconf(_SC_PAGESIZE);
    double least = pages > 0.0 && page > 0.0 ? pages * page : INFINITY;
    struct rlimit limit;
    if (!getrlimit(RLIMIT_AS, &limit) && limit.rlim_cur != RLIM_INFINITY)
        least = minimum(least, (double)limit.rlim_cur);
    return minimum(least, memory_of_group());
}
