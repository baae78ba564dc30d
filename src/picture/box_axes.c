/* The axes of a perspective: edges of the window's box. */
#include <stdio.h>

#include "picture/sheet.h"

static const struct colour line_colour = {0.75, 0.75, 0.75}, tick_colour = {0.35, 0.35, 0.35};

/* An edge of the box along AXIS; bits of CORNER say which, on the next and the last axis. */
struct edge {
    int axis, corner;
    double from[3], to[3];
    double x[2], y[2]; /* on the page */
    int faces;         /* of the two that meet in it so many look at the eye */
};

static void place_on_page(const struct box_axes *axes, const double at[3], double *x, double *y)
{
    view_project(axes->view, axes->projection, at, x, y);
    *x = axes->left + *x / axes->projection->density;
    *y = axes->top + *y / axes->projection->density;
}

static struct edge edge_of(const struct box_axes *axes, int axis, int corner)
{
    struct edge edge = {.axis = axis, .corner = corner};
    const struct view *view = axes->view;
    for (int k = 0; k < 2; k++) {
        const int other = (axis + 1 + k) % 3, high = corner >> k & 1;
        edge.from[other] = edge.to[other] =
            high ? view->window[other].high : view->window[other].low;
        /* the eye's own place tells, since the box is seen in perspective */
        const double off =
            view->parallel ? view->direction[other] : view->eye[other] - edge.from[other];
        edge.faces += high ? off > 0.0 : off < 0.0;
    }
    edge.from[axis] = view->window[axis].low;
    edge.to[axis] = view->window[axis].high;
    place_on_page(axes, edge.from, &edge.x[0], &edge.y[0]);
    place_on_page(axes, edge.to, &edge.x[1], &edge.y[1]);
    return edge;
}

static void stroke_edge(const struct canvas *canvas, const struct edge *edge)
{
    cairo_move_to(canvas->pen, edge->x[0], edge->y[0]);
    cairo_line_to(canvas->pen, edge->x[1], edge->y[1]);
    canvas_colour(canvas, line_colour);
    cairo_set_line_width(canvas->pen, 0.8);
    cairo_stroke(canvas->pen);
}

void box_axes_behind(const struct canvas *canvas, const struct box_axes *axes)
{
    for (int axis = 0; axis < 3; axis++)
        for (int corner = 0; corner < 4; corner++) {
            const struct edge edge = edge_of(axes, axis, corner);
            if (edge.faces < 2)
                stroke_edge(canvas, &edge);
        }
}

static void draw_ticks(const struct canvas *canvas, const struct box_axes *axes,
                       const struct edge *edge)
{
    const struct range range = axes->view->window[edge->axis];
    const double dx = edge->x[1] - edge->x[0], dy = edge->y[1] - edge->y[0];
    const double length = hypot(dx, dy);
    const double middle_x = 0.5 * (edge->x[0] + edge->x[1]);
    const double middle_y = 0.5 * (edge->y[0] + edge->y[1]);
    double box[3], box_x, box_y, out_x = -dy / length, out_y = dx / length;
    for (int k = 0; k < 3; k++)
        box[k] = 0.5 * (axes->view->window[k].low + axes->view->window[k].high);
    place_on_page(axes, box, &box_x, &box_y);
    if (out_x * (middle_x - box_x) + out_y * (middle_y - box_y) < 0.0) {
        out_x = -out_x;
        out_y = -out_y;
    }
    struct axis axis = {.range = range};
    static const char *const names[] = {"x", "y", "z"};
    axis_name(&axis, names[edge->axis], "m", range_reach(range));
    if (length < 30.0)
        return;
    axis.ticks = ticks_linear(range, axis.scale, (int)minimum(maximum(length / 36.0, 1.0), 10.0));
    for (int i = 0; i < axis.ticks.count; i++) {
        double at[3] = {edge->from[0], edge->from[1], edge->from[2]}, x, y;
        at[edge->axis] = axis.ticks.at[i];
        place_on_page(axes, at, &x, &y);
        cairo_move_to(canvas->pen, x, y);
        cairo_line_to(canvas->pen, x + 5.0 * out_x, y + 5.0 * out_y);
        canvas_colour(canvas, tick_colour);
        cairo_stroke(canvas->pen);
        canvas_text(
            canvas, TEXT_TICK,
            (struct text_place){x + 13.0 * out_x, y + 13.0 * out_y + 4.0, 0.5 - 0.5 * out_x, 60.0},
            axis.ticks.text[i]);
    }
    canvas_text(canvas, TEXT_LABEL,
                (struct text_place){middle_x + 38.0 * out_x, middle_y + 34.0 * out_y + 4.0,
                                    0.5 - 0.5 * out_x, 120.0},
                axis.label);
}

/* Ticks are on an edge of the outline, the lowest on the page, of equal ones the left one. */
void box_axes_before(const struct canvas *canvas, const struct box_axes *axes)
{
    for (int axis = 0; axis < 3; axis++) {
        struct edge best = {.axis = -1};
        double most = 0.0;
        for (int corner = 0; corner < 4; corner++) {
            const struct edge edge = edge_of(axes, axis, corner);
            const double low = 0.5 * (edge.y[0] + edge.y[1]) - 0.15 * (edge.x[0] + edge.x[1]);
            if (edge.faces == 1 && (best.axis < 0 || low > most)) {
                best = edge;
                most = low;
            }
        }
        if (best.axis < 0)
            continue;
        stroke_edge(canvas, &best);
        draw_ticks(canvas, axes, &best);
    }
}
