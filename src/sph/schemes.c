/* The schemes that a case can name. To add one: its folder, and its line here. */
#include "sph/contact/contact.h"
#include "sph/hllc/hllc.h"
#include "sph/monaghan/monaghan.h"
#include "sph/muscl/muscl.h"
#include "sph/standard/standard.h"

const struct choice sph_scheme_choices[SPH_SCHEMES] = {
    {"muscl", "second-order contact SPH: Riemann problems between states with limited slopes",
     muscl_table, sizeof(struct muscl_options), &muscl_scheme},
    {"contact", "first-order contact SPH: a Riemann problem between each pair of particles",
     contact_table, sizeof(struct contact_options), &contact_scheme},
    {"standard", "classical SPH with artificial viscosity", standard_table,
     sizeof(struct standard_options), &standard_scheme},
    {"hllc", "SPH with corrected gradients and elastic-plastic Riemann problems", hllc_table,
     sizeof(struct hllc_options), &hllc_scheme},
    {"monaghan", "SPH with corrected gradients and artificial viscosity", monaghan_table,
     sizeof(struct monaghan_options), &monaghan_scheme},
};

/* All fields that SPH may add to the store. */
const struct field_row *const sph_field_tables[] = {sph_rows, muscl_rows, hllc_rows, NULL};
