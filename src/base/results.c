/* The folder of a run's results; see results.h. */
#include "base/results.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file.h"
#include "base/memory.h"

/* What every run may write. The log tells a run's folder from any other, so it is removed last. The
 * names of all other files are in the list. */
static const char log_name[] = "run.log", list_name[] = ".bolide-files",
                  lock_name[] = ".bolide-lock";
static const char *const result_files[] = {
    "case.yaml",   "history.csv", "checkpoint.h5",           "checks.csv",
    "summary.csv", "report.html", "snapshots.vtkhdf.series", "fragments.csv",
    "view.html",   "changes.csv",
};
/* The cases before each change of a resumed run. */
static const char earlier_cases[] = "case-" RESULTS_NUMBER ".yaml";
static const char *const result_folders[] = {"snapshots", "pictures", "probes", "profiles",
                                             "histograms"};

static struct error *remove_file(const char *path)
{
    return unlink(path) && errno != ENOENT && errno != ENOTDIR ? file_error(path, errno) : NULL;
}

/* Removes NAME and what a killed run left of it half written. */
static struct error *remove_named(const char *folder, const char *name)
{
    char *path = path_join(folder, name);
    char *beside = path ? file_beside(path) : NULL;
    struct error *error =
        beside ? error_join(remove_file(path), remove_file(beside)) : out_of_memory();
    free(beside);
    free(path);
    return error;
}

/* True when NAME is PATTERN with digits for its RESULTS_NUMBER, perhaps half written. */
static bool matches(const char *name, const char *pattern)
{
    size_t before = strcspn(pattern, RESULTS_NUMBER);
    const char *after = pattern + before + 1;
    if (strncmp(name, pattern, before) != 0)
        return false;
    const char *number = name + before;
    size_t digits = strspn(number, "0123456789");
    const char *rest = number + digits;
    size_t length = strlen(after);
    return digits && !strncmp(rest, after, length) &&
           (!rest[length] || !strcmp(rest + length, ".part"));
}

/* Removes the files of PATTERN, which holds a RESULTS_NUMBER, in the folder PATH. */
static struct error *remove_numbered(const char *path, const char *pattern)
{
    DIR *directory = opendir(path);
    if (!directory)
        return errno == ENOENT || errno == ENOTDIR ? NULL : file_error(path, errno);
    struct error *error = NULL;
    for (struct dirent *entry; !error && (entry = readdir(directory));) {
        if (!matches(entry->d_name, pattern))
            continue;
        char *name = path_join(path, entry->d_name);
        error = name ? remove_file(name) : out_of_memory();
        free(name);
    }
    closedir(directory);
    return error;
}

/* Removes what LINE of the list names. A list that somebody has written must not lead out of
 * FOLDER. */
static struct error *remove_listed(const char *folder, const char *line)
{
    for (size_t i = 0; i < COUNT_OF(result_folders); i++) {
        size_t length = strlen(result_folders[i]);
        const char *name = line + length + 1;
        if (strncmp(line, result_folders[i], length) != 0 || line[length] != '/' || !*name ||
            strchr(name, '/'))
            continue;
        char *path = path_join(folder, result_folders[i]);
        struct error *error = !path                           ? out_of_memory()
                              : strchr(name, *RESULTS_NUMBER) ? remove_numbered(path, name)
                                                              : remove_named(path, name);
        free(path);
        return error;
    }
    return NULL;
}

static struct error *remove_all_listed(const char *folder)
{
    char *path = path_join(folder, list_name), *list = NULL, *rest;
    size_t size;
    struct error *error = path ? file_read(path, &list, &size) : out_of_memory();
    for (char *line = list ? strtok_r(list, "\n", &rest) : NULL; line && !error;
         line = strtok_r(NULL, "\n", &rest))
        error = remove_listed(folder, line);
    free(list);
    free(path);
    return error;
}

/* Removes the folder NAME of FOLDER when nothing is in it. */
static struct error *remove_empty(const char *folder, const char *name)
{
    char *path = path_join(folder, name);
    struct error *error = path ? NULL : out_of_memory();
    if (path && rmdir(path) && errno != ENOTEMPTY && errno != EEXIST && errno != ENOENT &&
        errno != ENOTDIR)
        error = file_error(path, errno);
    free(path);
    return error;
}

static struct error *remove_run(const char *folder)
{
    for (size_t i = 0; i < COUNT_OF(result_files); i++)
        TRY(remove_named(folder, result_files[i]));
    TRY(remove_numbered(folder, earlier_cases));
    TRY(remove_all_listed(folder));
    for (size_t i = 0; i < COUNT_OF(result_folders); i++)
        TRY(remove_empty(folder, result_folders[i]));
    TRY(remove_named(folder, list_name));
    return remove_named(folder, log_name);
}

static bool is_there(const char *folder, const char *name)
{
    char *path = path_join(folder, name);
    struct stat status;
    bool there = path && lstat(path, &status) == 0; /* a link that points nowhere is there too */
    free(path);
    return there;
}

