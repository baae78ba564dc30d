/* What a resumed run may have otherwise than before: the difference of two cases as run, key by
 * key, and the class of each key (enum parameter_change), which its table gives. */
#ifndef BOLIDE_CHANGES_H
#define BOLIDE_CHANGES_H

#include "base/parameter.h"

struct node;

/* KEY by its path, "run.until". BEFORE and AFTER are what it is in one line, "" where the key or
 * the entry of a map is not there. */
struct case_change {
    char *key, *before, *after;
    enum parameter_change class; /* never CHANGE_AS_AROUND */
};

struct case_changes {
    int count;
    int64_t room;
    struct case_change *item;
    struct node *before; /* the earlier case; owned */
};

/* Compares two cases as run (case_write) by TABLE, that of a case. ERROR_SYSTEM where one is not
 * YAML. */
struct error *case_compare(const char *before, const char *after, const struct parameter *table,
                           const struct catalogue *catalogue, struct case_changes *changes);
void case_changes_free(struct case_changes *changes);

/* "never", "from here", "freely". */
const char *case_change_class(enum parameter_change class);

/* How many entries the map KEY of the earlier case had, and the place of NAME among them; -1: it
 * had none. */
int case_changes_entries(const struct case_changes *changes, const char *key);
int case_changes_place(const struct case_changes *changes, const char *key, const char *name);

/* Whether something in the entry NAME of the map KEY has changed, but for the entries of EXCEPT,
 * ended by NULL. */
bool case_changes_in(const struct case_changes *changes, const char *key, const char *name,
                     const char *const *except);

#endif
