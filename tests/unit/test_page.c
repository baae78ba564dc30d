/* report.html: escaping, quantities, tables, and pages from whole, poor and odd folders. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <sys/stat.h>
#include <unistd.h>

#include "scratch_folder.h"

#include "base/file.h"
#include "page/internal.h"
#include "page/page.h"

static void put_bytes(const char *name, const void *content, size_t size)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_int_equal(fwrite(content, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static void put(const char *name, const char *content)
{
    put_bytes(name, content, strlen(content));
}

static void make_pictures_folder(void)
{
    char path[512];
    snprintf(path, sizeof path, "%s/pictures", folder);
    assert_int_equal(mkdir(path, 0777), 0);
}

/* The head of a picture of 2 by 3 pixels; what follows is of no matter here. */
static const unsigned char png[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n', 0, 0, 0, 13, 'I',
                                    'H',  'D', 'R', 0,   0,    0,    2,    0,    0, 0, 3, 8};

static void put_picture(const char *name)
{
    char path[300];
    snprintf(path, sizeof path, "pictures/%s", name);
    put_bytes(path, png, sizeof png);
}

/* Makes the page and gives its text; free it. */
static char *page_of_folder(void)
{
    struct error *error = page_write(folder);
    if (error)
        fail_msg("%s", error_message(error, 0));
    char *path = path_join(folder, "report.html"), *text;
    size_t size;
    assert_null(file_read(path, &text, &size));
    assert_non_null(text);
    assert_int_equal(strlen(text), size);
    assert_non_null(strstr(text, "</html>"));
    free(path);
    return text;
}

static int count_of(const char *text, const char *word)
{
    int count = 0;
    for (; (text = strstr(text, word)); text += strlen(word))
        count++;
    return count;
}

static void expect_on_page(const char *text, const char *word)
{
    if (!strstr(text, word))
        fail_msg("the page does not say %s", word);
}

static void expect_not_on_page(const char *text, const char *word)
{
    if (strstr(text, word))
        fail_msg("the page says %s", word);
}

/* What WRITE writes of TEXT. */
static char *written(void (*write)(FILE *, const char *), const char *text)
{
    char *result;
    size_t size;
    FILE *file = open_memstream(&result, &size);
    write(file, text);
    fclose(file);
    return result;
}

static void expect_escaped(const char *text, const char *wanted)
{
    char *got = written(page_text, text);
    assert_string_equal(got, wanted);
    free(got);
}

static void what_html_takes_for_its_own_is_escaped(void **state)
{
    (void)state;
    expect_escaped("a<b> & \"c\" 'd'", "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;");
    expect_escaped("µ ρ₀ 中 \xF0\x9F\x92\xA5", "µ ρ₀ 中 \xF0\x9F\x92\xA5");
    expect_escaped("two\nlines\tand a tab", "two\nlines\tand a tab");
}

static void what_is_not_utf8_becomes_replacement_characters(void **state)
{
    (void)state;
    expect_escaped("a\xFF"
                   "b",
                   "a\uFFFD"
                   "b");
    expect_escaped("\xC0\xAF", "\uFFFD\uFFFD");           /* overlong */
    expect_escaped("\xED\xA0\x80", "\uFFFD\uFFFD\uFFFD"); /* a surrogate */
    expect_escaped("\xE2\x82", "\uFFFD\uFFFD");           /* cut off */
    expect_escaped("\x01\x1B[31m\x7F", "\uFFFD\uFFFD[31m\uFFFD");
}

static void expect_quantity(double value, const char *unit, const char *wanted)
{
    char text[QUANTITY_TEXT];
    assert_string_equal(quantity_text(value, unit, text), wanted);
}

