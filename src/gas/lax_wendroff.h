/* A sweep of the Lax-Wendroff scheme along a row, with adaptive viscosity. Source: Cui,
 * dissertation (2014), section 2.6, (2-51) and (2-53)-(2-58), restored where the printed formulas
 * cannot hold:
 *
 *   viscosity (2-56)-(2-58): theta = | (|a| - |b|)/(|a| + |b|) |, a and b the steps of density to
 *     the next cell and from the last; the face between two cells has the k = eta max(theta) of both
 *     U := U + (k_high (U_next - U) - k_low (U - U_last))/2
 *   Richtmyer's two steps: U_h = (U + U_next)/2 - r/2 (f_next - f)
 *     U := U - r (f(U_h) - f(U_h of the face below))
 *
 * with r = dt/h. As printed the viscosity has theta of the cell at both faces, which does not
 * conserve, and the scheme r^2/2 (f_next - 2 f + f_last) for its second order, which lacks
 * the Jacobian. A cell that a sweep would leave without density or energy has the fluxes of
 * Lax and Friedrichs, f = (f + f_next)/2 - s/2 (U_next - U) with s the fastest |u| + c, at
 * both its faces. */
#ifndef BOLIDE_GAS_LAX_WENDROFF_H
#define BOLIDE_GAS_LAX_WENDROFF_H

#include "gas/row.h"

enum lax_wendroff_form { LAX_WENDROFF_RICHTMYER, LAX_WENDROFF_PRINTED };
enum lax_wendroff_viscosity { VISCOSITY_OF_FACES, VISCOSITY_OF_CELLS };

struct lax_wendroff {
    int form, viscosity; /* enum lax_wendroff_form, _viscosity */
    double eta;          /* of the viscosity */
    bool guarded;        /* against cells without density or energy */
};

/* theta of the cells FIRST to LAST. */
BOLIDE_INLINE void row_theta(const struct gas_numbers *u, int first, int last, double *theta)
{
    const double *density = u->of[GAS_DENSITY];
    FOR_ROW (k, first, last) {
        const double next = fabs(density[k + 1] - density[k]),
                     past = fabs(density[k] - density[k - 1]);
        theta[k] = fabs((next - past) / (next + past + 1e-30));
    }
}

/* Pressures of the cells FIRST to LAST of a row, or where FACES is 1 of what flows through the
 * faces below them: between different materials with the mean of what p/(rho e) cells had before
 * the step. */
BOLIDE_INLINE void row_wendroff_pressures(const struct gas_row *row, const struct gas_numbers *u,
                                          int first, int last, int faces, double *pressure)
{
    struct row_values values;
    struct gas_content content = {.kind = NULL};
    double energy[ROW_ROOM] = {0.0}, gamma[ROW_ROOM];
    uint8_t kind[ROW_ROOM];
    if (row->closure.other) {
        FOR_ROW (k, first, last) {
            const double *fraction = row->part[PART_FRACTION];
            const uint8_t below = content_kind_of(fraction[k - faces]);
            kind[k] = below == content_kind_of(fraction[k]) ? below : CONTENT_BOTH;
            gamma[k] = 0.5 * (row->gamma[k - faces] + row->gamma[k]);
        }
        content.kind = kind;
        content.gamma = gamma;
    }
    row_energies(u, first, last, energy);
    gas_evaluate(&row->closure, &content, u->of[GAS_DENSITY], energy, first, last, &values);
    FOR_ROW (k, first, last)
        pressure[k] = values.pressure[k];
}

/* Smooths cells -2 .. cells + 1 of a row. SMOOTHED may not be its own numbers. What the viscosity
 * carries through the faces -1 .. cells + 1, per area and time, goes to FLUX; nothing where it is
 * that of cells. */
