/* HDF5's errors as values, its files begun and read; see hdf5_file.h. */
#include "output/hdf5_file.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"

/* A file that a full disk kept from closing would crash HDF5's own clean-up at exit; files are
 * closed here, so that the clean-up has nothing to do but harm. The call works before HDF5's first
 * use only. */
struct hdf5_printing hdf5_quiet(void)
{
    H5dont_atexit();
    struct hdf5_printing printing = {NULL, NULL};
    H5Eget_auto2(H5E_DEFAULT, &printing.function, &printing.context);
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    return printing;
}

void hdf5_restore(struct hdf5_printing printing)
{
    H5Eset_auto2(H5E_DEFAULT, printing.function, printing.context);
}

/* The stack's first entry, walked upward, is the root cause. Of a failed system call it tells
 * addresses and times too; the system's own words are what a user needs. */
static herr_t take_cause(unsigned index, const H5E_error2_t *entry, void *context)
{
    static const char mark[] = "error message = '";
    if (index > 0 || !entry->desc)
        return 0;
    char **cause = context;
    const char *words = strstr(entry->desc, mark);
    if (words)
        words += strlen(mark);
    else
        words = entry->desc;
    *cause = text_copy_part(words, strcspn(words, words == entry->desc ? "\n" : "'"));
    return 0;
}

struct error *hdf5_error(enum error_kind kind, const char *format, ...)
{
    char *cause = NULL;
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_cause, &cause);
    H5Eclear2(H5E_DEFAULT);
    va_list arguments;
    va_start(arguments, format);
    char *text = text_vformat(format, arguments);
    va_end(arguments);
    struct error *error = error_new(kind, "%s%s%s%s", text ? text : "HDF5 failed",
                                    cause ? " (" : "", cause ? cause : "", cause ? ")" : "");
    free(text);
    free(cause);
    return error;
}

struct error *hdf5_create(const char *path, bool checksums, hid_t *file)
{
    char *beside;
    *file = H5I_INVALID_HID;
    TRY(file_clear_beside(path, &beside));
    hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    bool ready = access >= 0;
    if (ready && checksums)
        ready = H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110) >= 0;
    hid_t creation = hdf5_creation_list(H5P_FILE_CREATE);
    *file = ready ? H5Fcreate(beside, H5F_ACC_EXCL, creation, access) : H5I_INVALID_HID;
    struct error *error = NULL;
    if (*file < 0)
        error = hdf5_error(ERROR_SYSTEM, "%s: cannot be written", path);
    H5Pclose(creation);
    H5Pclose(access);
    free(beside);
    return error;
}

hid_t hdf5_creation_list(hid_t kind)
{
    hid_t list = H5Pcreate(kind);
    H5Pset_obj_track_times(list, false);
    return list;
}

static struct error *check_storage(hid_t dataset, const char *name)
{
    hid_t list = H5Dget_create_plist(dataset);
    struct error *error = NULL;
    if (list < 0)
        error = hdf5_error(ERROR_SYSTEM, "%s is damaged", name);
    else if (H5Pget_external_count(list) != 0 || H5Pget_layout(list) == H5D_VIRTUAL)
        error = error_new(ERROR_INPUT,
                          "the numbers of %s are in other files: only a file that holds all of its "
                          "own is read",
                          name);
    if (list >= 0)
        H5Pclose(list);
    return error;
}

/* A soft link counts as one to elsewhere: it may lead there by way of another. */
static struct error *check_link(hid_t file, const char *path, const char *name)
{
    H5L_info_t link;
    if (H5Lget_info(file, path, &link, H5P_DEFAULT) < 0)
        return hdf5_error(ERROR_SYSTEM, "has no %s, or a damaged one", name);
    if (link.type == H5L_TYPE_HARD)
        return NULL;
    return error_new(ERROR_INPUT,
                     "%s is a link to elsewhere: only a file that holds all of its own is read",
                     path);
}

/* Looks up the links one by one: HDF5 crashes when it walks through a damaged table of links. */
static struct error *check_links(hid_t file, const char *name)
{
    struct error *error = NULL;
    for (const char *slash = strchr(name, '/'); slash && !error; slash = strchr(slash + 1, '/')) {
        char *group = text_copy_part(name, (size_t)(slash - name));
        error = group ? check_link(file, group, name) : out_of_memory();
        free(group);
    }
    return error ? error : check_link(file, name, name);
}

struct error *hdf5_open_dataset(hid_t file, const char *name, hid_t *dataset)
{
    *dataset = H5I_INVALID_HID;
    TRY(check_links(file, name));
    *dataset = H5Dopen2(file, name, H5P_DEFAULT);
    if (*dataset < 0)
        return hdf5_error(ERROR_SYSTEM, "has no %s, or a damaged one", name);
    struct error *error = check_storage(*dataset, name);
    if (error)
        H5Dclose(*dataset);
    return error;
}