static void quantities_are_written_as_a_person_reads_them(void **state)
{
    (void)state;
    expect_quantity(-2.00052625e9, "Pa", "−2.0005\u00a0GPa");
    expect_quantity(1.4714538957e-5, "m", "14.715\u00a0µm");
    expect_quantity(0.0, "Pa", "0\u00a0Pa");
    expect_quantity(2.6628e-19, "", "2.6628\u00a0×\u00a010⁻¹⁹");
    expect_quantity(1e-12, "", "1\u00a0×\u00a010⁻¹²");
    expect_quantity(3.3264e-8, "kg/m", "3.3264\u00a0×\u00a010⁻⁸\u00a0kg/m");
    expect_quantity(4928.0, "", "4928");
    expect_quantity(123456.0, "", "123456");
    expect_quantity(NAN, "Pa", "not a number");
    expect_quantity(-INFINITY, "m", "−∞\u00a0m");
}

static void base64_is_that_of_rfc_4648(void **state)
{
    (void)state;
    static const char *const pairs[][2] = {{"", ""},
                                           {"f", "Zg=="},
                                           {"fo", "Zm8="},
                                           {"foo", "Zm9v"},
                                           {"foob", "Zm9vYg=="},
                                           {"fooba", "Zm9vYmE="},
                                           {"foobar", "Zm9vYmFy"}};
    for (size_t i = 0; i < COUNT_OF(pairs); i++) {
        char *text;
        size_t size;
        FILE *file = open_memstream(&text, &size);
        page_base64(file, (const unsigned char *)pairs[i][0], strlen(pairs[i][0]));
        fclose(file);
        assert_string_equal(text, pairs[i][1]);
        free(text);
    }
}

static struct csv read_csv(const char *content)
{
    struct csv csv;
    put("table.csv", content);
    char *path = path_join(folder, "table.csv");
    assert_null(csv_read(path, &csv));
    free(path);
    return csv;
}

static void quoted_fields_hold_commas_quotes_and_lines(void **state)
{
    (void)state;
    struct csv csv = read_csv("a,\"b \"\"c\"\"\"\r\n\"1,5\",\"two\nlines\"\r\n\n2.5,");
    assert_int_equal(csv.columns, 2);
    assert_int_equal(csv.rows, 2);
    assert_string_equal(csv_head(&csv, 1), "b \"c\"");
    assert_string_equal(csv_field(&csv, 0, 0), "1,5");
    assert_string_equal(csv_field(&csv, 0, 1), "two\nlines");
    assert_float_equal(csv_number(&csv, 1, 0), 2.5, 0.0);
    assert_true(isnan(csv_number(&csv, 1, 1)) && isnan(csv_number(&csv, 0, 1)));
    assert_int_equal(csv_column(&csv, "a"), 0);
    assert_int_equal(csv_column(&csv, "c"), -1);
    csv_free(&csv);
}

static void rows_of_other_lengths_are_filled_up_or_cut(void **state)
{
    (void)state;
    struct csv csv = read_csv("a,b,c\n1\n1,2,3,4,5\n\"open");
    assert_int_equal(csv.rows, 3);
    assert_string_equal(csv_field(&csv, 0, 2), "");
    assert_string_equal(csv_field(&csv, 1, 2), "3");
    assert_string_equal(csv_field(&csv, 2, 0), "open");
    assert_string_equal(csv_field(&csv, 3, 0), "");
    assert_string_equal(csv_field(&csv, 0, 3), "");
    csv_free(&csv);
    csv = read_csv("");
    assert_int_equal(csv.columns, 0);
    csv_free(&csv);
}

static void a_text_written_is_the_text_read(void **state)
{
    (void)state;
    char *text = written(csv_put_text, "a \"b\", c\nd");
    struct csv csv = read_csv(text);
    assert_string_equal(csv_head(&csv, 0), "a \"b\", c\nd");
    csv_free(&csv);
    free(text);
}

static void a_folder_without_a_run_is_refused(void **state)
{
    (void)state;
    struct error *error = page_write(folder);
    assert_non_null(error);
    assert_int_equal(error_kind(error), ERROR_INPUT);
    assert_non_null(strstr(error_message(error, 0), "no run.log"));
    error_free(error);
    error = page_write("/no/such/folder");
    assert_int_equal(error_kind(error), ERROR_INPUT);
    error_free(error);
}