/* Files are never written through a link, since they are made anew; in a folder that is a link they
 * would be. */
struct error *results_check_links(const char *folder)
{
    struct error *error = NULL;
    for (size_t i = 0; i < COUNT_OF(result_folders) && !error; i++) {
        char *path = text_format("%s/%s/", folder, result_folders[i]);
        error = path ? file_check_folder(path) : out_of_memory();
        free(path);
    }
    return error;
}

/* A name that a run would write to and that is in FOLDER; NULL when there is none. */
static const char *name_in_the_way(const char *folder)
{
    for (size_t i = 0; i < COUNT_OF(result_files); i++)
        if (is_there(folder, result_files[i]))
            return result_files[i];
    for (size_t i = 0; i < COUNT_OF(result_folders); i++)
        if (is_there(folder, result_folders[i]))
            return result_folders[i];
    return NULL;
}

struct error *results_check(const char *folder, bool overwrite)
{
    bool of_run = is_there(folder, log_name);
    if (of_run && !overwrite)
        return error_new(ERROR_INPUT,
                         "%s: already contains the results of a run (--overwrite replaces them, "
                         "--resume continues the run)",
                         folder);
    const char *name = of_run ? NULL : name_in_the_way(folder);
    if (name)
        return error_new(ERROR_INPUT,
                         "%s: holds %s, which is in the way of a run's own but comes from no run "
                         "(there is no %s); choose another folder",
                         folder, name, log_name);
    return results_check_links(folder);
}

/* An empty log marks the folder as a run's from the first moment. */
static struct error *mark_folder(const char *folder)
{
    FILE *file = NULL;
    char *path = path_join(folder, log_name);
    struct error *error = path ? file_open(path, "w", &file) : out_of_memory();
    if (file && fclose(file))
        error = file_error(path, errno);
    free(path);
    return error;
}

static struct error *write_list(const char *folder, const char *const *names)
{
    FILE *file;
    char *path = path_join(folder, list_name);
    struct error *error = path ? file_begin(path, &file) : out_of_memory();
    if (!error) {
        for (; *names; names++)
            fprintf(file, "%s\n", *names);
        error = file_end(path, file);
    }
    free(path);
    return error;
}

struct error *results_begin(const char *folder, bool overwrite, const char *const *names)
{
    TRY(folder_make(folder));
    TRY(results_check(folder, overwrite));
    if (is_there(folder, log_name))
        TRY(remove_run(folder));
    TRY(mark_folder(folder));
    return write_list(folder, names);
}

struct error *results_add(const char *folder, const char *const *names)
{
    FILE *file = NULL;
    char *path = path_join(folder, list_name);
    struct error *error = path ? file_open(path, "a", &file) : out_of_memory();
    for (; file && *names; names++)
        fprintf(file, "%s\n", *names);
    if (file && fclose(file))
        error = file_error(path, errno);
    free(path);
    return error;
}

static struct error *in_use(const char *folder, int descriptor)
{
    char holder[24] = "";
    ssize_t length = pread(descriptor, holder, sizeof holder - 1, 0);
    long process = length > 0 ? strtol(holder, NULL, 10) : 0;
    return process > 0 ? error_new(ERROR_INPUT, "%s: is in use by another run (process %ld)",
                                   folder, process)
                       : error_new(ERROR_INPUT, "%s: is in use by another run", folder);
}

/* Whoever had the lock before may have removed the file of DESCRIPTOR between its opening and its
 * locking; then others lock a new one. */
static bool is_file_of(int descriptor, const char *path)
{
    struct stat open_file, there;
    return !fstat(descriptor, &open_file) && !lstat(path, &there) &&
           open_file.st_dev == there.st_dev && open_file.st_ino == there.st_ino;
}

/* The system frees such a lock when its holder ends, killed or not. Between the machines of a
 * network file system it holds as far as that file system has locks; where it has none the run
 * goes on without. */
struct error *results_lock(const char *folder, struct results_lock *lock)
{
    char *path = path_join(folder, lock_name);
    if (!path)
        return out_of_memory();
    for (;;) {
        int descriptor;
        struct error *error = file_open_descriptor(path, O_RDWR | O_CREAT, &descriptor);
        if (!error && flock(descriptor, LOCK_EX | LOCK_NB) && errno == EWOULDBLOCK)
            error = in_use(folder, descriptor);
        if (!error && is_file_of(descriptor, path)) {
            if (!ftruncate(descriptor, 0))
                dprintf(descriptor, "%ld\n", (long)getpid());
            *lock = (struct results_lock){path, descriptor};
            return NULL;
        }
        if (descriptor >= 0)
            close(descriptor);
        if (error) {
            free(path);
            return error;
        }
    }
}

void results_unlock(struct results_lock *lock)
{
    if (!lock->path)
        return;
    if (is_file_of(lock->descriptor, lock->path))
        unlink(lock->path);
    close(lock->descriptor);
    free(lock->path);
    *lock = (struct results_lock){0};
}
