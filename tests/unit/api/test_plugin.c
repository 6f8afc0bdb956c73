/* SPDX-License-Identifier: MIT
 * test_plugin.c: backends from shared objects: what is loaded works as if it were linked, what is broken is refused. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include <tahr/box2d.h>
#include <tahr/ccd.h>
#include <tahr/fcl.h>
#include <tahr/native.h>
#include <tahr/plugin.h>
#include <tahr/tahr.h>

#include "fake_host.h"

#ifdef TEST_PLUGINS

#ifdef TAHR_HAVE_TEMPLATE
TAHR_API const tahr_backend *tahr_backend_v1_template(void);
#endif

/* The statically linked twins of those that hold a world to walk in. */
static const struct {
    const char *name;
    tahr_backend_fn get;
} linked[] = {
    {"native", tahr_backend_v1_native},
#ifdef TAHR_HAVE_CCD
    {"ccd", tahr_backend_v1_ccd},
#endif
#ifdef TAHR_HAVE_FCL
    {"fcl", tahr_backend_v1_fcl},
#endif
#ifdef TAHR_HAVE_TEMPLATE
    {"template", tahr_backend_v1_template},
#endif
};

/* A character on a floor, and up a low box; returns the hash of all that happened. */
static uint64_t walk(const tahr_backend *backend)
{
    static const double vertices[] = {-20, -20, 0, 20, -20, 0, 20, 20, 0, -20, 20, 0};
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    tahr_body_desc bodies[2];
    tahr_world_desc desc;
    tahr_world *world;
    tahr_mover *mover;
    tahr_config config;
    tahr_state state;
    tahr_input input = {.struct_size = sizeof input, .move = {1, 0.25, 0}};
    uint64_t hash = 0;
    tahr_body_desc_init(&bodies[0], sizeof bodies[0], TAHR_BODY_MESH);
    tahr_body_desc_init(&bodies[1], sizeof bodies[1], TAHR_BODY_BOX);
    bodies[0].vertices = vertices, bodies[0].vertex_count = 4;
    bodies[0].indices = indices, bodies[0].triangle_count = 2;
    if (!(backend->capabilities & TAHR_CAP_MESH)) {
        tahr_body_desc_init(&bodies[0], sizeof bodies[0], TAHR_BODY_BOX);
        bodies[0].pose.position.z = -1;
        bodies[0].half_extents = (tahr_vec3){20, 20, 1};
    }
    bodies[1].pose.position = (tahr_vec3){13, 0, 0};
    bodies[1].half_extents = (tahr_vec3){10, 15, 0.3};
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies, desc.body_count = 2;
    assert_int_equal(tahr_world_open(backend, &desc, &world), TAHR_OK);
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    assert_int_equal(tahr_mover_create(world, &config, &mover), TAHR_OK);
    tahr_state_init(&state, &config, &(tahr_vec3){0, 0, 1});
    for (int i = 0; i < 120; i++) {
        assert_true(tahr_mover_step(mover, &input, 1 / 60.0, &state, NULL) >= 0);
        hash = hash * 31 + tahr_state_hash(&state);
    }
    assert_true(state.position.x > 4 && state.position.z > 1.1); /* climbed the box of 0.3 m */
    tahr_mover_destroy(mover);
    tahr_world_close(world);
    return hash;
}

static void path_of(const char *folder, const char *prefix, const char *name, const char *suffix, char path[512])
{
    snprintf(path, 512, "%s/%s%s%s", folder, prefix, name, suffix);
}

static void every_built_plugin_loads_and_walks_like_its_linked_twin(void **unused)
{
    char names[] = TEST_PLUGINS, path[512];
    fake_log messages = {0};
    tahr_log log = fake_log_of(&messages);
    (void)unused;
    for (char *name = strtok(names, " "); name; name = strtok(NULL, " ")) {
        tahr_plugin *plugin = NULL;
        path_of(TEST_PLUGIN_FOLDER, "libtahr_", name, TEST_PLUGIN_SUFFIX, path);
        tahr_status status = tahr_plugin_load(path, &log, &plugin);
        if (status < 0) {
            fail_msg("%s: %s", path, messages.text);
        }
        const tahr_backend *backend = tahr_plugin_backend(plugin);
        assert_string_equal(backend->name, name);
        for (size_t i = 0; i < sizeof linked / sizeof linked[0]; i++) {
            if (strcmp(linked[i].name, name) == 0) {
                assert_ptr_not_equal(backend, linked[i].get());
                assert_true(walk(backend) == walk(linked[i].get()));
            }
        }
        tahr_plugin_unload(plugin);
    }
    assert_int_equal(messages.count, 0);
}

