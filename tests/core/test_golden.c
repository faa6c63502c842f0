// One hash per scene file, in tests/golden.json: the same for every thread count, compiler, optimisation
// level and for wasm (web tests read the same file). After a change of the physics that is meant:
//
//   WEIR_UPDATE_GOLDEN=1 ctest -R golden
#include <dirent.h>
#include <inttypes.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/build.h"
#include "json/json_scene.h"

static const char golden_path[] = WEIR_TEST_SOURCE_DIR "/tests/golden.json";
static const char scenes_path[] = WEIR_TEST_SOURCE_DIR "/scenes";

enum { NAME_LENGTH = 100 };

static WeirScene *load(const char *name)
{
    char path[4096], message[600] = "";
    assert_true(snprintf(path, sizeof path, "%s/%s.json", scenes_path, name) < (int)sizeof path);
    WeirScene *scene = NULL;
    if (weir_json_load_scene(path, &scene, message, sizeof message) != WEIR_OK) fail_msg("%s", message);
    return scene;
}

// Few steps for many particles: sanitized builds run this too.
static uint32_t steps_for(uint32_t particles)
{
    uint32_t steps = 500000 / particles;
    return steps < 3 ? 3 : steps > 60 ? 60 : steps;
}

static void hash_text(WeirScene *scene, uint32_t threads, uint32_t steps, char text[24])
{
    WeirSim *sim = weir_test_sim(scene, NULL, threads);
    weir_test_step(sim, steps);
    snprintf(text, 24, "0x%016" PRIx64, weir_test_hash(sim));
    weir_sim_destroy(sim);
}

// Calls `visit` for every scenes/*.json; returns how many there are.
static int for_each_scene(void (*visit)(const char *name, json_t *golden), json_t *golden)
{
    DIR *folder = opendir(scenes_path);
    assert_non_null(folder);
    int count = 0;
    for (struct dirent *entry; (entry = readdir(folder));) {
        char name[NAME_LENGTH];
        size_t length = strlen(entry->d_name);
        if (length < 6 || length >= NAME_LENGTH || strcmp(entry->d_name + length - 5, ".json") != 0) continue;
        memcpy(name, entry->d_name, length - 5);
        name[length - 5] = '\0';
        visit(name, golden);
        ++count;
    }
    closedir(folder);
    return count;
}

static void update_scene(const char *name, json_t *golden)
{
    WeirScene *scene = load(name);
    uint32_t steps = steps_for(weir_scene_particle_count(scene));
    char hash[24];
    hash_text(scene, 0, steps, hash);
    json_object_set_new(golden, name, json_pack("{s:i,s:s}", "steps", (int)steps, "hash", hash));
    weir_scene_destroy(scene);
}

static void check_scene(const char *name, json_t *golden)
{
    json_t *entry = json_object_get(golden, name);
    if (!entry)
        fail_msg("scenes/%s.json is not in tests/golden.json: WEIR_UPDATE_GOLDEN=1 ctest -R golden", name);
    uint32_t steps = (uint32_t)json_integer_value(json_object_get(entry, "steps"));
    const char *expected = json_string_value(json_object_get(entry, "hash"));
    assert_true(steps > 0 && expected);
    WeirScene *scene = load(name);
    static const uint32_t threads[] = {1, 2, 7};
    for (int n = 0; n < 3; ++n) {
        char hash[24];
        hash_text(scene, threads[n], steps, hash);
        if (strcmp(hash, expected) != 0)
            fail_msg("%s: %s after %u steps with %u threads, not %s", name, hash, (unsigned)steps,
                     (unsigned)threads[n], expected);
    }
    weir_scene_destroy(scene);
}

static void every_scene_has_its_golden_hash(void **state)
{
    (void)state;
    if (getenv("WEIR_UPDATE_GOLDEN")) {
        json_t *updated = json_object();
        for_each_scene(update_scene, updated);
        assert_int_equal(json_dump_file(updated, golden_path, JSON_INDENT(2) | JSON_SORT_KEYS), 0);
        json_decref(updated);
    }
    json_error_t error;
    json_t *golden = json_load_file(golden_path, 0, &error);
    if (!golden) fail_msg("tests/golden.json:%d: %s", error.line, error.text);
    int scenes = for_each_scene(check_scene, golden);
    // No entry without a scene either.
    assert_int_equal(scenes, json_object_size(golden));
    assert_true(scenes >= 6);
    json_decref(golden);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_scene_has_its_golden_hash)};
    return cmocka_run_group_tests_name("golden", tests, NULL, NULL);
}