BOLIDE_INLINE void row_smooth(const struct gas_row *row, const struct lax_wendroff *scheme,
                              double r, struct gas_numbers *smoothed, struct gas_numbers *flux)
{
    const int cells = row->cells;
    const bool faces = scheme->viscosity == VISCOSITY_OF_FACES;
    double theta[ROW_ROOM], low[ROW_ROOM], high[ROW_ROOM];
    row_theta(&row->u, -3, cells + 2, theta);
    FOR_ROW (k, -2, cells + 1) {
        low[k] = 0.5 * scheme->eta * (faces ? maximum(theta[k - 1], theta[k]) : theta[k]);
        high[k] = 0.5 * scheme->eta * (faces ? maximum(theta[k], theta[k + 1]) : theta[k]);
    }
    for (int n = 0; n < GAS_NUMBERS; n++) {
        const double *u = row->u.of[n];
        if (row->round && faces)
            FOR_ROW (k, -2, cells + 1) {
                const double below = low[k] * (u[k] - u[k - 1]),
                             above = high[k] * (u[k + 1] - u[k]);
                smoothed->of[n][k] =
                    u[k] +
                    (row_area(row, k + 1) * above - row_area(row, k) * below) / row_size(row, k);
            }
        else
            FOR_ROW (k, -2, cells + 1)
                smoothed->of[n][k] =
                    u[k] + (high[k] * (u[k + 1] - u[k]) - low[k] * (u[k] - u[k - 1]));
        FOR_ROW (k, -1, cells + 1)
            flux->of[n][k] = faces ? -low[k] * (u[k] - u[k - 1]) / r : 0.0;
    }
}

/* What flows through the faces -1 .. cells + 1 of SMOOTHED cells in which FLOW flows, and the mean
 * pressures of cells -1 .. cells. */
BOLIDE_INLINE void row_through(const struct gas_row *row, const struct lax_wendroff *scheme,
                               double r, const struct gas_numbers *smoothed,
                               const struct gas_numbers *flow, const double *pressure,
                               struct gas_numbers *through, double *push)
{
    const int cells = row->cells;
    struct gas_numbers half;
    double middle[ROW_ROOM];
    if (scheme->form == LAX_WENDROFF_PRINTED) {
        for (int n = 0; n < GAS_NUMBERS; n++)
            FOR_ROW (k, -1, cells + 1)
                through->of[n][k] = 0.5 * (flow->of[n][k - 1] + flow->of[n][k]) -
                                    0.5 * r * (flow->of[n][k] - flow->of[n][k - 1]);
        FOR_ROW (k, -1, cells)
            push[k] = pressure[k];
        return;
    }
    for (int n = 0; n < GAS_NUMBERS; n++)
        FOR_ROW (k, -1, cells + 1) {
            half.of[n][k] = 0.5 * (smoothed->of[n][k - 1] + smoothed->of[n][k]) -
                            0.5 * r * (flow->of[n][k] - flow->of[n][k - 1]);
            if (row->round && row_radius(row, k) > 0.0) {
                double spread = 0.5 * (flow->of[n][k - 1] + flow->of[n][k]);
                if (n == GAS_MOMENTUM + row->axis)
                    spread -= 0.5 * (pressure[k - 1] + pressure[k]);
                half.of[n][k] -= 0.5 * r * spread * (double)row->round / row_radius(row, k);
            }
        }
    row_wendroff_pressures(row, &half, -1, cells + 1, 1, middle);
    row_flows(&half, middle, row->axis, -1, cells + 1, through);
    FOR_ROW (k, -1, cells)
        push[k] = 0.5 * (middle[k] + middle[k + 1]);
}

/* Energy per volume, less that of the motion, in cell K. */
BOLIDE_INLINE double gas_heat(const struct gas_numbers *u, int k)
{
    double momentum = 0.0;
    for (int n = GAS_MOMENTUM; n < GAS_ENERGY; n++)
        momentum += square(u->of[n][k]);
    return u->of[GAS_ENERGY][k] - 0.5 * momentum / u->of[GAS_DENSITY][k];
}

