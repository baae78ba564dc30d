/* The files of a document: the one that is opened and those that it includes, joined in one
 * tree. */
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"
#include "document/internal.h"

static const char include_key[] = "include";

/* Files that a document may include: a list that names a file twice, whose file does so too, would
 * never end otherwise. */
enum { INCLUDED_MAX = 64 };

/* Bytes of a case with all that it includes; one of as many bodies as there may be has half of
 * it. */
enum { FILES_MAX_BYTES = 16 << 20 };

/* A file on the way from the first to the one that is read, and where it is asked for. */
struct source {
    const struct source *by; /* the file that includes it */
    const char *path;
    struct mark place; /* of its name there; of the first file: unused */
    dev_t device;
    ino_t number;
};

struct loading {
    struct document *document;
    const struct node *include; /* instead of that of the first file; NULL: its own */
    int included;
    size_t bytes;
};

/* The whole of FILE, NULL when it cannot be read or has more than MOST bytes (errno tells why). */
static char *read_all(FILE *file, size_t most, size_t *length)
{
    char *text = NULL;
    size_t capacity = 0, got = 1;
    int why = 0;
    *length = 0;
    while (got > 0 && !why) {
        why = *length > most ? EFBIG : 0;
        if (*length == capacity) {
            capacity = capacity ? 2 * capacity : 1 << 14;
            char *grown = realloc(text, capacity);
            why = grown ? why : ENOMEM;
            text = grown ? grown : text;
        }
        got = why ? 0 : fread(text + *length, 1, capacity - *length, file);
        *length += got;
        why = ferror(file) ? errno : why;
    }
    if (why) {
        free(text);
        errno = why;
        return NULL;
    }
    return text;
}

/* SOURCE cannot be taken: told where its name stands. */
static struct error *refuse(const struct source *source, const char *why)
{
    if (!source->by)
        return error_new(ERROR_INPUT, "%s: %s", source->path, why);
    return place_error(source->place, include_key, "%s: %s", source->path, why);
}

/* Opens SOURCE and says which file it is. It must be a regular file, which has an end; to open
 * another kind may wait indefinitely or do something to a device. */
