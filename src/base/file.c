/* Files that are never half there, and folders; see file.h. */
#include "base/file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/checksum.h"
#include "base/memory.h"

static const char part[] = ".part";

char *file_beside(const char *path) { return text_format("%s%s", path, part); }

char *path_join(const char *folder, const char *name)
{
    size_t length = strlen(folder);
    bool open = length > 0 && folder[length - 1] != '/';
    return text_format("%s%s%s", folder, open ? "/" : "", name);
}

struct error *file_clear_beside(const char *path, char **beside)
{
    *beside = file_beside(path);
    if (!*beside)
        return out_of_memory();
    if (!unlink(*beside) || errno == ENOENT)
        return NULL;
    struct error *error = file_error(*beside, errno);
    free(*beside);
    *beside = NULL;
    return error;
}

static struct error *not_plain(const char *path)
{
    return error_new(ERROR_INPUT,
                     "%s: is a folder, a pipe or a device instead of a plain file; remove it",
                     path);
}

/* Without O_NONBLOCK to open a pipe waits for its other end. */
struct error *file_open_descriptor(const char *path, int flags, int *descriptor)
{
    struct stat status;
    struct error *error = NULL;
    *descriptor = open(path, flags | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY, 0666);
    if (*descriptor < 0 && errno == ELOOP)
        return error_new(ERROR_INPUT,
                         "%s: is a symbolic link; results are not written through links: remove it",
                         path);
    if (*descriptor < 0)
        return errno == ENXIO || errno == EISDIR ? not_plain(path) : file_error(path, errno);
    if (fstat(*descriptor, &status))
        error = file_error(path, errno);
    else if (!S_ISREG(status.st_mode))
        error = not_plain(path);
    if (error) {
        close(*descriptor);
        *descriptor = -1;
    }
    return error;
}

struct error *file_open(const char *path, const char *mode, FILE **file)
{
    const int flags = (mode[1] ? O_RDWR : O_WRONLY) | (*mode == 'a' ? O_APPEND : 0) |
                      (*mode == 'r' ? 0 : O_CREAT);
    int descriptor;
    *file = NULL;
    TRY(file_open_descriptor(path, flags, &descriptor));
    if (*mode != 'w' || !ftruncate(descriptor, 0))
        *file = fdopen(descriptor, mode);
    if (*file)
        return NULL;
    struct error *error = file_error(path, errno);
    close(descriptor);
    return error;
}

struct error *file_check_folder(const char *path)
{
    const char *slash = strrchr(path, '/');
    char *folder = text_copy_part(path, slash ? (size_t)(slash - path) : 0);
    struct stat status;
    struct error *error = folder ? NULL : out_of_memory();
    if (folder && *folder && !lstat(folder, &status) && S_ISLNK(status.st_mode))
        error = error_new(ERROR_INPUT,
                          "%s: is a symbolic link; results are not written through links: put a "
                          "folder there",
                          folder);
    free(folder);
    return error;
}

bool file_is_plain(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && S_ISREG(status.st_mode);
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
    if (number == ENOENT) /* what was written is elsewhere: the folder was replaced */
        TRY(file_check_folder(path));
    return number ? file_error(path, number) : NULL;
}

struct error *file_begin(const char *path, FILE **file)
{
    char *beside;
    TRY(file_clear_beside(path, &beside));
    *file = fopen(beside, "wxe");
    struct error *error = *file ? NULL : file_error(path, errno);
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
    return number ? file_error(path, number)
                  : error_new(ERROR_SYSTEM, "%s: cannot be written", path);
}

struct error *file_write(const char *folder, const char *name,
                         void (*put)(FILE *file, const void *content), const void *content)
{
    FILE *file;
    char *path = path_join(folder, name);
    struct error *error = path ? file_begin(path, &file) : out_of_memory();
    if (!error) {
        put(file, content);
        error = file_end(path, file);
    }
    free(path);
    return error;
}

/* NULL when FOLDER is a folder already or was made. */
static struct error *folder_make_one(const char *folder)
{
    if (!mkdir(folder, 0777))
        return NULL;
    int number = errno;
    struct stat status;
    if (stat(folder, &status))
        return error_context(file_error(folder, number), "cannot make a folder");
    if (!S_ISDIR(status.st_mode))
        return error_new(ERROR_INPUT, "%s: is a file instead of a folder", folder);
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

static bool ends_with(const char *name, size_t length, const char *ending)
{
    size_t size = strlen(ending);
    return length > size && !memcmp(name + length - size, ending, size);
}

struct error *file_hash(const char *path, int number, int parts, uint64_t *hash)
{
    *hash = 0;
    if (!file_is_plain(path))
        return NULL;
    FILE *file = fopen(path, "re");
    if (!file)
        return file_error(path, errno);
    uint64_t words[1 << 12];
    const int64_t size = file_size(path), all = size / (int64_t)sizeof *words + 1,
                  end = all * (number + 1) / parts, room = COUNT_OF(words);
    int64_t at = all * number / parts;
    bool failed = fseeko(file, (off_t)(at * (int64_t)sizeof *words), SEEK_SET) != 0;
    while (at < end && !failed) {
        const int64_t some = end - at < room ? end - at : room;
        memset(words, 0, sizeof words);
        fread(words, 1, (size_t)some * sizeof *words, file);
        failed = ferror(file);
        *hash += checksum_of(words, sizeof *words, at, some, 1);
        at += some;
    }
    if (number == 0)
        *hash += checksum_of(&size, sizeof size, all, 1, 1);
    struct error *error = failed ? file_error(path, EIO) : NULL;
    fclose(file);
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
        return file_error(path, errno);
    char *text = malloc((size_t)status.st_size + 1);
    size_t length = text ? fread(text, 1, (size_t)status.st_size, file) : 0;
    int number = !text ? ENOMEM : ferror(file) ? EIO : 0;
    fclose(file);
    if (number) {
        free(text);
        return file_error(path, number);
    }
    text[length] = '\0';
    *content = text;
    *size = length;
    return NULL;
}

const char *file_read_input(const char *path, size_t most, char **content, size_t *size)
{
    struct stat status;
    *content = NULL;
    if (stat(path, &status))
        return errno == ENOENT || errno == ENOTDIR ? "there is no such `file`"
                                                   : "this `file` cannot be read";
    if (S_ISDIR(status.st_mode))
        return "this `file` is a folder";
    if (!S_ISREG(status.st_mode))
        return "this `file` is not a regular file";
    if ((uint64_t)status.st_size > most)
        return "this `file` is too large";
    struct error *error = file_read(path, content, size);
    error_free(error);
    return error || !*content ? "this `file` cannot be read" : NULL;
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
        return errno == ENOENT || errno == ENOTDIR ? NULL : file_error(folder, errno);
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