/* Whether a cell with the numbers TO, which had FROM, has lost its density or its energy. */
BOLIDE_INLINE bool gas_is_lost(const struct gas_numbers *from, const struct gas_numbers *to, int k)
{
    return !(to->of[GAS_DENSITY][k] > 0.2 * from->of[GAS_DENSITY][k]) ||
           (!(gas_heat(to, k) > 0.0) && gas_heat(from, k) > 0.0);
}

/* Puts Lax and Friedrichs' fluxes through both faces of the cells -1 .. cells that are lost;
 * whether there are any. */
BOLIDE_INLINE bool row_guard(const struct gas_row *row, const struct gas_numbers *smoothed,
                             const struct gas_numbers *flow, const double *pressure,
                             const struct gas_numbers *to, struct gas_numbers *through)
{
    const double none[POINT_HISTORY] = {0.0};
    bool any = false;
    FOR_ROW (k, -1, row->cells)
        any |= gas_is_lost(smoothed, to, k);
    if (!any)
        return false;
    FOR_ROW (k, 0, row->cells) {
        double speed = 0.0;
        if (!gas_is_lost(smoothed, to, k - 1) && !gas_is_lost(smoothed, to, k))
            continue;
        for (int side = k - 1; side <= k; side++) {
            const double density = smoothed->of[GAS_DENSITY][side],
                         u = smoothed->of[GAS_MOMENTUM + row->axis][side] / density;
            double kinetic = 0.0;
            for (int n = GAS_MOMENTUM; n < GAS_ENERGY; n++)
                kinetic += 0.5 * square(smoothed->of[n][side] / density);
            const double energy = smoothed->of[GAS_ENERGY][side] / density - kinetic;
            const struct eos_value value = eos_evaluate(row->closure.eos, density, energy, none);
            const double sound =
                row->closure.other
                    ? 4.0 * fabs(pressure[side]) / density /* above any of products */
                    : eos_sound_square(value.pressure, value.dp_drho, value.dp_de, density);
            speed = maximum(speed, fabs(u) + sqrt(maximum(sound, 0.0)));
        }
        for (int n = 0; n < GAS_NUMBERS; n++)
            through->of[n][k] = 0.5 * (flow->of[n][k - 1] + flow->of[n][k]) -
                                0.5 * speed * (smoothed->of[n][k] - smoothed->of[n][k - 1]);
    }
    return true;
}

/* Takes the cells of a row through a sweep of R = dt/h, and gives what flows through the faces
 * 0 .. cells, per area and time, in FLUX. Cells -4 .. cells + 3 are known. */
BOLIDE_INLINE void row_lax_wendroff(struct gas_row *row, const struct lax_wendroff *scheme,
                                    double r, struct gas_numbers *flux)
{
    const int cells = row->cells, more = scheme->guarded ? 1 : 0;
    struct gas_numbers smoothed, flow, through, to;
    double pressure[ROW_ROOM], push[ROW_ROOM];
    row_smooth(row, scheme, r, &smoothed, flux);
    row_wendroff_pressures(row, &smoothed, -2, cells + 1, 0, pressure);
    row_flows(&smoothed, pressure, row->axis, -2, cells + 1, &flow);
    row_through(row, scheme, r, &smoothed, &flow, pressure, &through, push);
    row_advance(row, &smoothed, &through, push, r, -more, cells - 1 + more, &to);
    if (scheme->guarded && row_guard(row, &smoothed, &flow, pressure, &to, &through))
        row_advance(row, &smoothed, &through, push, r, 0, cells - 1, &to);
    row_keep_push(row, push);
    for (int n = 0; n < GAS_NUMBERS; n++) {
        FOR_ROW (k, 0, cells - 1)
            row->u.of[n][k] = to.of[n][k];
        FOR_ROW (k, 0, cells)
            flux->of[n][k] += through.of[n][k];
    }
}

#endif
