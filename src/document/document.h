/* A YAML file read against parameter tables: every mistake is found in one go and told with file,
 * line and column; and the reverse, values written as YAML with every default filled in. libfyaml
 * parses. */
#ifndef BOLIDE_DOCUMENT_H
#define BOLIDE_DOCUMENT_H

#include <stdio.h>

#include "base/parameter.h"

struct document;

/* Opens the YAML file PATH. The maps of the files that its key `include` names, one or a list, the
 * later over the earlier, their paths from its folder, are merged below its own. Then SETTINGS are
 * applied, COUNT texts `path.to.key=value` (the --set of the command line; the value is parsed as
 * YAML; a new key may be added where its map exists). The document may have maps of the keys
 * `short` and `long` at its top: that of OVERLAY, when it is one of the two, is merged over the
 * document before the settings; in any case both keys are removed. */
struct error *document_open(const char *path, const char *const *settings, int count,
                            const char *overlay, struct document **document);

/* The same from a text in memory, which can include nothing; NAME stands for the file's name in
 * messages. */
struct error *document_open_text(const char *text, const char *name, const char *const *settings,
                                 int count, const char *overlay, struct document **document);

void document_free(struct document *document);

/* Reads the whole document into the struct that TABLE describes. The key `let` at the top, a map of
 * expressions that may use earlier names, is consumed first and serves all expressions. All
 * mistakes come joined in one error: unknown key (with the nearest), missing key, wrong kind, wrong
 * dimension (with what was wanted), out of range, unknown choice, text where a list is wanted, ...
 * On an error VALUES is released. */
struct error *document_read(struct document *document, const struct parameter *table,
                            const struct catalogue *catalogue, void *values);

/* The same, but leaves in VALUES what could be read beside the mistakes, so that more can be said
 * about it; the caller releases it in any case. What could not be read is as if not given, or
 * zero. */
struct error *document_read_partly(struct document *document, const struct parameter *table,
                                   const struct catalogue *catalogue, void *values);

/* True when a reading found a mistake at PATH or below it; "" stands for the whole document. */
bool document_is_wrong(const struct document *document, const char *path);

/* An ERROR_INPUT located at the value of PATH ("bodies.flyer.velocity", list items by number), or
 * at its nearest ancestor that stands in the file: `case.yaml:14:9: bodies.flyer.velocity: ...`. */
struct error *document_error(const struct document *document, const char *path, const char *format,
                             ...) BOLIDE_PRINTF(3, 4);

/* True when PATH is given in the file (or by a setting), false when it stands on its default. */
bool document_has(const struct document *document, const char *path);

/* Writes VALUES as YAML, all defaults filled in, numbers in SI units with their unit and all their
 * digits, so that reading the text gives the same bits. */
struct error *document_write(FILE *file, const struct parameter *table, const void *values);

/* Writes `material, box, velocity`. */
void list_text(const char *const *names, int count, char *text, size_t size);

#endif
