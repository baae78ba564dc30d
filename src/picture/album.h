/* The pictures of a run: what output.pictures says of them, and what all frames share: window,
 * view, colours. Use: album_create; album_begin with the first frame and the last; album_add with
 * every frame, album_share; if album_measures, all of that once more by album_measure; then
 * album_draw in any order, on any rank. */
#ifndef BOLIDE_ALBUM_H
#define BOLIDE_ALBUM_H

#include "case/case.h"
#include "measure/frame.h"
#include "parallel/ranks.h"

struct album;

/* The pictures of INPUT, which must outlive the album; where it says nothing of pictures one of the
 * bodies, or of the pressure of a gas, in 2-D and 3-D. */
struct error *album_create(const struct simulation_case *input, int threads, struct album **album);

/* Pictures of the COUNT FIELDS, which must outlive the album, as without any key. */
struct error *album_create_plain(const struct simulation_case *input, const char *const *fields,
                                 int count, struct album **album);
void album_free(struct album *album);

/* All pictures in 2-D and 3-D have this size in pixels. */
void album_set_size(struct album *album, const int size[2]);

int album_count(const struct album *album);
const char *album_name(const struct album *album, int picture);

/* The fields that its frames must have where there are any. */
const char *const *album_fields(const struct album *album, int *count);

struct error *album_begin(struct album *album, const struct frame *first, const struct frame *last);
struct error *album_add(struct album *album, const struct frame *frame);

/* Collective: the ranges of all ranks become one; then what follows is known. */
void album_share(struct album *album, const struct ranks *ranks);

/* Whether the frames must be measured: for schlieren. album_share again afterwards. */
bool album_measures(const struct album *album);
struct error *album_measure(struct album *album, const struct frame *frame);

/* Draws PICTURE of FRAME as PATH. */
struct error *album_draw(const struct album *album, int picture, const struct frame *frame,
                         const char *path);

/* Values that something spans. */
struct album_range {
    double low, high;
    const char *unit; /* NULL: m */
};

/* What the first picture shows of space. */
struct album_space {
    int dimension;
    struct album_range computed[3]; /* the window without mirrored halves */
    bool mirrored[3];
    double mirror_at[3];
    int up;                   /* an axis */
    double up_sign, diameter; /* of the largest particle */
    char cut[16];             /* "+x-y" */
    const struct frame_names *bodies;
};
void album_space(const struct album *album, struct album_space *space);

/* The values that the colours of the first panel span; false where it has categories, or no frame
 * has the field. */
bool album_range(const struct album *album, int picture, struct album_range *range);

/* The names of the pictures of INPUT, as album_name gives them: pictures/NAME-NNNNNN.png. NULL
 * after the last. */
const char *album_name_of(const struct simulation_case *input, int picture);

/* The fields of its picture at INDEX, and its mistakes that need no frame: ERROR_INPUT, not
 * located. */
struct name_list album_panels(const struct simulation_case *input, int picture);
bool album_is_category(const char *field);

#endif
