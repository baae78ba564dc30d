/* A sweep of the Lax-Wendroff scheme along a row, with adaptive viscosity. Source: Cui,
 * dissertation (2014), section 2.6, (2-51) and (2-53)-(2-58), restored where the printed
 * formulas cannot hold:
 *
 *   viscosity (2-56)-(2-58): theta = | (|a| - |b|)/(|a| + |b|) |, a and b the steps of density to
 *     the next cell and from the last; the face between two cells has the k = eta max(theta) of both
 *     U := U + (k_high (U_next - U) - k_low (U - U_last))/2
 *   Richtmyer's two steps: U_h = (U + U_next)/2 - r/2 (f_next - f)
 *     U := U - r (f(U_h) - f(U_h of the face below))
 *
 * with r = dt/h. As printed the viscosity has theta of the cell at both faces, which does not
 * conserve, and the scheme r^2/2 (f_next - 2 f + f_last) for its second order, which lacks the
 * Jacobian. */
#ifndef BOLIDE_GAS_LAX_WENDROFF_H
#define BOLIDE_GAS_LAX_WENDROFF_H

#include "gas/row.h"

enum lax_wendroff_form { LAX_WENDROFF_RICHTMYER, LAX_WENDROFF_PRINTED };
enum lax_wendroff_viscosity { VISCOSITY_OF_FACES, VISCOSITY_OF_CELLS };

struct lax_wendroff {
    int form, viscosity; /* enum lax_wendroff_form, _viscosity */
    double eta;          /* of the viscosity */
};

/* theta of the cells FIRST to LAST. */
BOLIDE_INLINE void row_theta(const struct gas_numbers *u, int first, int last, double *theta)
{
    const double *density = u->of[GAS_DENSITY];
    FOR_ROW(k, first, last)
    {
        const double next = fabs(density[k + 1] - density[k]),
                     past = fabs(density[k] - density[k - 1]);
        theta[k] = fabs((next - past) / (next + past + 1e-30));
    }
}

/* Smooths cells -1 .. cells of a row. SMOOTHED may not be its own numbers. What the viscosity
 * carries through the faces 0 .. cells, per area and time, goes to FLUX; nothing where it is that
 * of cells. */
BOLIDE_INLINE void row_smooth(const struct gas_row *row, const struct lax_wendroff *scheme,
                              double r, struct gas_numbers *smoothed, struct gas_numbers *flux)
{
    const int cells = row->cells;
    const bool faces = scheme->viscosity == VISCOSITY_OF_FACES;
    double theta[ROW_ROOM], low[ROW_ROOM], high[ROW_ROOM];
    row_theta(&row->u, -2, cells + 1, theta);
    FOR_ROW(k, -1, cells)
    {
        low[k] = 0.5 * scheme->eta * (faces ? maximum(theta[k - 1], theta[k]) : theta[k]);
        high[k] = 0.5 * scheme->eta * (faces ? maximum(theta[k], theta[k + 1]) : theta[k]);
    }
    for (int n = 0; n < GAS_NUMBERS; n++) {
        const double *u = row->u.of[n];
        FOR_ROW(k, -1, cells)
        smoothed->of[n][k] = u[k] + (high[k] * (u[k + 1] - u[k]) - low[k] * (u[k] - u[k - 1]));
        FOR_ROW(k, 0, cells)
        flux->of[n][k] = faces ? -low[k] * (u[k] - u[k - 1]) / r : 0.0;
    }
}

/* Takes the cells of a row through a sweep of R = dt/h, and gives what flows through the faces
 * 0 .. cells, per area and time, in FLUX. Cells -3 .. cells + 2 are known. */
BOLIDE_INLINE void row_lax_wendroff(struct gas_row *row, const struct lax_wendroff *scheme,
                                    double r, struct gas_numbers *flux)
{
    const int cells = row->cells;
    struct gas_numbers smoothed, flow, half, through;
    double pressure[ROW_ROOM];
    row_smooth(row, scheme, r, &smoothed, flux);
    row_pressures(row->eos, &smoothed, -1, cells, pressure);
    row_flows(&smoothed, pressure, row->axis, -1, cells, &flow);
    if (scheme->form == LAX_WENDROFF_RICHTMYER) {
        for (int n = 0; n < GAS_NUMBERS; n++)
            FOR_ROW(k, 0, cells)
        half.of[n][k] = 0.5 * (smoothed.of[n][k - 1] + smoothed.of[n][k]) -
                        0.5 * r * (flow.of[n][k] - flow.of[n][k - 1]);
        row_pressures(row->eos, &half, 0, cells, pressure);
        row_flows(&half, pressure, row->axis, 0, cells, &through);
    } else
        for (int n = 0; n < GAS_NUMBERS; n++)
            FOR_ROW(k, 0, cells)
    through.of[n][k] =
        0.5 * (flow.of[n][k - 1] + flow.of[n][k]) - 0.5 * r * (flow.of[n][k] - flow.of[n][k - 1]);
    for (int n = 0; n < GAS_NUMBERS; n++) {
        FOR_ROW(k, 0, cells - 1)
        row->u.of[n][k] = smoothed.of[n][k] - r * (through.of[n][k + 1] - through.of[n][k]);
        FOR_ROW(k, 0, cells)
        flux->of[n][k] += through.of[n][k];
    }
}

#endif
