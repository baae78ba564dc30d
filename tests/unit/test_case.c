/* Cases: what reading fills in, and what a case as run is written as. */
#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "material/material.h"
#include "messages.h"
#include "small_catalogue.h"
#include "source_folder.h"

static const char *const library_paths[] = {"library", materials_folder};

static struct error *read_case(const char *path, const char *const *settings, int count, bool quick,
                               struct simulation_case **input)
{
    struct case_options options = {.settings = settings,
                                   .setting_count = count,
                                   .form = quick ? "short" : NULL,
                                   .library_paths = library_paths,
                                   .library_count = COUNT_OF(library_paths)};
    return case_read(path, &options, &small_catalogue, input);
}

static void write_file(const char *path, const char *text, size_t length)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, length, file), length);
    assert_int_equal(fclose(file), 0);
}

/* Reads TEXT as a case that must be right. */
static struct simulation_case *good_case(const char *text, const char *const *settings, int count,
                                         bool quick)
{
    struct simulation_case *input = NULL;
    write_file("input.yaml", text, strlen(text));
    struct error *error = read_case("input.yaml", settings, count, quick, &input);
    char *told = messages(error);
    assert_string_equal(told, "");
    free(told);
    assert_non_null(input);
    return input;
}

/* Reads TEXT as a case that must give the messages TOLD. */
static void expect_messages(const char *text, const char *const *settings, int count,
                            const char *told)
{
    struct simulation_case *input = NULL;
    write_file("input.yaml", text, strlen(text));
    struct error *error = read_case("input.yaml", settings, count, false, &input);
    char *found = messages(error);
    error_free(error);
    case_free(input);
    assert_string_equal(found, told);
    free(found);
}

static const char impact[] =
    "format: 1\n"
    "title: \"Wilkins' plate impact: # 1\"\n"
    "dimension: 1\n"
    "let: {U0: 800 m/s, plate: 5 mm, slow: U0/3}\n"
    "solver: {sph: {smoothing: 1.1}}\n"
    "materials:\n"
    "  aluminium: {library: aluminium}\n"
    "  soft: {library: aluminium, strength: {perfect-plastic: {yield: 0.1 GPa}}}\n"
    "  liquid: {library: aluminium, strength: none}\n"
    "  other: {library: aluminium, eos: {barotropic: {density: 2 g/cm^3, bulk_modulus: 70 GPa}}}\n"
    "  gas: {library: gas-gamma-3}\n"
    "resolution: 50 um\n"
    "bodies:\n"
    "  flyer:  {material: aluminium, box: {from: [0], to: [plate]}, velocity: [slow + 0.3 m/s]}\n"
    "  target: {material: soft, box: {from: [plate], to: [10*plate]}, pressure: 1 bar}\n"
    "  many:\n"
    "    material: other\n"
    "    union: [{ball: {radius: 1 mm}}, {ball: 2 mm}, {union: [{ball: 3 mm}]}]\n"
    "    pressure: 4 GPa\n"
    "    replaces: flyer\n"
    "  air: {material: gas, ball: 1 mm, density: 1200 kg/m^3, pressure: 10 kPa}\n"
    "walls: {left: {mirror: x, at: -3 mm, side: low}}\n"
    "contacts: {smooth: {between: [flyer, target], shear: slip}}\n"
    "run: {until: 5 us}\n"
    "output: {every: 0.5 us, pictures: [pressure, velocity.x]}\n"
    "exact: impact\n"
    "checks:\n"
    "  shocked plateau: {mean: pressure, between: [32.2 mm, 33.8 mm], is: 6435.9 MPa, within: 0.5 "
    "%}\n"
    "  \"yes: this\": {conserved: momentum, within: 1e-12, source: \"a \\\"book\\\"\\n\"}\n"
    "short: {run: {until: 1 us}, resolution: 1 mm/3}\n";

