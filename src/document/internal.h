/* A reading in progress, and the mistakes that it finds. Private to this folder. */
#ifndef BOLIDE_DOCUMENT_INTERNAL_H
#define BOLIDE_DOCUMENT_INTERNAL_H

#include "document/nodes.h"

/* A path as the reader descends: `bodies.flyer.velocity`, items of lists by number from 1. */
struct path {
    const struct path *parent;
    const char *key; /* NULL: an item of a list */
    int item;
};

/* A reading in progress: what it looks things up in, and the mistakes found so far. */
struct reading {
    struct document *document;
    const struct catalogue *catalogue;
    struct named_quantities names; /* of `let`; the value NAN: its expression is wrong */
    struct named_quantity *name;   /* the same */
    int wrong_names;               /* how many of them are wrong */
    const struct node *let;        /* where they stand; NULL: nowhere */
    struct error *error;
};

/* Bytes of a piece of a message. */
enum { TEXT_MAX = 256 };

/* Notes that PATH has a mistake, told here or elsewhere (document_is_wrong). */
void mark_wrong(struct reading *reading, const struct path *path);

/* Adds a mistake at PLACE of PATH. */
void complain(struct reading *reading, struct mark place, const struct path *path,
              const char *format, ...) BOLIDE_PRINTF(4, 5);
void complain_memory(struct reading *reading);

/* "WANTED is wanted, found a list". */
void complain_kind(struct reading *reading, const struct node *node, const struct path *path,
                   const char *wanted);

/* "WHAT "word" (did you mean "world"?)", or the names that are known. */
void complain_unknown(struct reading *reading, struct mark place, const struct path *path,
                      const char *what, const char *word, const char *const *names, int count);

/* The path that UNKNOWN, an entry at the top of a document that TABLE describes, may be meant for:
 * that of an entry or a key of its name further down. In fresh memory; NULL when there is none. */
/* Writes PATH, of which NULL is the whole document, into the SIZE bytes of TEXT; returns the
 * length. */
size_t path_text(const struct path *path, char *text, size_t size);

/* The path of a key NAME within the choices of TABLE, which is at PREFIX; NULL when there is none.
 * Owned by the caller. */
char *document_suggest_inside(const struct reading *reading, const struct parameter *table,
                              const char *name, const char *prefix);

char *document_suggest(const struct reading *reading, const struct parameter *table,
                       const struct node *unknown);

/* Makes of *PATH, the name of a file at PLACE, its name as seen from the folder of the file of that
 * place, or, in a setting, from the working folder; absolute if there is such a file. False when
 * memory is out. */
bool make_path_whole(struct mark place, char **path);

/* Any expression. WANTED says what, for a node that is none. False after a complaint,
 * or where the expression rests on a name that was complained about. */
bool read_quantity(struct reading *reading, const struct node *node, const struct path *path,
                   const char *wanted, struct quantity *quantity);

/* A value that stands by itself: every kind but TABLE, ONE_OF, LIST and MAP. */
void read_scalar(struct reading *reading, const struct node *node, const struct path *path,
                 const struct parameter *parameter, void *value);

#endif
