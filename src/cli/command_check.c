/* bolide check: what a case would compute. */
#include <stdio.h>

#include "cli/cli.h"
#include "run/estimate.h"

static const char *mass_unit(int64_t dimension)
{
    return dimension == 3 ? "kg" : dimension == 2 ? "kg/m" : "kg/m^2";
}

static void print_bodies(const struct simulation_case *input, const struct estimate *estimate)
{
    printf("  %-20s %-16s %12s %16s %12s %12s %12s %12s\n", "body", "material", "particles", "mass",
           "diameter", "density", "C_long", "C_shear");
    for (int i = 0; i < estimate->bodies; i++) {
        const struct body_input *body = case_body(input, i);
        const struct body_estimate *of = &estimate->body[i];
        char diameter[48];
        readable(of->summary.diameter, "m", diameter, sizeof diameter);
        printf("  %-20s %-16s %12lld %10.5g %-5s %12s %7.5g %s %8.5g %s %8.5g %s\n",
               input->bodies.names[i], body->material, (long long)of->summary.particles,
               of->summary.mass, mass_unit(input->dimension), diameter, body->start.density,
               "kg/m3", of->sound_long, "m/s", of->sound_shear, "m/s");
    }
}

static void print_run(const struct simulation_case *input, const struct estimate *estimate,
                      int threads)
{
    char step[48], until[48], memory[48], seconds[48];
    readable(estimate->step, "s", step, sizeof step);
    readable(input->run.until, "s", until, sizeof until);
    readable(estimate->bytes, "B", memory, sizeof memory);
    readable(estimate->seconds, "s", seconds, sizeof seconds);
    printf("  %lld particles, %.6g %s; %d checks\n", (long long)estimate->particles, estimate->mass,
           mass_unit(input->dimension), input->checks.count);
    printf("  until %s; first step about %s (body %s); about %lld steps\n", until, step,
           input->bodies.names[estimate->step_body], (long long)estimate->steps);
    printf("  about %s of memory, roughly %s on %d thread%s\n", memory, seconds, threads,
           threads == 1 ? "" : "s");
}

static struct error *check_case(const char *path, const struct cli_options *options)
{
    struct simulation_case *input;
    struct estimate estimate;
    int threads = options->threads > 0 ? (int)options->threads : 1;
    TRY(read_case(path, options, &input));
    struct error *error = estimate_run(input, threads, &estimate);
    if (!error) {
        printf("%s%s%s: %s (%lld-D, %s)\n", colour(COLOUR_STRONG), input->name, colour(COLOUR_NONE),
               input->title ? input->title : "", (long long)input->dimension,
               input->solver.choice->name);
        print_bodies(input, &estimate);
        print_run(input, &estimate, threads);
        estimate_free(&estimate);
    }
    case_free(input);
    return error;
}

int command_check(const struct cli_options *options)
{
    struct error *error = NULL;
    for (int i = 0; i < options->names.count; i++)
        error = error_join(error, check_case(options->names.text[i], options));
    return error ? report_error(error) : EXIT_OK;
}