static void a_good_case_is_read_in_si_units(void **state)
{
    (void)state;
    struct simulation_case *input = good_case(impact, NULL, 0, false);
    assert_string_equal(input->name, "input");
    assert_string_equal(input->title, "Wilkins' plate impact: # 1");
    const struct sph *sph = input->solver.value;
    assert_true(sph->smoothing == 1.1 && sph->contact == 0);
    assert_true(input->resolution == 50e-6 && input->run.until == 5e-6);
    const struct body_input *flyer = case_body(input, 0);
    assert_true(flyer->velocity.at[0].constant == 800.0 / 3 + 0.3);
    assert_true(!field_is_given(&flyer->pressure) && flyer->start.pressure == 0.0);
    assert_true(flyer->start.density == 2700.0 && flyer->material_index == 0);
    const struct body_input *many = case_body(input, 2);
    const struct unite *unite = many->shape.value;
    assert_int_equal(unite->shapes.count, 3);
    assert_true(((const struct ball *)unite->shapes.items[1].value)->radius == 2e-3);
    assert_int_equal(many->replaces.count, 1);
    assert_int_equal(case_body(input, 1)->velocity.count, 1);
    assert_true(case_boundary(input, 0)->at == -3e-3 && case_boundary(input, 0)->place == -3e-3);
    assert_int_equal(case_boundary(input, 0)->kind, BOUNDARY_REFLECTING);
    assert_true(case_contact(input, 0)->shear == SHEAR_SLIP &&
                case_contact(input, 0)->body[1] == 1);
    const struct check_input *plateau = case_check(input, 0);
    assert_true(fabs(plateau->is.value / 6435.9e6 - 1.0) < 1e-15 && plateau->within.value == 0.005);
    assert_true(isnan(plateau->at_most.value) && !plateau->against.choice && input->exact.choice);
    assert_true(isnan(input->output.history) && input->output.snapshots);
    case_free(input);
}

static void keys_beside_the_library_replace_its_values(void **state)
{
    (void)state;
    struct simulation_case *input = good_case(impact, NULL, 0, false);
    const struct material *whole = case_material(input, 0)->material;
    assert_int_equal(whole->eos.kind, EOS_mie_grueneisen);
    assert_true(whole->eos.of.mie_grueneisen.sound == 5350.0);
    assert_true(whole->strength.of.perfect_plastic.yield == 0.4e9);
    const struct material *soft = case_material(input, 1)->material;
    assert_true(soft->strength.of.perfect_plastic.yield == 0.1e9);
    assert_true(soft->strength.of.perfect_plastic.shear_modulus == 23e9);
    assert_int_equal(case_material(input, 2)->material->strength.kind, STRENGTH_NONE);
    const struct material *other = case_material(input, 3)->material;
    assert_int_equal(other->eos.kind, EOS_barotropic);
    assert_true(other->eos.of.barotropic.density == 2000.0);
    case_free(input);
}

/* The state of the body `air` of the impact, or of `many`, from what the equation of state
 * gives. */
static void start_states_follow_from_two_of_three(void **state)
{
    (void)state;
    struct simulation_case *input = good_case(impact, NULL, 0, false);
    const struct point *air = &case_body(input, 3 + 0)->start;
    assert_true(fabs(air->energy / (1e4 / (2.0 * 1200.0)) - 1.0) < 1e-14);
    assert_true(fabs(air->pressure / 1e4 - 1.0) < 1e-14);
    const struct point *many = &case_body(input, 2)->start;
    assert_true(fabs(many->density / (2000.0 / (1.0 - 4.0 / 70.0)) - 1.0) < 1e-14);
    assert_true(fabs(many->pressure / 4e9 - 1.0) < 1e-13 && many->energy == 0.0);
    const struct point *target = &case_body(input, 1)->start;
    assert_true(target->energy == 0.0 && target->density > 2700.0);
    assert_true(fabs(target->pressure / 1e5 - 1.0) < 1e-9);
    case_free(input);
    static const char *const alone[] = {"bodies.air={material: gas, ball: 1 mm, pressure: 30 kPa}"};
    input = good_case(impact, alone, 1, false);
    air = &case_body(input, 3)->start;
    assert_true(air->density == 1500.0 && fabs(air->energy / 10.0 - 1.0) < 1e-14);
    case_free(input);
    static const char *const warm[] = {"bodies.air={material: gas, ball: 1 mm, pressure: 30 kPa,"
                                       " energy: 5 J/kg}"};
    input = good_case(impact, warm, 1, false);
    air = &case_body(input, 3)->start;
    assert_true(air->energy == 5.0 && fabs(air->density / 3000.0 - 1.0) < 1e-14);
    case_free(input);
}