static void a_run_that_left_nothing_but_its_log_gets_a_page(void **state)
{
    (void)state;
    put("run.log", "");
    char *page = page_of_folder();
    expect_on_page(page, "Results of a run");
    expect_on_page(page, "no summary");
    expect_on_page(page, "no row");
    free(page);
}

static void every_name_of_a_case_is_escaped(void **state)
{
    (void)state;
    put("run.log", "<script>alert(1)</script>\n");
    put("case.yaml", "title: </pre><script>alert(2)</script>\n");
    put("summary.csv", "about,name,quantity,value,unit\n"
                       "run,\"\",\"status\",\"finished\",text\n"
                       "run,\"\",\"title\",\"<script>alert(3)</script>\",text\n"
                       "run,\"\",\"method\",\"<script>alert(4)\",text\n"
                       "method,\"\",\"<script>alert(5)\",\"<script>alert(6)\",text\n"
                       "body,\"<script>alert(7)\",\"material\",\"<script>alert(8)\",text\n"
                       "body,\"<script>alert(7)\",\"mass\",1,<script>alert(9)\n"
                       "material,\"<script>a\",\"<script>b\",\"<script>c\",text\n"
                       "material,\"<script>a\",\"<script>b.<script>\",1,<script>\n"
                       "phase,\"<script>alert(10)\",\"seconds\",1,s\n");
    put("checks.csv", "check,measure,unit,measured,wanted,low,high,verdict,source\n"
                      "\"<script>x\",<script>m,<script>u,1,1,0,2,failed,\"<script>\"\"'s\"\n");
    put("history.csv", "<script>t [<script>s],<script>.energy [<script>J],energy [<script>],"
                       "<script>.min [<script>],<script>.max [<script>]\n0,0,0,1,2\n1,1,1,1,2\n");
    make_pictures_folder();
    put_picture("<script>'\"-000001.png");
    put_picture("check-<script>'\".png");
    put_picture("<script>other.png");
    char *page = page_of_folder();
    assert_int_equal(count_of(page, "<script>"), 3);
    expect_not_on_page(page, "<script>alert");
    assert_int_equal(count_of(page, "data:image/png;base64,"), 4);
    expect_not_on_page(page, "script>'\"");
    free(page);
}

static void the_verdict_names_the_checks_that_failed(void **state)
{
    (void)state;
    put("run.log", "");
    put("summary.csv", "about,name,quantity,value,unit\nrun,\"\",\"status\",\"finished\",text\n");
    put("checks.csv", "check,measure,unit,measured,wanted,low,high,verdict,source\n"
                      "\"near\",mean,Pa,2e9,2e9,1.9e9,2.1e9,passed,\"\"\n"
                      "\"far\",mean,Pa,nan,nan,-inf,1e9,failed,\"a, \"\"book\"\"\"\n");
    char *page = page_of_folder();
    expect_on_page(page, "Failed: 1 of 2 checks.</strong> far");
    expect_on_page(page, "2\u00a0GPa ± 100\u00a0MPa");
    expect_on_page(page, "at most 1\u00a0GPa");
    expect_on_page(page, ">nothing<");
    expect_on_page(page, "a, &quot;book&quot;");
    free(page);
}

