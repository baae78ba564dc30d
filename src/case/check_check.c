/* What the tables cannot say of checks: their limits, what they are relative to, and the study that
 * they serve. */
#include <string.h>

#include "case/checking.h"

static bool is_given(const struct quantity *quantity) { return !isnan(quantity->value); }

static bool is_number(const struct quantity *quantity)
{
    return dimension_equal(quantity->dimension, (struct dimension){0});
}

/* The measure's own dimension is compared with these when the check is prepared. */
static void check_limits(struct checking *checking, const struct check_input *check)
{
    const struct quantity *is = &check->is, *within = &check->within;
    const bool bounded = is_given(&check->regression_bound);
    if (is_given(is) && !is_given(within) && !bounded)
        case_wrong(checking, "is", "this needs `within` or `regression_bound` beside it");
    if (check->regression_bound.value < 0.0)
        case_wrong(checking, "regression_bound", "this cannot be negative");
    if (is_given(&check->recorded) && !bounded)
        case_wrong(checking, "recorded_value", "this needs `regression_bound` beside it");
    if (check->at_least.value > check->at_most.value &&
        dimension_equal(check->at_least.dimension, check->at_most.dimension))
        case_wrong(checking, "at_least", "this is larger than `at_most`");
    if (!is_given(within))
        return;
    if (within->value < 0.0)
        case_wrong(checking, "within", "this cannot be negative");
    if (is_given(is) && is->value != 0.0 && !is_number(within) &&
        !dimension_equal(is->dimension, within->dimension))
        case_wrong(checking, "within",
                   "expected a fraction, or a quantity of the dimension of `is`");
}

static void check_deviation(struct checking *checking, const struct check_input *check)
{
    if (check->known_deviation && !check_has_limit(check))
        case_wrong(checking, "known_deviation",
                   "this needs a limit beside it: `is` and `within`, `at_most`, `at_least` or "
                   "`regression_bound`");
    if (check->known_deviation && !check->known_deviation[0])
        case_wrong(checking, "known_deviation", "a reason is required");
    if (!check->known_deviation && check->known_deviation_if != 1.0)
        case_wrong(checking, "known_deviation_if", "this needs `known_deviation` beside it");
}

/* The check that KEY of check INDEX names; -1 after a mistake. A chain of ratios and differences
 * would hide what is compared with what. */
static int find_other(struct checking *checking, const char *key, const char *name, int index)
{
    const struct simulation_case *input = checking->input;
    const int other = case_find_name(checking, &input->checks, "check", name, key);
    if (other == index)
        case_wrong(checking, key, "a check cannot be compared with itself");
    else if (other >= 0 && case_check(input, other)->relative)
        case_wrong(checking, key, "the check \"%s\" is relative itself", name);
    else if (other >= 0 && case_check(input, other)->minus)
        case_wrong(checking, key, "the check \"%s\" is a difference itself", name);
    else if (other >= 0 && case_check(input, other)->mean_with.count > 0)
        case_wrong(checking, key, "the check \"%s\" is a mean itself", name);
    return other;
}

static void find_others(struct checking *checking, struct check_input *check, int index)
{
    check->relative_check = check->minus_check = -1;
    if (check->relative && strcmp(check->relative, "start") != 0)
        check->relative_check = find_other(checking, "relative", check->relative, index);
    if (check->minus)
        check->minus_check = find_other(checking, "minus", check->minus, index);
    for (int k = 0; k < check->mean_with.count; k++)
        find_other(checking, "mean_with", check->mean_with.names[k], index);
}

void case_check_check(struct checking *checking, int index)
{
    struct check_input *check = case_check(checking->input, index);
    case_find_members(checking, check->of);
    case_check_between(checking, &check->between);
    case_check_axis(checking, "axis", check->axis);
    if (check->about.count)
        case_check_components(checking, "about", check->about.count);
    find_others(checking, check, index);
    if (check->at > checking->input->run.until &&
        !document_is_wrong(checking->input->document, "run"))
        case_wrong(checking, "at", "the run ends before, at %.9g s", checking->input->run.until);
    if (!case_is_wrong(checking, ""))
        check_limits(checking, check);
    check_deviation(checking, check);
}

static bool is_swept(const struct simulation_case *input, const char *key)
{
    for (int k = 0; k < input->sweep_values; k++)
        if (!strcmp(input->sweep[k].key, key))
            return true;
    return false;
}

void case_check_fit(struct checking *checking, int index)
{
    const struct simulation_case *input = checking->input;
    const struct fit_input *fit = case_fit(input, index);
    if (case_is_wrong(checking, "")) /* no map at all, or keys are missing */
        return;
    if (input->sweep_runs == 0) {
        case_wrong(checking, "", "this needs a `sweep`, whose runs it fits");
        return;
    }
    case_find_name(checking, &input->checks, "check", fit->of, "of");
    /* Keys of the sweep are known in its runs only, all of which are checked before the first
     * begins. */
    if (input->sweep_values > 0 && !is_swept(input, fit->over))
        case_find_name(checking, &input->checks, "swept key or check", fit->over, "over");
    if (fit->form == FIT_POWER && fit->take == FIT_INTERCEPT)
        case_wrong(checking, "take", "a power law has no intercept: take slope or misfit");
    if (fit->form == FIT_POWER && fit->take >= FIT_MEAN)
        case_wrong(checking, "form", "a mean and its deviation have no form: leave this key out");
    check_limits(checking, &fit->check);
    check_deviation(checking, &fit->check);
}

void case_check_repetitions(struct checking *checking)
{
    const struct simulation_case *input = checking->input;
    checking->map = "repetitions";
    checking->name = NULL;
    if (!input->repetitions)
        return;
    if (input->sweep_runs == 0)
        case_wrong(checking, "", "this needs a `sweep` with the key \"%s\"", input->repetitions);
    else if (input->sweep_values > 0 && !is_swept(input, input->repetitions))
        case_wrong(checking, "", "the sweep has no key \"%s\"", input->repetitions);
}

/* NAMES of checks under KEY. */
static void check_check_names(struct checking *checking, const struct name_list *names,
                              const char *key)
{
    for (int i = 0; i < names->count; i++)
        case_find_name(checking, &checking->input->checks, "check", names->names[i], key);
}

void case_check_order(struct checking *checking, int index)
{
    const struct simulation_case *input = checking->input;
    const struct order_input *order = case_order(input, index);
    case_find_name(checking, &input->checks, "check", checking->name, "");
    if (isnan(order->at_least) && isnan(order->at_most) && !case_is_wrong(checking, ""))
        case_wrong(checking, "", "a limit is missing: `at_least` or `at_most`");
    if (order->at_least > order->at_most)
        case_wrong(checking, "at_least", "this is larger than `at_most`");
    if (order->known_deviation && !order->known_deviation[0])
        case_wrong(checking, "known_deviation", "a reason is required");
}

void case_check_study(struct checking *checking)
{
    checking->map = "convergence";
    check_check_names(checking, &checking->input->convergence.of, "of");
    check_check_names(checking, &checking->input->convergence.estimate, "estimate");
}