static void settings_and_the_short_form_lie_over_the_file(void **state)
{
    (void)state;
    static const char *const settings[] = {
        "let.U0=0.9 km/s",
        "solver.sph.contact=standard",
        "materials.aluminium.strength.perfect-plastic.yield=500 MPa",
        "output.history=1 ns",
        "checks.yes: this.within=1e-9",
        "bodies.many.union.2.ball=7 mm",
        "title=",
    };
    struct simulation_case *input = good_case(impact, settings, COUNT_OF(settings) - 1, true);
    assert_true(case_body(input, 0)->velocity.at[0].constant == 900.0 / 3 + 0.3);
    assert_int_equal(((const struct sph *)input->solver.value)->contact, 1);
    assert_true(case_material(input, 0)->material->strength.of.perfect_plastic.yield == 500e6);
    assert_true(input->output.history == 1e-9 && input->output.every == 0.5e-6);
    assert_true(case_check(input, 1)->within.value == 1e-9);
    const struct unite *unite = case_body(input, 2)->shape.value;
    assert_true(((const struct ball *)unite->shapes.items[1].value)->radius == 7e-3);
    assert_true(input->run.until == 1e-6 && input->resolution == 1e-3 / 3);
    case_free(input);
}

static void a_wrong_setting_is_told_as_typed(void **state)
{
    (void)state;
    static const char *const settings[] = {
        "run.until=3",
        "bodis.flyer.velocity=[1 m/s]",
        "bodies.fly.velocity=[1 m/s]",
        "run.untl=3 us",
        "nonsense",
        "bodies.flyer=[",
        "bodies.many.union.4=",
        "resolution.x=1",
    };
    expect_messages(
        impact, settings, 4,
        "--set bodis.flyer.velocity=[1 m/s]: bodis.flyer.velocity: there is no \"bodis\""
        " (did you mean \"bodies\"?)\n");
    const char *const first[] = {settings[0], settings[2], settings[3]};
    expect_messages(impact, first, 3,
                    "--set bodies.fly.velocity=[1 m/s]: bodies.fly: there is no such entry\n"
                    "--set run.until=3: run.until: \"3\" is a plain number, expected a time (s)\n"
                    "--set run.untl=3 us: run: unknown key \"untl\" (did you mean \"until\"?)\n");
    expect_messages(impact, settings + 4, 4,
                    "--set nonsense: a setting is path.to.key=value\n"
                    "--set bodies.flyer=[: a bracket above is still open\n"
                    "--set bodies.many.union.4=: bodies.many.union.4: the list has items 1 to 3\n"
                    "--set resolution.x=1: resolution.x: \"50 um\" is a value without keys\n");
}

static void a_setting_that_spoils_an_expression_is_named(void **state)
{
    (void)state;
    static const char text[] = "format: 1\ndimension: 1\nresolution: d\nsolver: sph\n"
                               "let: {d: 1 mm, speed: 2 km/s}\n"
                               "materials: {a: {library: aluminium}}\n"
                               "bodies: {flyer: {material: a, velocity: [2*speed],\n"
                               "  box: {from: [0 m], to: [2*d + 1 m]}}}\n"
                               "run: {until: 1 s}\n";
    static const char *const settings[] = {"let.speed=2000", "let.d=1 us"};
    expect_messages(
        text, settings, 2,
        "input.yaml:3:13: resolution: \"d\" is a time (s), expected a length (m) (--set let.d=1 "
        "us)\n"
        "input.yaml:7:42: bodies.flyer.velocity.1: \"2*speed\" is a plain number, expected a "
        "velocity "
        "(m/s) (--set let.speed=2000)\n"
        "input.yaml:8:27: bodies.flyer.box.to.1: \"2*d + 1 m\": different dimensions are added or "
        "compared, or a function such as exp is taken of a value that has a dimension (--set "
        "let.d=1 "
        "us)\n");
}