static void a_known_deviation_has_its_own_mark_and_reason(void **state)
{
    (void)state;
    put("run.log", "");
    put("summary.csv", "about,name,quantity,value,unit\nrun,\"\",\"status\",\"finished\",text\n");
    put("checks.csv",
        "check,measure,unit,measured,wanted,low,high,verdict,source,time,known_deviation\n"
        "\"near\",mean,Pa,2e9,2e9,1.9e9,2.1e9,passed,\"\",1,\"\"\n"
        "\"far\",mean,Pa,3e9,nan,-inf,1e9,known deviation,\"a\",1,\"the <frame> creeps\"\n");
    char *page = page_of_folder();
    expect_on_page(page, "Passed: 1 of 2 checks.</strong> <strong>1 known deviation:</strong> far");
    expect_on_page(page, "△ known deviation");
    expect_on_page(page, "a<br>known deviation: the &lt;frame&gt; creeps");
    expect_not_on_page(page, "✗");
    free(page);
    put("checks.csv",
        "check,measure,unit,measured,wanted,low,high,verdict,source,time,known_deviation\n"
        "\"far\",mean,Pa,3e9,nan,-inf,1e9,known deviation,\"a\",1,\"it creeps\"\n"
        "\"near\",mean,Pa,2e9,2e9,1.9e9,2.1e9,passes now,\"\",1,\"\"\n");
    page = page_of_folder();
    expect_on_page(page,
                   "Failed: 1 of 2 checks.</strong> near <strong>1 known deviation:</strong> far");
    expect_on_page(page, "✗ passes now");
    free(page);
}

static void a_failed_run_says_so_on_top(void **state)
{
    (void)state;
    put("run.log", "");
    put("summary.csv", "about,name,quantity,value,unit\n"
                       "run,\"\",\"status\",\"failed\",text\n"
                       "run,\"\",\"error\",\"the wings came off\",text\n"
                       "run,\"\",\"error\",\"and the tail\",text\n"
                       "run,\"\",\"steps\",3,\nrun,\"\",\"time\",1e-9,s\n"
                       "run,\"\",\"until\",2e-9,s\n");
    char *page = page_of_folder();
    expect_on_page(page, "The run failed at step 3, t = 1\u00a0ns of 2\u00a0ns");
    expect_on_page(page, "the wings came off");
    expect_on_page(page, "and the tail");
    free(page);
}

static void numbers_that_are_none_interrupt_the_lines(void **state)
{
    (void)state;
    put("run.log", "");
    put("history.csv",
        "time [s],mass [kg],energy [J],kinetic_energy [J],internal_energy [J],energy_drift\n"
        "0,1,nan,1,nan,0\n1,1,nan,inf,nan,nan\n2,1,nan,2,nan,0\n3,1,nan,-inf,nan,0\n4,1,nan,1,nan,"
        "0\n");
    char *page = page_of_folder();
    expect_not_on_page(page, "Lnan");
    expect_not_on_page(page, "Mnan");
    expect_not_on_page(page, "inf ");
    expect_on_page(page, "class=\"chart\"");
    expect_on_page(page, "null");
    expect_on_page(page, "not a number");
    free(page);
}

static void long_histories_stay_small(void **state)
{
    (void)state;
    put("run.log", "");
    char *path = path_join(folder, "history.csv");
    FILE *file = fopen(path, "w");
    fputs("time [s],pressure.min [Pa],pressure.max [Pa]\n", file);
    for (int i = 0; i < 20000; i++)
        fprintf(file, "%d,%d,%d\n", i, -(i % 7), i % 11);
    fclose(file);
    free(path);
    char *page = page_of_folder();
    assert_true(strlen(page) < 400000); /* dygraphs among it */
    free(page);
}

static void all_of_many_pictures_are_shown(void **state)
{
    (void)state;
    put("run.log", "");
    put("summary.csv", "about,name,quantity,value,unit\npicture,\"000099\",\"time\",4e-6,s\n");
    make_pictures_folder();
    for (int i = 0; i < 100; i++) {
        char name[40];
        snprintf(name, sizeof name, "velocity.x-%06d.png", i);
        put_picture(name);
    }
    put_bytes("pictures/broken-000001.png", "no picture", 10);
    put_bytes("pictures/empty-000001.png", "", 0);
    put_picture("velocity.x-000001-000002.png");
    char *page = page_of_folder();
    assert_int_equal(count_of(page, "alt=\"Particles by"), 101);
    assert_int_equal(count_of(page, "class=\"key\""), 5);
    assert_int_equal(count_of(page, "class=\"player\" data-name=\"velocity.x\""), 1);
    expect_on_page(page, ">picture 0<");
    expect_on_page(page, "alt=\"Particles by velocity.x, 4\u00a0µs\" width=\"2\" height=\"3\"");
    free(page);
}

