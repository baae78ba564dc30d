/* What is known from the start of loads without effect; see loads.h. */
#include "exact/kingery_curves.h"
#include "model/loads.h"

/* What of a surface a load meets at the start. */
struct meeting {
    double low, high;        /* of the free surface along the axis of the load */
    int64_t between, chosen; /* free elements in its range; of these, on its side */
    int64_t other;           /* of these, on the other side */
    int64_t facing;          /* chosen ones that face the charge of a blast */
    double first, last;      /* when the wave arrives, and when its positive phase is over, s */
    double duration;         /* of the positive phase where it arrives first */
};

static void meet_wave(const struct blast_input *blast, const struct surface_state *state,
                      struct meeting *meeting)
{
    double distance;
    if (!(blast_cosine(blast, state, &distance) > 0.0))
        return;
    const struct blast_wave wave =
        kingery_wave((enum kingery_charge)blast->charge, blast->mass, distance, true);
    const double duration = isnan(wave.duration) ? INFINITY : wave.duration;
    if (meeting->facing++ == 0 || wave.arrival + blast->time < meeting->first) {
        meeting->first = wave.arrival + blast->time;
        meeting->duration = duration;
    }
    meeting->last = maximum(meeting->last, wave.arrival + duration + blast->time);
}

static struct meeting meet(const struct load_input *load, const struct body_surface *surface)
{
    struct meeting meeting = {.low = INFINITY, .high = -INFINITY, .last = -INFINITY};
    struct load_input everywhere = *load, any_side = *load;
    everywhere.between.count = 0;
    everywhere.side = any_side.side = -1;
    for (int32_t e = 0; e < surface->elements; e++) {
        const struct surface_element *element = &surface->element[e];
        const double x = vec3_at(element->start.place, load->axis),
                     to = vec3_at(element->start.normal, load->axis);
        if (!load_takes(&everywhere, element))
            continue;
        meeting.low = minimum(meeting.low, x);
        meeting.high = maximum(meeting.high, x);
        if (!load_takes(&any_side, element))
            continue;
        meeting.between++;
        meeting.other += load->side == SIDE_HIGH ? to < -0.5 : load->side == SIDE_LOW && to > 0.5;
        if (!load_takes(load, element))
            continue;
        meeting.chosen++;
        if (load_is_blast(load))
            meet_wave(&load->blast, &element->start, &meeting);
    }
    return meeting;
}

/* Of when the wave of a blast comes. */
static void judge_wave(struct findings *findings, int index, const struct meeting *meeting)
{
    const struct simulation_case *input = findings->input;
    const struct load_input *load = case_load(input, index);
    const char *name = input->loads.names[index];
    const double end = load->before < input->run.until ? load->before : input->run.until;
    if (meeting->facing == 0)
        finding_add(findings, FINDING_NO_EFFECT, "loads", name,
                    "it does nothing: the surface that it names faces away from the charge");
    else if (meeting->first >= end)
        finding_add(findings, FINDING_NO_EFFECT, "loads", name,
                    "it does nothing: the blast wave arrives at t = %.4g s, after the end at "
                    "%.4g s",
                    meeting->first, end);
    else if (meeting->last <= load->after)
        finding_add(findings, FINDING_NO_EFFECT, "loads", name,
                    "it does nothing: the positive phase of the blast is over at t = %.4g s, "
                    "before the load starts at %.4g s",
                    meeting->last, load->after);
    else if (meeting->first < load->after - 0.01 * meeting->duration)
        finding_add(findings, FINDING_NO_EFFECT, "loads", name,
                    "the blast wave arrives at t = %.4g s, before the load starts at %.4g "
                    "s: the impulse until then is missing; move `blast.time`",
                    meeting->first, load->after);
}

static void judge_load(struct findings *findings, int index, const struct body_surface *surface)
{
    const struct simulation_case *input = findings->input;
    const struct load_input *load = case_load(input, index);
    const char *name = input->loads.names[index];
    const struct meeting meeting = meet(load, surface);
    if (load->after >= input->run.until)
        finding_add(findings, FINDING_NO_EFFECT, "loads", name,
                    "it does nothing: it starts at %.4g s, and the run ends at %.4g s", load->after,
                    input->run.until);
    else if (!(meeting.low <= meeting.high))
        finding_add(findings, FINDING_NO_EFFECT, "loads", name,
                    "it does nothing: body \"%s\" has no free surface", load->on);
    else if (meeting.between == 0)
        finding_add(findings, FINDING_NO_EFFECT, "loads", name,
                    "it does nothing: `between` is from %.6g m to %.6g m, and the surface of "
                    "body \"%s\" is from %.6g m to %.6g m along %c",
                    load->between.at[0], load->between.at[1], load->on, meeting.low, meeting.high,
                    "xyz"[load->axis]);
    else if (meeting.chosen == 0)
        finding_add(findings, FINDING_NO_EFFECT, "loads", name,
                    "it does nothing: no surface of body \"%s\" there faces `side: %s`", load->on,
                    load->side == SIDE_HIGH ? "high" : "low");
    else if (load_is_blast(load)) {
        judge_wave(findings, index, &meeting);
        return;
    }
    if (load->traction.count > 0 && meeting.other > 0)
        finding_add(findings, FINDING_NO_EFFECT, "loads", name,
                    "`between` holds both faces of body \"%s\", and the force on one takes "
                    "away that on the other: end it inside the body",
                    load->on);
}

void loads_judge(struct findings *findings)
{
    const struct simulation_case *input = findings->input;
    const struct place whole = place_whole(input);
    for (int i = 0; i < input->loads.count; i++) {
        struct body_surface surface;
        struct error *error = surface_create(&whole, case_load(input, i)->body, &surface);
        if (!error)
            judge_load(findings, i, &surface);
        error_free(error); /* of the body, and reported where it is filled */
        surface_free(&surface);
    }
}