static void a_library_that_is_not_there_is_told(void **state)
{
    (void)state;
    struct simulation_case *input = NULL;
    write_file("input.yaml", impact, strlen(impact));
    const struct case_options nowhere = {0};
    struct error *error = case_read("input.yaml", &nowhere, &small_catalogue, &input);
    assert_non_null(error);
    assert_non_null(strstr(error_message(error, 0), "the library was not found; set BOLIDE_SHARE"));
    error_free(error);
    static const char *const folders[] = {materials_folder};
    const struct case_options here = {.library_paths = folders, .library_count = 1};
    static const char text[] = "format: 1\nmaterials: {a: {library: unobtainium}}\n";
    write_file("input.yaml", text, strlen(text));
    error = case_read("input.yaml", &here, &small_catalogue, &input);
    assert_non_null(error);
    assert_non_null(
        strstr(error_message(error, 0), "no material \"unobtainium\" in the library (known: "));
    assert_non_null(strstr(error_message(error, 0), "aluminium, "));
    error_free(error);
}

static void a_written_case_reads_back_to_the_same_bits(void **state)
{
    (void)state;
    static const char *const settings[] = {"resolution=0.1 mm/3", "bodies.air.density=pi*1 kg/m^3"};
    struct simulation_case *input = good_case(impact, settings, 2, false);
    char *text[2];
    size_t length[2];
    for (int i = 0; i < 2; i++) {
        FILE *file = open_memstream(&text[i], &length[i]);
        assert_non_null(file);
        assert_null(case_write(input, file));
        fclose(file);
        double resolution = input->resolution, density = case_body(input, 3)->density.constant;
        double energy = case_body(input, 3)->start.energy;
        case_free(input);
        assert_null(strstr(text[i], "library"));
        input = good_case(text[i], NULL, 0, false);
        assert_true(resolution == input->resolution &&
                    density == case_body(input, 3)->density.constant);
        assert_true(energy == case_body(input, 3)->start.energy);
        assert_string_equal(input->title, "Wilkins' plate impact: # 1");
        assert_string_equal(case_check(input, 1)->source, "a \"book\"");
        assert_string_equal(input->checks.names[1], "yes: this");
        assert_true(case_check(input, 0)->within.value == 0.005);
    }
    assert_string_equal(text[0], text[1]);
    free(text[0]);
    free(text[1]);
    case_free(input);
}

/* A fit needs a sweep, which the case that one of its runs writes does not have. */
static void a_run_of_a_sweep_is_written_as_a_case_of_its_own(void **state)
{
    (void)state;
    struct simulation_case *input =
        good_case("format: 1\ndimension: 1\nresolution: 1 mm\nsolver: sph\nrun: {until: 1 us}\n"
                  "let: {u: 1 m/s}\n"
                  "materials: {m: {library: copper}}\n"
                  "bodies: {all: {material: m, box: {from: [0], to: [5 mm]}, velocity: [u]}}\n"
                  "checks: {speed: {mean: velocity.x, at_most: 4 m/s}}\n"
                  "sweep: {let.u: [1 m/s, 2 m/s, 3 m/s]}\n"
                  "fits: {slope: {of: speed, over: let.u, take: slope, at_most: 2}}\n",
                  NULL, 0, false);
    assert_int_equal(input->fits.count, 1);
    char *text;
    size_t length;
    FILE *file = open_memstream(&text, &length);
    assert_null(case_write(input, file));
    fclose(file);
    case_free(input);
    case_free(good_case(text, NULL, 0, false));
    free(text);
}

static void fields_are_written_with_their_names_filled_in(void **state)
{
    (void)state;
    static const char *const settings[] = {
        "bodies.flyer.velocity=['U0*x/plate']", "bodies.flyer.density='2700 kg/m^3*(1 + x/(1 m))'",
        "bodies.target={material: soft, box: {from: [plate], to: [10*plate]},"
        " stress: [-1 MPa*(x < 2*plate), 0, 0], energy: 5 J/kg}"};
    struct simulation_case *input = good_case(impact, settings, 3, false);
    assert_true(case_body(input, 0)->varies && case_body(input, 1)->varies);
    char *text[2];
    size_t length;
    for (int i = 0; i < 2; i++) {
        FILE *file = open_memstream(&text[i], &length);
        assert_null(case_write(input, file));
        fclose(file);
        case_free(input);
        input = good_case(text[i], NULL, 0, false);
    }
    assert_non_null(strstr(text[0], "    velocity: [\"(800 m/s)*x/(0.005 m)\"]\n"
                                    "    density: \"(2700 kg/m^3)*(1 + x/(1 m))\"\n"));
    assert_non_null(strstr(text[0],
                           "    energy: 5 J/kg\n"
                           "    stress: [\"-(1000000 Pa)*(x < 2*(0.005 m))\", 0 Pa, 0 Pa]"));
    assert_string_equal(text[0], text[1]);
    free(text[0]);
    free(text[1]);
    case_free(input);
}

