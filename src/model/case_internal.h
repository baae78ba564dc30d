/* Between the reader of cases and its check of meaning. */
#ifndef BOLIDE_CASE_INTERNAL_H
#define BOLIDE_CASE_INTERNAL_H

#include "model/case.h"

/* The format that this program reads. */
enum { CASE_FORMAT = 1 };

/* An entry of `materials`, and a file of the library. */
extern const struct parameter case_material_table[];

/* Fills material->material, plain data, from what was read. */
void case_fill_material(struct material_input *material);

/* Takes the sweep out of the document and tells its mistakes; puts the values of its run RUN, 1 to
 * sweep_runs, where they belong. 0: none of them. */
struct error *case_take_sweep(struct simulation_case *input, int run);

/* Fills the quantities of the values of a case that has been read. */
void case_measure_sweep(struct simulation_case *input);

/* Checks what the tables cannot say of a case that has been read, names of materials and bodies, numbers
 * of components, states at the start, and fills what follows from it. All mistakes come joined. Of a case
 * that was read with mistakes it checks the rest. */
struct error *case_check_meaning(struct simulation_case *input);

/* The state at the start from what BODY gives of density, pressure and energy (NAN: not given), into
 * body->start. NULL, or a text (static) that tells what is wrong; *key is then the key that it is
 * about, "" for the body as a whole. */
const char *body_start_state(struct body_input *body, const struct material *material,
                             const char **key);

#endif
