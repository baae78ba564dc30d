/* Between the reader of cases and its check of meaning. */
#ifndef BOLIDE_CASE_INTERNAL_H
#define BOLIDE_CASE_INTERNAL_H

#include "model/case.h"

/* The format that this program reads. */
enum { CASE_FORMAT = 1 };

/* Checks what the tables cannot say of a case that has been read, names of materials and bodies, numbers
 * of components, states at the start, and fills what follows from it. All mistakes come joined. */
struct error *case_check_meaning(struct simulation_case *input);

/* The state at the start from what BODY gives of density, pressure and energy (NAN: not given), into
 * body->start. NULL, or a text (static) that tells what is wrong; *key is then the key that it is
 * about, "" for the body as a whole. */
const char *body_start_state(struct body_input *body, const struct material *material,
                             const char **key);

#endif