static void a_key_that_the_library_leaves_out_joins_those_of_its_file(void **state)
{
    (void)state;
    struct simulation_case *input = good_case(
        "format: 1\ndimension: 1\nresolution: 1 mm\nsolver: sph\nrun: {until: 1 s}\n"
        "materials:\n"
        "  a: {library: steel-1006-johnson-cook, strength: {johnson-cook: {rate: 2 1/s}}}\n"
        "  b: {library: steel-1006-johnson-cook, strength: {perfect-plastic: "
        "{shear_modulus: 80 GPa, yield: 1 GPa}}}\n"
        "bodies: {b: {material: a, ball: 1 m}}\n",
        NULL, 0, false);
    const struct strength *joined = &case_material(input, 0)->material->strength;
    assert_true(joined->of.johnson_cook.a == 350e6 && joined->of.johnson_cook.rate == 2.0);
    assert_int_equal(case_material(input, 1)->material->strength.kind, STRENGTH_perfect_plastic);
    case_free(input);
}

static void wrong_materials_and_detonations_are_told(void **state)
{
    (void)state;
    static const struct {
        const char *setting, *words;
    } wrong[] = {{"materials.a.strength.johnson-cook.m=1", "melt: m needs this beside it"},
                 {"materials.t.eos.jwl.a=1 GPa", ""},
                 {"detonations.middle.of=b", "no `burn` that needs an ignition"},
                 {"detonations.middle.to=[0 m]", "both ends are the same point"},
                 {"detonations.middle.at=[0 m, 0 m]", "expected 1 component"},
                 {"materials.b.eos.hjc.lock_pressure=10 MPa", "not above `crush_pressure`"},
                 {"bodies.c.pressure=1 GPa", "unburnt explosive"}};
    for (size_t k = 0; k < COUNT_OF(wrong); k++) {
        struct simulation_case *input = NULL;
        static const char text[] =
            "format: 1\ndimension: 1\nresolution: 1 mm\nsolver: sph\nrun: {until: 1 s}\n"
            "materials:\n"
            "  a: {library: steel-1006-johnson-cook}\n"
            "  b: {library: concrete-hjc}\n"
            "  t: {library: tnt}\n"
            "bodies: {b: {material: a, ball: 1 m}, c: {material: t, ball: 1 m}}\n"
            "detonations: {middle: {at: [0 m]}}\n";
        write_file("input.yaml", text, strlen(text));
        struct error *error = read_case("input.yaml", &wrong[k].setting, 1, false, &input);
        char *told = messages(error);
        if (!strstr(told, wrong[k].words) || (error != NULL) != (wrong[k].words[0] != '\0'))
            fail_msg("%s: %s", wrong[k].setting, told);
        free(told);
        error_free(error);
        case_free(input);
    }
}

static void a_case_is_called_as_its_folder_or_file(void **state)
{
    (void)state;
    static const char minimal[] = "format: 1\ndimension: 2\nresolution: 1 mm\nsolver: sph\n"
                                  "materials: {a: {library: aluminium}}\n"
                                  "bodies: {b: {material: a, ball: 1 m}}\nrun: {until: 1 s}\n";
    struct simulation_case *input = NULL;
    char folder[] = "bolide-XXXXXX";
    assert_non_null(mkdtemp(folder));
    char *path = text_format("%s/case.yaml", folder);
    write_file(path, minimal, strlen(minimal));
    assert_null(read_case(path, NULL, 0, false, &input));
    assert_string_equal(input->name, folder);
    assert_int_equal(case_body(input, 0)->velocity.count, 2);
    case_free(input);
    remove(path);
    rmdir(folder);
    free(path);
    struct error *error = read_case("does/not/exist.yaml", NULL, 0, false, &input);
    assert_int_equal(error_kind(error), ERROR_INPUT);
    assert_string_equal(error_message(error, 0), "does/not/exist.yaml: No such file or directory");
    error_free(error);
}