static void a_broken_plugin_is_refused_and_the_message_says_what_was_expected(void **unused)
{
    const struct {
        const char *name;
        tahr_status status;
        const char *found, *expected;
    } broken[] = {
        {"no_symbol", TAHR_E_NOT_FOUND, "no function tahr_backend_v1", "expected"},
        {"null_table", TAHR_E_NULL, "tahr_backend_v1 returned NULL", "expected a backend"},
        {"small_struct", TAHR_E_STRUCT_SIZE, "backend.struct_size is", "expected at least"},
        {"tiny_struct", TAHR_E_STRUCT_SIZE, "backend.struct_size is 4", "expected at least"},
        {"bad_major", TAHR_E_ABI, "are 1.1", "expected 0.1"},
        {"bad_minor", TAHR_E_ABI, "are 0.2", "expected 0.1"},
        {"null_slot", TAHR_E_NULL, "backend.ray is NULL", "expected a function"},
        {"null_name", TAHR_E_NULL, "backend.name is NULL", "expected a text"},
    };
    (void)unused;
    for (size_t i = 0; i < sizeof broken / sizeof broken[0]; i++) {
        char path[512];
        fake_log messages = {0};
        tahr_log log = fake_log_of(&messages);
        tahr_plugin *plugin = (tahr_plugin *)path; /* untouched on failure */
        path_of(TEST_BROKEN_FOLDER, "", broken[i].name, TEST_BROKEN_SUFFIX, path);
        assert_int_equal(access(path, R_OK), 0);
        assert_int_equal(tahr_plugin_load(path, &log, &plugin), broken[i].status);
        assert_ptr_equal(plugin, path);
        assert_int_equal(messages.count, 1);
        assert_ptr_equal(strstr(messages.text, "tahr_plugin_load: "), messages.text);
        assert_non_null(strstr(messages.text, broken[i].found));
        assert_non_null(strstr(messages.text, broken[i].expected));
        assert_int_equal(tahr_plugin_load(path, NULL, &plugin), broken[i].status); /* silent is allowed */
    }
}

static void what_is_no_library_is_not_found(void **unused)
{
    const char *const paths[] = {"nowhere/libtahr_none.so", TAHR_SOURCE_DIR "/README.md", TAHR_SOURCE_DIR, "", "."};
    (void)unused;
    for (size_t i = 0; i < sizeof paths / sizeof paths[0]; i++) {
        fake_log messages = {0};
        tahr_log log = fake_log_of(&messages);
        tahr_plugin *plugin = NULL;
        assert_int_equal(tahr_plugin_load(paths[i], &log, &plugin), TAHR_E_NOT_FOUND);
        assert_null(plugin);
        assert_int_equal(messages.count, 1);
        assert_non_null(strstr(messages.text, " does not load: "));
    }
}