static struct error *open_source(struct source *source, FILE **file)
{
    struct stat status;
    if (stat(source->path, &status))
        return refuse(source, strerror(errno));
    if (!S_ISREG(status.st_mode))
        return refuse(source,
                      S_ISDIR(status.st_mode) ? "this is a folder" : "this is not a regular file");
    const int descriptor = open(source->path, O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
    *file = descriptor < 0 ? NULL : fdopen(descriptor, "rb");
    if (!*file || fstat(descriptor, &status) || !S_ISREG(status.st_mode)) {
        struct error *error = refuse(source, strerror(errno));
        if (!*file && descriptor >= 0)
            close(descriptor);
        return error;
    }
    source->device = status.st_dev;
    source->number = status.st_ino;
    if (status.st_size > FILES_MAX_BYTES)
        return refuse(source, strerror(EFBIG));
    for (const struct source *above = source->by; above; above = above->by)
        if (above->device == source->device && above->number == source->number)
            return refuse(source, "a file cannot include itself");
    return NULL;
}

/* Whether TEXT is a whole number, of which the digits before a decimal comma are. */
static bool is_whole(const char *text)
{
    const size_t sign = text[0] == '-' || text[0] == '+';
    const size_t digits = strspn(text + sign, "0123456789");
    return digits > 0 && text[sign + digits] == '\0';
}

/* What stands after the comma of a decimal number that begins with BEFORE: the key of an entry
 * without a value in a map, or the next item of a list, with a unit and without a blank before it;
 * NULL where there is no such number. */
static const char *after_comma(enum node_kind kind, const struct node *before,
                               const struct node *after)
{
    if (before->kind != NODE_SCALAR || after->kind != NODE_SCALAR || !before->plain ||
        !is_whole(before->text))
        return NULL;
    const char *text = kind == NODE_MAP ? after->key : after->text;
    const bool found =
        kind == NODE_MAP
            ? node_is_empty(after)
            : after->plain && !is_whole(text) && after->place.line == before->place.line &&
                  after->place.column == before->place.column + (int)strlen(before->text) + 1;
    return found && text[0] >= '0' && text[0] <= '9' ? text : NULL;
}

/* Numbers with a decimal comma, which YAML takes for two entries. All other mistakes would follow
 * from them. */
static struct error *refuse_commas(const struct node *node)
{
    struct error *error = NULL;
    for (int i = 0; i < node->count; i++) {
        const struct node *child = node->child[i];
        const char *rest =
            i + 1 < node->count ? after_comma(node->kind, child, node->child[i + 1]) : NULL;
        if (rest)
            error = error_join(error, place_error(child->place, child->key ? child->key : "",
                                                  "\"%s,%s\": write a decimal point, %s.%s",
                                                  child->text, rest, child->text, rest));
        error = error_join(error, refuse_commas(child));
    }
    return error;
}

static struct error *read_source(struct loading *loading, struct source *source, struct node **root)
{
    FILE *file = NULL;
    char *text = NULL;
    size_t length = 0;
    struct error *error = open_source(source, &file);
    if (!error && !(text = read_all(file, FILES_MAX_BYTES - loading->bytes, &length)))
        error = refuse(source, strerror(errno));
    loading->bytes += text ? length : 0;
    if (file)
        fclose(file);
    const char *origin = error ? NULL : document_keep(loading->document, text_copy(source->path));
    if (!error)
        error = origin ? node_parse(text, length, origin, true, root) : out_of_memory();
    free(text);
    assert(error || *root);
    if (!error && (*root)->kind != NODE_MAP)
        error = place_error((*root)->place, "", "expected a map of keys and values");
    if (!error)
        error = refuse_commas(*root);
    return error;
}

static struct error *load(struct loading *loading, struct source *source, struct node **root);

/* NAME as seen from the file BY. */
static char *path_from(const char *by, const char *name)
{
    const char *slash = strrchr(by, '/');
    if (name[0] == '/' || !slash)
        return text_copy(name);
    return text_format("%.*s%s", (int)(slash + 1 - by), by, name);
}

bool make_path_whole(struct mark place, char **path)
{
    const bool is_setting = place.line == 0;
    char *seen = path_from(is_setting ? "" : place.origin, *path);
    char *whole = seen ? realpath(seen, NULL) : NULL;
    free(*path);
    *path = whole ? whole : seen;
    if (whole)
        free(seen);
    return *path;
}

/* Lays the file that NAME, a node, names over what BASE holds of the files before it. */
static struct error *include_one(struct loading *loading, const struct source *by,
                                 const struct node *name, struct node *base)
{
    if (name->kind != NODE_SCALAR || node_is_empty(name) || !name->text[0])
        return place_error(name->place, include_key, "expected a file or a list of files");
    if (++loading->included > INCLUDED_MAX)
        return place_error(name->place, include_key, "these are more than %d files", INCLUDED_MAX);
    char *path = path_from(by->path, name->text);
    struct source source = {.by = by, .path = path, .place = name->place};
    struct node *root = NULL;
    struct error *error = path ? load(loading, &source, &root) : out_of_memory();
    if (!error)
        error = node_merge(base, root);
    node_free(root);
    free(path);
    return error;
}

/* What INCLUDE, a scalar or a list, asks for, under the entries of OWN. */
static struct error *include_all(struct loading *loading, const struct source *by,
                                 const struct node *include, struct node *own)
{
    struct node *base = node_new(NODE_MAP, own->place);
    if (!base)
        return out_of_memory();
    struct error *error = NULL;
    if (include->kind != NODE_LIST)
        error = include_one(loading, by, include, base);
    for (int i = 0; include->kind == NODE_LIST && i < include->count; i++)
        error = error_join(error, include_one(loading, by, include->child[i], base));
    if (!error)
        error = node_merge(base, own);
    if (!error) { /* OWN stays the root, so that what is missing is told to be missing there */
        struct node emptied = *own;
        own->child = base->child;
        own->count = base->count;
        base->child = emptied.child;
        base->count = 0;
    }
    node_free(base);
    return error;
}

static struct error *load(struct loading *loading, struct source *source, struct node **root)
{
    TRY(read_source(loading, source, root));
    struct node *own = NULL;
    for (int i = 0; i < (*root)->count && !own; i++)
        if (!strcmp((*root)->child[i]->key, include_key))
            own = node_take(*root, i);
    const struct node *include = !source->by && loading->include ? loading->include : own;
    struct error *error = include ? include_all(loading, source, include, *root) : NULL;
    node_free(own);
    return error;
}

struct error *document_load(struct document *document, const char *path, const struct node *include)
{
    struct loading loading = {.document = document, .include = include};
    struct source source = {.path = path};
    return load(&loading, &source, &document->root);
}
