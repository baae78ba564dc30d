/* What names and texts may hold: they come to terminals, file names, tables that spreadsheets open,
 * and pages. */
#include <string.h>

#include "base/visible.h"
#include "case/checking.h"

/* Bytes of a name, so that with a number and an ending it is that of a file; of the title; of other
 * texts. */
enum { NAME_MAX_BYTES = 100, TITLE_MAX_BYTES = 200, TEXT_MAX_BYTES = 2000 };

static const char punctuation[] = "_-+.,:()/%'&#<>=";

/* Letters beyond ASCII are all bytes that are none of it; controls are refused where texts are
 * read. */
static bool is_letter_or_digit(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           (unsigned char)c >= 128;
}

/* Names that look the same are the same: no blank at the end, no two in a row, nothing else that
 * shows nothing, and one spelling of each letter. */
static void check_looks(struct checking *checking, const char *name)
{
    uint32_t code = ' ';
    for (const char *c = name; *c;) {
        const uint32_t before = code;
        const size_t size = utf8_character(c, strnlen(c, 4), &code);
        if (is_invisible(code) && code != ' ') {
            case_wrong(checking, "", "a name cannot hold the invisible character U+%04X",
                       (unsigned)code);
            return;
        }
        if (is_spelled_twice(code)) {
            case_wrong(checking, "",
                       "a name cannot hold U+%04X, which Unicode spells in another way too: write "
                       "a letter with its marks as one character",
                       (unsigned)code);
            return;
        }
        if (code == ' ' && before == ' ' && c > name) {
            case_wrong(checking, "", "a name cannot hold two blanks in a row");
            return;
        }
        c += size ? size : 1;
    }
    if (*name && code == ' ')
        case_wrong(checking, "", "a name cannot end with a blank");
}

static void check_name(struct checking *checking, const char *name, bool of_file)
{
    if (strlen(name) > NAME_MAX_BYTES)
        case_wrong(checking, "", "a name is longer than %d bytes", NAME_MAX_BYTES);
    if (of_file && strchr(name, '/'))
        case_wrong(checking, "", "its name becomes that of a file, and cannot hold a `/`");
    bool good = is_letter_or_digit(name[0]);
    for (const char *c = name; *c; c++)
        good = good && (is_letter_or_digit(*c) || *c == ' ' || strchr(punctuation, *c));
    if (!good)
        case_wrong(checking, "",
                   "a name must start with a letter or a digit; it may also contain blanks and %s",
                   punctuation);
    check_looks(checking, name);
}

static void check_names(struct checking *checking)
{
    const struct simulation_case *input = checking->input;
    const struct {
        const char *key;
        const struct named_map *map;
        bool of_file;
    } maps[] = {{"materials", &input->materials, false},
                {"bodies", &input->bodies, false},
                {"boundaries", &input->boundaries, false},
                {"fine", &input->fine, false},
                {"loads", &input->loads, false},
                {"contacts", &input->contacts, false},
                {"detonations", &input->detonations, false},
                {"probes", &input->probes, true},
                {"profiles", &input->profiles, true},
                {"output.maps", &input->output.maps, true},
                {"output.histograms", &input->output.histograms, true},
                {"checks", &input->checks, false},
                {"calibrate.targets", &input->calibrate.targets, false},
                {"expected_warnings", &input->expected, false}};
    for (size_t k = 0; k < COUNT_OF(maps); k++) {
        checking->map = maps[k].key;
        for (int i = 0; i < maps[k].map->count; i++) {
            checking->name = maps[k].map->names[i];
            if (checking->name[0]) /* else that has been told */
                check_name(checking, checking->name, maps[k].of_file);
        }
    }
    checking->name = NULL;
}

/* The bytes of what shows nothing at the start of TEXT. */
static size_t leading_blanks(const char *text)
{
    size_t length = 0;
    for (uint32_t code; text[length];) {
        const size_t size = utf8_character(text + length, strnlen(text + length, 4), &code);
        if (size == 0 || !is_invisible(code))
            break;
        length += size;
    }
    return length;
}

/* TEXT for people, which gets into one line. Spreadsheets look for a formula after the blanks at
 * its start. */
static void check_text(struct checking *checking, const char *key, char *text, size_t longest)
{
    const size_t blanks = text ? leading_blanks(text) : 0;
    size_t length = text ? strlen(text) - blanks : 0;
    if (blanks > 0 && length > 0)
        memmove(text, text + blanks, length + 1);
    for (size_t i = 0; i < length; i++)
        text[i] = text[i] == '\n' || text[i] == '\t' ? ' ' : text[i];
    while (length > 1 && text[length - 1] == ' ')
        text[--length] = '\0';
    if (length > longest)
        case_wrong(checking, key, "a text is longer than %zu bytes", longest);
    if (length > 0 && strchr("=+-@", text[0]))
        case_wrong(checking, key,
                   "a text cannot start with =, +, - or @: spreadsheets take it for a formula");
}

void case_check_texts(struct checking *checking)
{
    const struct simulation_case *input = checking->input;
    check_names(checking);
    checking->map = "title";
    check_text(checking, "", input->title, TITLE_MAX_BYTES);
    checking->map = "materials";
    for (int i = 0; i < input->materials.count; i++) {
        const struct material_input *material = case_material(input, i);
        checking->name = input->materials.names[i];
        check_text(checking, "description", material->description, TEXT_MAX_BYTES);
        check_text(checking, "source", material->source, TEXT_MAX_BYTES);
    }
    checking->map = "checks";
    for (int i = 0; i < input->checks.count; i++) {
        const struct check_input *check = case_check(input, i);
        checking->name = input->checks.names[i];
        check_text(checking, "source", check->source, TEXT_MAX_BYTES);
        check_text(checking, "known_deviation", check->known_deviation, TEXT_MAX_BYTES);
    }
    checking->map = "expected_warnings";
    for (int i = 0; i < input->expected.count; i++) {
        checking->name = input->expected.names[i];
        check_text(checking, "reason", case_expected_warning(input, i)->reason, TEXT_MAX_BYTES);
    }
    checking->map = "fits";
    for (int i = 0; i < input->fits.count; i++) {
        const struct check_input *check = &case_fit(input, i)->check;
        checking->name = input->fits.names[i];
        check_text(checking, "source", check->source, TEXT_MAX_BYTES);
        check_text(checking, "known_deviation", check->known_deviation, TEXT_MAX_BYTES);
    }
    checking->map = "convergence.order";
    for (int i = 0; i < input->convergence.order.count; i++) {
        const struct order_input *order = case_order(input, i);
        checking->name = input->convergence.order.names[i];
        check_text(checking, "source", order->source, TEXT_MAX_BYTES);
        check_text(checking, "known_deviation", order->known_deviation, TEXT_MAX_BYTES);
    }
    checking->name = NULL;
}

void case_check_interval(struct checking *checking, const char *key, double interval)
{
    static const double most = 1e9;
    const double until = checking->input->run.until;
    if (interval * most < until && !document_is_wrong(checking->input->document, "run"))
        case_wrong(checking, key, "this is less than a part in %.0e of the run, %.6g s", most,
                   until);
}
