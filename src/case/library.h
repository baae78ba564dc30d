/* The material library: a folder of YAML files, one a material and named after it. A file says what
 * an entry of a case's `materials` says. */
#ifndef BOLIDE_LIBRARY_H
#define BOLIDE_LIBRARY_H

#include "case/case.h"

/* The names of the materials in FOLDER, sorted; ERROR_INPUT when it cannot be read. Free them with
 * library_names_free. */
struct error *library_names(const char *folder, struct name_list *names);
void library_names_free(struct name_list *names);

/* The file of material NAME in the first of COUNT folders that has it, NULL if none has; free
 * it. */
char *library_file(const char *const *folders, int count, const char *name);

/* `no material "x" in the library`, and the nearest that there is, those of whose names x is a
 * part, or all; free it. */
char *library_unknown(const char *const *folders, int count, const char *name);

/* Reads the file at PATH; all its mistakes come in one error. Release what it gives. */
struct error *library_read(const char *path, const struct catalogue *catalogue,
                           struct material_input *material);
void library_release(struct material_input *material);

/* MATERIAL at its reference density: without energy, or where no sound travels then, as in a gas,
 * with the energy of one standard atmosphere. False when there is no such state. */
bool library_rest(const struct material *material, struct point *point, struct response *response);

#endif
