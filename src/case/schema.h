/* The JSON Schema of a case file, made from the parameter tables and the catalogue, so that an
 * editor completes keys, shows their help and marks mistakes while one types. */
#ifndef BOLIDE_SCHEMA_H
#define BOLIDE_SCHEMA_H

#include <stdio.h>

#include "base/parameter.h"

/* Writes the schema (draft 2020-12) of a case whose things CATALOGUE holds. It takes what the
 * reader takes as far as a schema can tell; what an expression means is for the reader alone.
 * ERROR_SYSTEM when FILE cannot be written. */
struct error *schema_write(FILE *file, const struct catalogue *catalogue);

#endif