#ifdef __linux__
/* A copy or a build under way: loaders crash on such a file. Nobody writes into the pipe: opening it would wait. */
static void files_that_end_early_and_pipes_are_refused_before_they_are_loaded(void **unused)
{
    static char bytes[1 << 24];
    char path[512], folder[] = TEST_BROKEN_FOLDER "/cut_XXXXXX", copy[512], pipe_path[512];
    (void)unused;
    path_of(TEST_PLUGIN_FOLDER, "libtahr_", "native", TEST_PLUGIN_SUFFIX, path);
    FILE *whole = fopen(path, "rb");
    assert_non_null(whole);
    size_t size = fread(bytes, 1, sizeof bytes, whole);
    fclose(whole);
    assert_true(size > 10000 && size < sizeof bytes);
    assert_non_null(mkdtemp(folder));
    snprintf(copy, sizeof copy, "%s/cut.so", folder);
    snprintf(pipe_path, sizeof pipe_path, "%s/pipe.so", folder);
    assert_int_equal(mkfifo(pipe_path, 0600), 0);
    unsigned long needed = size; /* what is behind the last segment need not be there: the first answer tells */
    for (unsigned long i = 0; i <= 51; i++) { /* the last one is the pipe */
        fake_log messages = {0};
        tahr_log log = fake_log_of(&messages);
        tahr_plugin *plugin = NULL;
        FILE *part = fopen(copy, "wb");
        assert_non_null(part);
        fwrite(bytes, 1, i == 0 ? 60 : i == 1 ? 4096 : (needed - 1) / 50 * i, part);
        fclose(part);
        assert_int_equal(tahr_plugin_load(i < 51 ? copy : pipe_path, &log, &plugin), TAHR_E_NOT_FOUND);
        assert_null(plugin);
        const char *why = i == 0   ? "does not load: "
                          : i < 51 ? "the file is cut off: it has"
                                   : "is a pipe, expected a file";
        if (!strstr(messages.text, why)) {
            fail_msg("cut %lu: %s", i, messages.text);
        }
        const char *least = strstr(messages.text, "expected at least ");
        if (i == 1) {
            assert_non_null(least);
            needed = strtoul(least + strlen("expected at least "), NULL, 10);
            assert_true(needed > 10000 && needed <= size);
        }
    }
    remove(copy);
    remove(pipe_path);
    rmdir(folder);
}
#endif

static void a_name_without_a_folder_is_the_one_in_the_working_directory(void **unused)
{
    char before[512];
    tahr_plugin *plugin = NULL;
    (void)unused;
    assert_non_null(getcwd(before, sizeof before));
    assert_int_equal(tahr_plugin_load("libm.so.6", NULL, &plugin),
                     TAHR_E_NOT_FOUND); /* the system's is not looked for */
    assert_int_equal(chdir(TEST_PLUGIN_FOLDER), 0);
    assert_int_equal(tahr_plugin_load("libtahr_native" TEST_PLUGIN_SUFFIX, NULL, &plugin), TAHR_OK);
    assert_int_equal(chdir(before), 0);
    tahr_plugin_unload(plugin);
}

/* The second load of a refused object would succeed with a stale handle if the first stayed: dlopen counts. */
static void nothing_of_a_refused_plugin_stays_loaded(void **unused)
{
    char path[512], line[1024];
    tahr_plugin *plugin = NULL;
    int found = 0;
    (void)unused;
    path_of(TEST_BROKEN_FOLDER, "", "bad_major", TEST_BROKEN_SUFFIX, path);
    assert_int_equal(tahr_plugin_load(path, NULL, &plugin), TAHR_E_ABI);
    FILE *maps = fopen("/proc/self/maps", "r");
    if (!maps) {
        printf("SKIP: unit_api_plugin: /proc/self/maps is not there\n");
        skip();
    }
    while (fgets(line, sizeof line, maps)) {
        found |= strstr(line, "/bad_major") != NULL;
    }
    fclose(maps);
    assert_false(found);
}

static void null_arguments_are_refused(void **unused)
{
    fake_log messages = {0};
    tahr_log log = fake_log_of(&messages);
    tahr_plugin *plugin = NULL;
    (void)unused;
    assert_int_equal(tahr_plugin_load(NULL, &log, &plugin), TAHR_E_NULL);
    assert_non_null(strstr(messages.text, "path is NULL"));
    assert_int_equal(tahr_plugin_load("x.so", &log, NULL), TAHR_E_NULL);
    assert_non_null(strstr(messages.text, "plugin is NULL"));
    assert_null(tahr_plugin_backend(NULL));
    tahr_plugin_unload(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_built_plugin_loads_and_walks_like_its_linked_twin),
        cmocka_unit_test(a_broken_plugin_is_refused_and_the_message_says_what_was_expected),
        cmocka_unit_test(what_is_no_library_is_not_found),
#ifdef __linux__
        cmocka_unit_test(files_that_end_early_and_pipes_are_refused_before_they_are_loaded),
#endif
        cmocka_unit_test(a_name_without_a_folder_is_the_one_in_the_working_directory),
        cmocka_unit_test(nothing_of_a_refused_plugin_stays_loaded),
        cmocka_unit_test(null_arguments_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
#else
int main(void)
{
    printf("SKIP: unit_api_plugin: no shared libraries were built\n");
    return 77;
}
#endif