/* Whether the explosive in the library's FILE burns at a rate, as its equation of state tells. */
static bool burns_by_itself(const char *file)
{
    char text[8192] = "", *path = text_format("%s/%s", materials_folder, file);
    FILE *from = fopen(path, "r");
    assert_non_null(from);
    assert_true(fread(text, 1, sizeof text - 1, from) > 0 && fclose(from) == 0);
    free(path);
    return strstr(text, "reactive-jwl:") || strstr(text, "blended-jwl:");
}

static void every_material_of_the_library_can_be_used(void **state)
{
    (void)state;
    struct dirent **entries;
    int count = scandir(materials_folder, &entries, NULL, alphasort), materials = 0;
    for (int i = 0; i < count; i++) {
        char *dot = strstr(entries[i]->d_name, ".yaml");
        if (dot) {
            /* an explosive that is lit needs a detonation; one that burns by itself does not */
            const bool reacts = burns_by_itself(entries[i]->d_name);
            char *text = text_format("format: 1\ndimension: 1\nresolution: 1 mm\nsolver: sph\n"
                                     "materials: {a: {library: %.*s%s}}\nrun: {until: 1 s}\n"
                                     "bodies: {b: {material: a, ball: 1 m, pressure: 1 bar}}\n",
                                     (int)(dot - entries[i]->d_name), entries[i]->d_name,
                                     reacts ? "" : ", burn: instant");
            case_free(good_case(text, NULL, 0, false));
            free(text);
            materials++;
        }
        free(entries[i]);
    }
    free(entries);
    assert_true(materials >= 5);
}

/* A case that is cut off or garbled may be right or wrong, but must not crash, and tells every
 * mistake as one of the user. */
static void survive(const char *text, size_t length)
{
    struct simulation_case *input = NULL;
    write_file("garbled.yaml", text, length);
    struct error *error = read_case("garbled.yaml", NULL, 0, length % 2, &input);
    assert_true((error != NULL) != (input != NULL));
    if (error)
        assert_int_equal(error_kind(error), ERROR_INPUT);
    error_free(error);
    case_free(input);
}

static void cut_off_cases_do_no_harm(void **state)
{
    (void)state;
    for (size_t length = 0; length < sizeof impact; length++)
        survive(impact, length);
    remove("garbled.yaml");
}

static void garbled_cases_do_no_harm(void **state)
{
    (void)state;
    static const char favourites[] = "{}[]:,-&*!|>'\"%@#?~\n\t \0\x80\xff";
    uint32_t random = 12345;
    for (int run = 0; run < 1500; run++) {
        char text[sizeof impact];
        memcpy(text, impact, sizeof impact);
        int changes = 1 + run % 4;
        for (int i = 0; i < changes; i++) {
            random = random * 1664525u + 1013904223u;
            size_t at = (random >> 8) % (sizeof impact - 1);
            random = random * 1664525u + 1013904223u;
            text[at] = run % 3 ? favourites[(random >> 8) % sizeof favourites]
                               : (char)(text[at] ^ (1 << (random >> 8) % 8));
        }
        survive(text, sizeof impact - 1);
    }
    remove("garbled.yaml");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_good_case_is_read_in_si_units),
        cmocka_unit_test(keys_beside_the_library_replace_its_values),
        cmocka_unit_test(start_states_follow_from_two_of_three),
        cmocka_unit_test(settings_and_the_short_form_lie_over_the_file),
        cmocka_unit_test(a_wrong_setting_is_told_as_typed),
        cmocka_unit_test(a_setting_that_spoils_an_expression_is_named),
        cmocka_unit_test(a_library_that_is_not_there_is_told),
        cmocka_unit_test(a_written_case_reads_back_to_the_same_bits),
        cmocka_unit_test(a_run_of_a_sweep_is_written_as_a_case_of_its_own),
        cmocka_unit_test(fields_are_written_with_their_names_filled_in),
        cmocka_unit_test(a_key_that_the_library_leaves_out_joins_those_of_its_file),
        cmocka_unit_test(wrong_materials_and_detonations_are_told),
        cmocka_unit_test(a_case_is_called_as_its_folder_or_file),
        cmocka_unit_test(every_material_of_the_library_can_be_used),
        cmocka_unit_test(cut_off_cases_do_no_harm),
        cmocka_unit_test(garbled_cases_do_no_harm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
