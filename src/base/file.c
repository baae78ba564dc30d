/* Files that are never half there, and the folder of a run's results; see file.h. */
#include "base/file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"

static const char part[] = ".part";

static struct error *out_of_memory(void) { return error_new(ERROR_SYSTEM, "out of memory"); }

static struct error *system_error(const char *path, int number)
{
    return error_new(ERROR_SYSTEM, "%s: %s", path, strerror(number));
}

char *file_beside(const char *path) { return text_format("%s%s", path, part); }

char *path_join(const char *folder, const char *name)
{
    size_t length = strlen(folder);
    bool open = length > 0 && folder[length - 1] != '/';
    return text_format("%s%s%s", folder, open ? "/" : "", name);
}

/* A rename is on disk once its folder is. */
static int flush_to_disk(const char *path, int flags)
{
    int descriptor = open(path, flags | O_CLOEXEC);
    if (descriptor < 0)
        return errno;
    int number = fsync(descriptor) ? errno : 0;
    if (close(descriptor) && !number)
        number = errno;
    return number;
}

static int flush_folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    char *folder = slash ? text_copy_part(path, (size_t)(slash - path) + 1) : text_copy(".");
    int number = folder ? flush_to_disk(folder, O_RDONLY | O_DIRECTORY) : ENOMEM;
    free(folder);
    return number == EINVAL ? 0 : number; /* some file systems cannot flush a folder */
}

struct error *file_publish(const char *path)
{
    char *beside = file_beside(path);
    if (!beside)
        return out_of_memory();
    int number = flush_to_disk(beside, O_RDWR);
    if (!number && rename(beside, path))
        number = errno;
    if (number)
        unlink(beside);
    else
        number = flush_folder_of(path);
    free(beside);
    return number ? system_error(path, number) : NULL;
}

struct error *file_begin(const char *path, FILE **file)
{
    char *beside = file_beside(path);
    if (!beside)
        return out_of_memory();
    *file = fopen(beside, "we");
    struct error *error = *file ? NULL : system_error(path, errno);
    free(beside);
    return error;
}

struct error *file_end(const char *path, FILE *file)
{
    errno = 0;
    bool failed = ferror(file) || fflush(file);
    int number = errno;
    if (fclose(file) && !failed) {
        failed = true;
        number = errno;
    }
    if (!failed)
        return file_publish(path);
    char *beside = file_beside(path);
    if (beside)
        unlink(beside);
    free(beside);
    return number ? system_error(path, number)
                  : error_new(ERROR_SYSTEM, "%s: cannot be written", path);
}

/* NULL when FOLDER is a folder already or was made. */
static struct error *folder_make_one(const char *folder)
{
    if (!mkdir(folder, 0777))
        return NULL;
    int number = errno;
    struct stat status;
    if (stat(folder, &status))
        return error_context(system_error(folder, number), "cannot make a folder");
    if (!S_ISDIR(status.st_mode))
        return error_new(ERROR_INPUT, "%s: is a file where a folder is wanted", folder);
    return NULL;
}

struct error *folder_make(const char *folder)
{
    char *path = text_copy(folder);
    if (!path)
        return out_of_memory();
    struct error *error = NULL;
    for (char *at = path; *at && !error; at++) {
        if (*at != '/' || at == path || at[-1] == '/')
            continue;
        *at = '\0';
        error = folder_make_one(path);
        *at = '/';
    }
    if (!error)
        error = folder_make_one(path);
    free(path);
    return error;
}

/* What a run writes: single files, and folders with files of these endings. The log tells a run's
 * folder from any other, so it is removed last. */
static const char log_name[] = "run.log";
static const char *const result_files[] = {
    "case.yaml",   "history.csv", "checkpoint.h5",           "checks.csv",
    "summary.csv", "report.html", "snapshots.vtkhdf.series",
};
static const struct {
    const char *name, *endings[2];
} result_folders[] = {
    {"snapshots", {".vtkhdf", ".vtkhdf.series"}},
    {"pictures", {".png", NULL}},
    {"probes", {".csv", NULL}},
    {"profiles", {".csv", NULL}},
};

static bool ends_with(const char *name, size_t length, const char *ending)
{
    size_t size = strlen(ending);
    return length > size && !memcmp(name + length - size, ending, size);
}

/* A result of the folder at INDEX, whole or left half written by a killed run. */
static bool is_result(const char *name, size_t index)
{
    size_t length = strlen(name);
    if (ends_with(name, length, part))
        length -= strlen(part);
    for (size_t i = 0; i < COUNT_OF(result_folders[index].endings); i++) {
        const char *ending = result_folders[index].endings[i];
        if (ending && ends_with(name, length, ending))
            return true;
    }
    return false;
}

static struct error *remove_file(const char *path)
{
    return unlink(path) && errno != ENOENT ? system_error(path, errno) : NULL;
}

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

