/* A check of what a case means: telling mistakes at their place, and finding names. */
#include "case/checking.h"

#include <string.h>

#include "base/memory.h"

static const char *path_of(const struct checking *checking, const char *key, char *path)
{
    snprintf(path, PATH_TEXT, "%s%s%s%s%s", checking->map, checking->name ? "." : "",
             checking->name ? checking->name : "", key[0] ? "." : "", key);
    return path;
}

bool case_is_wrong(const struct checking *checking, const char *key)
{
    char path[PATH_TEXT];
    return document_is_wrong(checking->input->document, path_of(checking, key, path));
}

void case_wrong(struct checking *checking, const char *key, const char *format, ...)
{
    char path[PATH_TEXT], message[1024];
    path_of(checking, key, path);
    if (key[0] && case_is_wrong(checking, key))
        return;
    if (error_is_full(checking->error)) { /* to be counted only */
        checking->error = error_join(checking->error, error_new(ERROR_INPUT, "%s", key));
        return;
    }
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    checking->error =
        error_join(checking->error, document_error(checking->input->document, path, "%s", message));
}

int case_find_name(struct checking *checking, const struct named_map *map, const char *what,
                   const char *name, const char *key)
{
    const int found = named_map_find(map, name);
    if (found >= 0)
        return found;
    if (map->count == 0 && document_is_wrong(checking->input->document, ""))
        return -1;
    if (error_is_full(checking->error)) {
        case_wrong(checking, key, "unknown");
        return -1;
    }
    const char *near = nearest_name(name, (const char *const *)map->names, map->count);
    char known[512];
    list_text((const char *const *)map->names, map->count, known, sizeof known);
    if (near)
        case_wrong(checking, key, "there is no %s \"%s\" (did you mean \"%s\"?)", what, name, near);
    else
        case_wrong(checking, key, "there is no %s \"%s\" (known: %s)", what, name, known);
    return -1;
}

void case_find_members(struct checking *checking, const char *of)
{
    if (of && strcmp(of, "particles") != 0 && strcmp(of, "gas") != 0 &&
        strcmp(of, "detonation") != 0)
        case_find_name(checking, &checking->input->bodies, "body", of, "of");
}

bool case_dimension_known(const struct checking *checking)
{
    return checking->input->dimension > 0 &&
           !document_is_wrong(checking->input->document, "dimension");
}

bool case_check_components(struct checking *checking, const char *key, int count)
{
    const int dimension = (int)checking->input->dimension;
    if (!case_dimension_known(checking) || count == dimension)
        return true;
    case_wrong(checking, key, "expected %d component%s, one per dimension; found %d", dimension,
               dimension == 1 ? "" : "s", count);
    return false;
}
