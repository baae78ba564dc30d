/* A document as a tree of nodes, each with its place in a file: for what changes a document before
 * it is read, as the sweep of a case does. */
#ifndef BOLIDE_DOCUMENT_NODES_H
#define BOLIDE_DOCUMENT_NODES_H

#include "document/document.h"

/* Names that a map may have for its keys. */
enum { KEYS_MAX = 64 };

enum node_kind { NODE_SCALAR, NODE_LIST, NODE_MAP };

/* Where something stands. Origin is a file's name or a whole setting (`--set run.until=3 us`, whose
 * line is 0). Lines and columns count from 1. */
struct mark {
    const char *origin;
    int line, column;
};

struct node {
    enum node_kind kind;
    bool plain;   /* SCALAR without quotes */
    bool implied; /* MAP that a setting's path made on its way */
    bool broken;  /* MAP whose mistake has been told: known by its name, not read */
    bool removes; /* SCALAR without text, in the place of a value that it takes out */
    bool foreign; /* from a file of the library, where the names of `let` mean nothing */
    char *text;   /* SCALAR */
    char *key;    /* of an entry of a map */
    struct mark place, key_place;
    int count;
    struct node **child; /* LIST, MAP */
};

struct document {
    struct node *root;
    const char *overlay; /* static: the key of what was laid over it; NULL: nothing was */
    int origin_count;
    char **origins; /* what the places point to */
    int wrong_count, wrong_room;
    char **wrong;            /* paths that a reading complained about, and what they are in */
    struct name_index marks; /* of these */
};

/* Parses TEXT as one YAML document. LOCATED says whether lines of TEXT mean something to the
 * user. */
struct error *node_parse(const char *text, size_t length, const char *origin, bool located,
                         struct node **root);
void node_free(struct node *node);

/* An error at PLACE if TEXT holds control characters; in what is no KEY tabs and line breaks may
 * stand. */
struct error *refuse_controls(struct mark place, const char *text, bool key);

struct node *node_new(enum node_kind kind, struct mark place);
/* With all below it; NULL when memory is out. */
struct node *node_copy(const struct node *node);

/* Appends CHILD, which PARENT then owns; false (and CHILD freed) when memory is out. */
bool node_append(struct node *parent, struct node *child);

/* The entry KEY of a map, NULL if there is none. */
struct node *node_entry(const struct node *map, const char *key);

/* Takes the entry or item at INDEX out of PARENT. */
struct node *node_take(struct node *parent, int index);

/* True for a scalar that says nothing: empty, `~` or `null`. */
bool node_is_empty(const struct node *node);

/* TEXT (taken, NULL: memory was out), which then lives as long as the document; NULL when memory is
 * out. */
const char *document_keep(struct document *document, char *text);

/* Reads the file PATH, and the files that it includes below its own entries, into the document's
 * root. Mistakes of any of them come joined. INCLUDE, a file or a list of files, replaces what the
 * file PATH includes, unless it is NULL. */
struct error *document_load(struct document *document, const char *path,
                            const struct node *include);

/* document_open with such an INCLUDE, which may be part of another document. */
struct error *document_open_with(const char *path, const struct node *include,
                                 const char *const *settings, int count, const char *overlay,
                                 struct document **document);

/* Puts the entries of OVER, which is emptied, over those of BASE; maps within maps merge. */
struct error *node_merge(struct node *base, struct node *over);

/* ERROR_INPUT at PLACE: `file:line:column: path: message`. PATH may be empty. */
struct error *place_error(struct mark place, const char *path, const char *format, ...)
    BOLIDE_PRINTF(3, 4);
struct error *place_verror(struct mark place, const char *path, const char *format,
                           va_list arguments);

/* The node at PATH or its nearest ancestor; *exact tells which. */
const struct node *document_find(const struct document *document, const char *path, bool *exact);

/* Puts *VALUE, which it takes, at PATH as a setting does. */
struct error *document_set(struct document *document, const char *path, struct node **value);

/* What TEXT comes to with the names of `let`. */
struct error *document_evaluate(const struct document *document, const char *text,
                                struct quantity *quantity);

/* Where to point for a node: at the key of a map, at the value of anything else. */
struct mark node_place(const struct node *node);

/* Puts under the map at PATH, an entry of the document, the entries of LIBRARY that it lacks. Where
 * both have a map they merge in the same way if they share a key; else that of the document stands
 * alone, so that another choice replaces the library's. LIBRARY is emptied, its places live on in
 * DOCUMENT. */
struct error *document_include(struct document *document, struct node *map,
                               struct document *library);

#endif