static void probes_are_plotted_by_quantity(void **state)
{
    (void)state;
    char path[128];
    put("run.log", "");
    snprintf(path, sizeof path, "%s/probes", folder);
    assert_int_equal(mkdir(path, 0777), 0);
    put("probes/gauge.csv", "time [s],pressure [Pa],stress.xx [Pa],speed [m/s],sound_speed [m/s]\n"
                            "0,1,2,3,5000\n1,2,3,4,5001\n");
    put("probes/none.csv", "");
    char *page = page_of_folder();
    assert_int_equal(count_of(page, "class=\"chart\""), 3);
    expect_on_page(page, "gauge over time; pressure from 1\u00a0Pa to 2\u00a0Pa; stress.xx");
    expect_on_page(page, "gauge: speed over time");
    expect_on_page(page, "gauge: sound_speed over time");
    free(page);
}

static void the_last_profile_is_drawn_with_its_band(void **state)
{
    (void)state;
    char path[128];
    put("run.log", "");
    snprintf(path, sizeof path, "%s/profiles", folder);
    assert_int_equal(mkdir(path, 0777), 0);
    put("profiles/layer-000000.csv", "x [m],particles,pressure.mean [Pa],pressure.spread [Pa]\n"
                                     "0,1,7,1\n1,1,8,1\n");
    put("profiles/layer-000001.csv",
        "material,x [m],particles,pressure.mean [Pa],pressure.spread [Pa]\n"
        "\"lead\",0,1,2,1\n\"lead\",1,0,nan,nan\n\"lead\",2,1,4,1\n"
        "\"tin\",0,1,5,0\n\"tin\",1,1,6,0\n\"tin\",2,1,8,0\n");
    put("profiles/odd.csv", "x\n");
    char *page = page_of_folder();
    assert_int_equal(count_of(page, "class=\"chart\""), 1);
    assert_int_equal(count_of(page, "\"low\":["), 2);
    expect_on_page(page, "\"value\":[2,null,4],\"low\":[1,null,3],\"high\":[3,null,5]");
    expect_on_page(page, "layer: pressure over x; lead from 2\u00a0Pa to 4\u00a0Pa; tin from 5");
    free(page);
}

int main(void)
{
#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_folder, remove_folder)
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_html_takes_for_its_own_is_escaped),
        cmocka_unit_test(what_is_not_utf8_becomes_replacement_characters),
        cmocka_unit_test(quantities_are_written_as_a_person_reads_them),
        cmocka_unit_test(base64_is_that_of_rfc_4648),
        IN_FOLDER(quoted_fields_hold_commas_quotes_and_lines),
        IN_FOLDER(rows_of_other_lengths_are_filled_up_or_cut),
        IN_FOLDER(a_text_written_is_the_text_read),
        IN_FOLDER(a_folder_without_a_run_is_refused),
        IN_FOLDER(a_run_that_left_nothing_but_its_log_gets_a_page),
        IN_FOLDER(every_name_of_a_case_is_escaped),
        IN_FOLDER(the_verdict_names_the_checks_that_failed),
        IN_FOLDER(a_known_deviation_has_its_own_mark_and_reason),
        IN_FOLDER(a_failed_run_says_so_on_top),
        IN_FOLDER(numbers_that_are_none_interrupt_the_lines),
        IN_FOLDER(long_histories_stay_small),
        IN_FOLDER(all_of_many_pictures_are_shown),
        IN_FOLDER(probes_are_plotted_by_quantity),
        IN_FOLDER(the_last_profile_is_drawn_with_its_band),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
