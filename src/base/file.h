/* Files that are never half there: written beside, flushed to disk, renamed into place. */
#ifndef BOLIDE_FILE_H
#define BOLIDE_FILE_H

#include <stdio.h>

#include "base/error.h"

/* The name to write to before PATH: PATH.part. Free it. */
char *file_beside(const char *path);
/* The same, with whatever has that name removed: a link goes, what it points to stays. */
struct error *file_clear_beside(const char *path, char **beside);

/* Flushes the finished file PATH.part to disk and renames it to PATH. */
struct error *file_publish(const char *path);

/* Opens PATH.part for writing text. */
struct error *file_begin(const char *path, FILE **file);
/* Closes FILE (an error of any earlier write shows here) and publishes PATH. */
struct error *file_end(const char *path, FILE *file);

/* Writes FOLDER/NAME, whose text PUT makes of CONTENT. */
struct error *file_write(const char *folder, const char *name,
                         void (*put)(FILE *file, const void *content), const void *content);

/* Opens PATH as fopen does with the MODE "r+", "a", "a+", "w" or "w+", but only a plain file:
 * ERROR_INPUT for a link, whose target may be anybody's, and for a pipe or a device, which may
 * never answer. */
struct error *file_open(const char *path, const char *mode, FILE **file);
/* The same with the FLAGS of open(); DESCRIPTOR is -1 after an error. */
struct error *file_open_descriptor(const char *path, int flags, int *descriptor);

/* ERROR_INPUT when the folder in which PATH lies is a symbolic link: to be called before each file
 * that a run writes into a folder of its own, for which somebody may have put a link meanwhile. */
struct error *file_check_folder(const char *path);

/* True when PATH is a plain file, or a link to one. */
bool file_is_plain(const char *path);

/* Makes FOLDER and its parents where missing. */
struct error *folder_make(const char *folder);

/* The whole of PATH in fresh memory, with a zero behind its SIZE bytes; CONTENT is NULL when there
 * is no such file, or it is no plain file. */
struct error *file_read(const char *path, char **content, size_t *size);

/* The same of a file that must be there and have at most MOST bytes; NULL, or what is wrong (static
 * text). */
const char *file_read_input(const char *path, size_t most, char **content, size_t *size);

/* The hash of the plain file PATH is the sum of PARTS numbers, that are computed apart: *HASH
 * is NUMBER of them, from 0 on, or 0 when there is no such file. */
struct error *file_hash(const char *path, int number, int parts, uint64_t *hash);

/* Bytes of the plain file PATH, 0 when there is none. */
int64_t file_size(const char *path);

/* The names in FOLDER that end with ENDING, in the order of strcmp; none when there is no such
 * folder. */
struct error *folder_names(const char *folder, const char *ending, char ***names, int *count);
void names_free(char **names, int count);

/* FOLDER/NAME in fresh memory. */
char *path_join(const char *folder, const char *name);

#endif
