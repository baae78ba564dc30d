/* What a run draws at its end from its snapshots: its pictures and its viewer. */
#include <stdlib.h>

#include "base/clock.h"
#include "page/view.h"
#include "picture/album.h"
#include "run/pictures.h"
#include "run/run_internal.h"

/* The viewer of a run with pictures and snapshots; a gas alone has none. */
static void write_viewer(struct run *run)
{
    const bool cells = run->population.kind == POPULATION_OF_CELLS;
    if (!run->input->output.snapshots || run->input->dimension < 2 || cells ||
        !album_name_of(run->input, 0) || !run_writes(run))
        return;
    struct view_result result;
    char *path = run_path(run, "view.html");
    const struct view_request request = {
        .folder = run->options->output, .path = path, .input = run->input};
    struct error *error = path ? view_write(&request, &result) : out_of_memory();
    if (error)
        run_say(run, "warning: there is no viewer: %s", error_message(error, 0));
    error_free(error);
    free(path);
}

/* Where snapshots are not wanted they go once the pictures are there. */
struct error *run_draw_pictures(struct run *run)
{
    const struct pictures_request request = {.folder = run->options->output,
                                             .input = run->input,
                                             .ranks = &run->ranks,
                                             .threads = run->simulation.threads,
                                             .lenient = true,
                                             .at = NAN};
    int64_t count;
    if (!run->options->output)
        return NULL;
    const double clock = clock_seconds();
    struct error *error = pictures_draw(&request, &count);
    if (!error)
        write_viewer(run);
    run->watching += clock_seconds() - clock;
    if (!error && !run->input->output.snapshots && run_writes(run))
        error = pictures_drop_snapshots(run->options->output);
    return ranks_agree(&run->ranks, error);
}
