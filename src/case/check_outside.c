/* What the tables cannot say of what acts on a case from outside: loads, driven bodies,
 * gravity. */
#include "case/checking.h"
#include "exact/kingery_curves.h"
#include "shape/shape.h"

/* The farthest distance of BOUNDS from PLACE. */
static double farthest_from(const struct bounds *bounds, const struct vector_value *place)
{
    double far = 0.0;
    for (int k = 0; k < place->count; k++)
        far += square(maximum(fabs(vec3_at(bounds->low, k) - place->at[k]),
                              fabs(vec3_at(bounds->high, k) - place->at[k])));
    return sqrt(far);
}

static void check_blast(struct checking *checking, const struct load_input *load)
{
    const struct simulation_case *input = checking->input;
    const struct blast_input *blast = &load->blast;
    const enum kingery_charge charge = (enum kingery_charge)blast->charge;
    if (isnan(blast->mass) || blast->at.count == 0) {
        case_wrong(checking, "blast", "this needs the `mass` of the charge and where it is, `at`");
        return;
    }
    if (!case_dimension_known(checking) ||
        !case_check_components(checking, "blast.at", blast->at.count) || load->body < 0 ||
        !case_body(input, load->body)->shape.choice)
        return;
    const struct bounds bounds = shape_bounds(&case_body(input, load->body)->shape);
    const double size = cbrt(blast->mass), low = kingery_nearest(charge) * size,
                 high = kingery_farthest(charge) * size;
    const double nearest = bounds_distance(&bounds, vector_at(blast->at.at), blast->at.count),
                 farthest = farthest_from(&bounds, &blast->at);
    if (nearest < low || (isfinite(farthest) && farthest > high))
        case_wrong(checking, "blast",
                   "the curves for this mass go from %.3g to %.3g m; the body is %.3g to %.3g m "
                   "from the charge",
                   low, high, nearest, farthest);
}

static void check_record(struct checking *checking, const struct load_input *load)
{
    if (!load->record.from || !load->record.probe)
        case_wrong(checking, "record", "this needs `from`, the case, and `probe`, its line");
    else if (load->side < 0)
        case_wrong(checking, "record",
                   "this needs `side`: the pressure acts on one face of the body, not all around");
    if (load->record.center.count)
        case_check_components(checking, "record.center", load->record.center.count);
}

void case_check_load(struct checking *checking, int index)
{
    const struct simulation_case *input = checking->input;
    struct load_input *load = case_load(input, index);
    load->body = -1;
    if (load->on)
        load->body = case_find_name(checking, &input->bodies, "body", load->on, "on");
    if (load->body >= 0) {
        const struct body_input *body = case_body(input, load->body);
        if (body->driven || body->frozen || body->stop <= 0.0)
            case_wrong(checking, "on", "this body keeps its velocity whatever pushes: `%s`",
                       body->driven   ? "driven"
                       : body->frozen ? "frozen"
                                      : "stop");
    }
    case_check_axis(checking, "axis", load->axis);
    case_check_between(checking, &load->between);
    if (load->side < 0 && load->traction.count)
        load->side = SIDE_HIGH;
    if (case_is_wrong(checking, ""))
        return;
    const bool blast = !isnan(load->blast.mass) || load->blast.at.count > 0;
    const bool record = load->record.from || load->record.probe;
    if (field_is_given(&load->pressure) + (load->traction.count > 0) + blast + record != 1)
        case_wrong(checking, "", "give one of `pressure`, `traction`, `blast` and `record`");
    else if (blast)
        check_blast(checking, load);
    else if (record)
        check_record(checking, load);
    else if (load->traction.count && load->between.count == 0)
        case_wrong(
            checking, "traction",
            "this needs `between`: the body has another end, which the traction must not pull");
    else if (load->traction.count)
        case_check_components(checking, "traction", load->traction.count);
    if (load->before <= load->after)
        case_wrong(checking, "before", "this must be later than `after`");
}

static double speed_at(const struct field_value *velocity, double time)
{
    const double speed = fabs(field_at(velocity, vec3_make(0.0, 0.0, 0.0), time));
    return isnan(speed) ? INFINITY : speed;
}

/* Where VELOCITY is largest between LOW and HIGH, if it has one maximum there; a pole is one. */
static double time_of_peak(const struct field_value *velocity, double low, double high)
{
    for (int i = 0; i < 100; i++) {
        const double third = (high - low) / 3.0;
        if (speed_at(velocity, low + third) < speed_at(velocity, high - third))
            low += third;
        else
            high -= third;
    }
    return 0.5 * (low + high);
}

/* A time up to END at which VELOCITY is that of light or more; NAN: none was found. Each maximum of
 * the speed at equal intervals is looked at closely. */
static double time_of_light(const struct field_value *velocity, double end)
{
    enum { INTERVALS = 200 };
    const double interval = end / INTERVALS;
    double before = 0.0, here = speed_at(velocity, 0.0);
    for (int i = 0; i <= INTERVALS; i++) {
        const double after = i < INTERVALS ? speed_at(velocity, (i + 1) * interval) : 0.0;
        if (here >= before && here >= after && here > 0.0) {
            const double peak = time_of_peak(velocity, maximum(0.0, (i - 1) * interval),
                                             minimum(end, (i + 1) * interval));
            if (speed_at(velocity, peak) >= SPEED_OF_LIGHT)
                return peak;
        }
        before = here;
        here = after;
    }
    return NAN;
}

/* What moves must not come to a time at which it would be infinitely fast, or beyond it. */
static void check_speed(struct checking *checking, const struct body_input *body, int axis,
                        const char *key)
{
    const struct field_value *velocity = &body->velocity.at[axis];
    const double until = checking->input->run.until;
    const double end = body->stop < until ? body->stop : until;
    if (!(end > 0.0 && end < INFINITY) || document_is_wrong(checking->input->document, "run"))
        return;
    const double time = time_of_light(velocity, end);
    if (!isnan(time))
        case_wrong(checking, key,
                   "this is faster than light at t = %.6g s: end the motion (`stop`) or the run "
                   "before that, or give a velocity that stays finite",
                   time);
}

void case_check_driven(struct checking *checking, const struct body_input *body)
{
    char key[PATH_TEXT];
    for (int i = 0; i < body->velocity.count; i++) {
        const struct field_value *velocity = &body->velocity.at[i];
        snprintf(key, sizeof key, "velocity.%d", i + 1);
        if (!field_is_of_time(velocity))
            continue;
        if (!body->driven)
            case_wrong(
                checking, key,
                "only a body with `driven: yes` may have a velocity that depends on the time t");
        else
            check_speed(checking, body, i, key);
        for (int axis = 0; axis < 3; axis++)
            if (varying_expression_uses(velocity->varying, axis))
                case_wrong(checking, key,
                           "this depends on the time t and cannot depend on the position %c",
                           "xyz"[axis]);
    }
}

void case_check_gravity(struct checking *checking)
{
    const struct simulation_case *input = checking->input;
    const struct vector_value *gravity = &input->gravity;
    checking->map = "gravity";
    if (!case_dimension_known(checking) || gravity->count == 0)
        return;
    if (case_check_components(checking, "", gravity->count) &&
        geometry_power(input->geometry) > 0 && gravity->at[0] != 0.0)
        case_wrong(checking, "1", "gravity that is symmetric about the axis points along it");
}