/* Removes the results in folder PATH, and PATH itself when nothing else is in it. */
static struct error *remove_results(const char *path, size_t index)
{
    DIR *directory = opendir(path);
    if (!directory)
        return errno == ENOENT || errno == ENOTDIR ? NULL : system_error(path, errno);
    struct error *error = NULL;
    for (struct dirent *entry; !error && (entry = readdir(directory));) {
        if (!is_result(entry->d_name, index))
            continue;
        char *name = path_join(path, entry->d_name);
        error = name ? remove_file(name) : out_of_memory();
        free(name);
    }
    closedir(directory);
    if (!error && rmdir(path) && errno != ENOTEMPTY && errno != EEXIST)
        error = system_error(path, errno);
    return error;
}

static struct error *remove_run(const char *folder)
{
    for (size_t i = 0; i < COUNT_OF(result_files); i++)
        TRY(remove_named(folder, result_files[i]));
    for (size_t i = 0; i < COUNT_OF(result_folders); i++) {
        char *path = path_join(folder, result_folders[i].name);
        struct error *error = path ? remove_results(path, i) : out_of_memory();
        free(path);
        TRY(error);
    }
    return remove_named(folder, log_name);
}

static bool is_there(const char *folder, const char *name)
{
    char *path = path_join(folder, name);
    bool there = path && access(path, F_OK) == 0;
    free(path);
    return there;
}

/* A name that a run would write to and that stands in FOLDER; NULL when there is none. */
static const char *name_in_the_way(const char *folder)
{
    for (size_t i = 0; i < COUNT_OF(result_files); i++)
        if (is_there(folder, result_files[i]))
            return result_files[i];
    for (size_t i = 0; i < COUNT_OF(result_folders); i++)
        if (is_there(folder, result_folders[i].name))
            return result_folders[i].name;
    return NULL;
}

struct error *folder_check(const char *folder, bool overwrite)
{
    bool of_run = is_there(folder, log_name);
    if (of_run && !overwrite)
        return error_new(ERROR_INPUT,
                         "%s: holds the results of a run already (--overwrite replaces them, "
                         "--resume goes on with them)",
                         folder);
    const char *name = of_run ? NULL : name_in_the_way(folder);
    if (name)
        return error_new(ERROR_INPUT,
                         "%s: holds %s, which is in the way of a run's own but comes from no run "
                         "(there is no %s); choose another folder",
                         folder, name, log_name);
    return NULL;
}

struct error *folder_ready(const char *folder, bool overwrite)
{
    TRY(folder_make(folder));
    TRY(folder_check(folder, overwrite));
    if (is_there(folder, log_name))
        TRY(remove_run(folder));
    /* An empty log marks the folder as a run's from the first moment. */
    char *path = path_join(folder, log_name);
    FILE *file = path ? fopen(path, "we") : NULL;
    struct error *error = file && !fclose(file) ? NULL : system_error(path ? path : folder, errno);
    free(path);
    return error;
}

int64_t file_size(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && S_ISREG(status.st_mode) ? (int64_t)status.st_size : 0;
}

struct error *file_read(const char *path, char **content, size_t *size)
{
    *content = NULL;
    *size = 0;
    struct stat status;
    if (stat(path, &status) || !S_ISREG(status.st_mode))
        return NULL;
    FILE *file = fopen(path, "re");
    if (!file)
        return system_error(path, errno);
    char *text = malloc((size_t)status.st_size + 1);
    size_t length = text ? fread(text, 1, (size_t)status.st_size, file) : 0;
    int number = !text ? ENOMEM : ferror(file) ? EIO : 0;
    fclose(file);
    if (number) {
        free(text);
        return system_error(path, number);
    }
    text[length] = '\0';
    *content = text;
    *size = length;
    return NULL;
}

static int by_name(const void *left, const void *right)
{
    return strcmp(*(char *const *)left, *(char *const *)right);
}

void names_free(char **names, int count)
{
    for (int i = 0; i < count; i++)
        free(names[i]);
    free(names);
}

struct error *folder_names(const char *folder, const char *ending, char ***names, int *count)
{
    int64_t room = 0;
    *names = NULL;
    *count = 0;
    DIR *directory = opendir(folder);
    if (!directory)
        return errno == ENOENT || errno == ENOTDIR ? NULL : system_error(folder, errno);
    struct error *error = NULL;
    for (struct dirent *entry; !error && (entry = readdir(directory));) {
        if (!ends_with(entry->d_name, strlen(entry->d_name), ending))
            continue;
        if (!memory_reserve((void **)names, &room, *count + 1, *count, sizeof **names) ||
            !((*names)[*count] = text_copy(entry->d_name)))
            error = out_of_memory();
        else
            ++*count;
    }
    closedir(directory);
    if (!error && *count)
        qsort(*names, (size_t)*count, sizeof **names, by_name);
    if (error) {
        names_free(*names, *count);
        *names = NULL;
        *count = 0;
    }
    return error;
}
