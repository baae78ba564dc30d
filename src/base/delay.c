/* The scheduler's own account of waiting: the second number of /proc/self/task/THREAD/schedstat. */
#include "base/delay.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

/* Of the thread whose folder is NAME in FOLDER, in nanoseconds; negative when it is not told. */
static double delay_of(int folder, const char *name)
{
    char path[64], text[96];
    snprintf(path, sizeof path, "%.40s/schedstat", name);
    int file = openat(folder, path, O_RDONLY | O_CLOEXEC);
    ssize_t length = file < 0 ? -1 : read(file, text, sizeof text - 1);
    if (file >= 0)
        close(file);
    if (length <= 0)
        return -1.0;
    text[length] = '\0';
    char *second, *end;
    strtoull(text, &second, 10);
    unsigned long long delay = strtoull(second, &end, 10);
    return end == second ? -1.0 : (double)delay;
}

double delay_seconds(void)
{
    double sum = -1.0;
    DIR *threads = opendir("/proc/self/task");
    if (!threads)
        return sum;
    for (struct dirent *entry; (entry = readdir(threads));) {
        if (entry->d_name[0] == '.')
            continue;
        double delay = delay_of(dirfd(threads), entry->d_name);
        if (delay >= 0.0)
            sum = (sum > 0.0 ? sum : 0.0) + delay;
    }
    closedir(threads);
    return 1e-9 * sum;
}
