/* SPDX-License-Identifier: MIT
 * backends.c: the one table of collision engines that this shell was built with. */
#include "backends.h"

#include "say.h"

#include <string.h>
#include <tahr/box2d.h>
#include <tahr/ccd.h>
#include <tahr/fcl.h>
#include <tahr/native.h>

#ifdef TAHR_HAVE_BOX2D_2
static const tahr_box2d_desc box2d_2 = {.struct_size = sizeof box2d_2, .engine = TAHR_BOX2D_2};
#endif

/* Penetrations above which a check fails: 1 mm, and 5 mm, the most that any engine may have, for those that rest on a
 * library whose numbers are not ours. */
static const struct backend_choice choices[] = {
    {"native", "plain C, culls in float lanes, decides in double", tahr_backend_v1_native, NULL, 0.001},
#ifdef TAHR_HAVE_CCD
    {"ccd", "libccd and every convex shape, by the distance", tahr_backend_v1_ccd, NULL, 0.005},
#endif
#ifdef TAHR_HAVE_FCL
    {"fcl", "FCL finds candidates, the core distance decides", tahr_backend_v1_fcl, NULL, 0.005},
#endif
#ifdef TAHR_HAVE_BOX2D /* levels of two dimensions only */
    {"box2d", "Box2D, the newest there is, in a plane", tahr_backend_v1_box2d, NULL, 0.001},
#endif
#ifdef TAHR_HAVE_BOX2D_2
    {"box2d-2", "Box2D 2.4", tahr_backend_v1_box2d, &box2d_2, 0.001},
#endif
};

static const struct {
    uint32_t bit;
    const char *name;
} capabilities[] = {
    {TAHR_CAP_MARGIN, "margin"},   {TAHR_CAP_CONTACTS, "contacts"},
    {TAHR_CAP_RAY, "ray"},         {TAHR_CAP_SPHERE, "sphere"},
    {TAHR_CAP_CAPSULE, "capsule"}, {TAHR_CAP_BOX, "box"},
    {TAHR_CAP_MESH, "mesh"},       {TAHR_CAP_BIT_IDENTICAL, "bit_identical"},
    {TAHR_CAP_PLANAR, "planar"},   {TAHR_CAP_CYLINDER, "cylinder"},
    {TAHR_CAP_CONE, "cone"},       {TAHR_CAP_ELLIPSOID, "ellipsoid"},
    {TAHR_CAP_HULL, "hull"},       {TAHR_CAP_SOLIDS, "solids"},
    {TAHR_CAP_HULLS, "hulls"},     {TAHR_CAP_ROUND_SOLIDS, "round_solids"},
    {TAHR_CAP_HEIGHTS, "heights"}, {TAHR_CAP_CHAINS, "chains"},
    {TAHR_CAP_ONE_WAY, "one_way"}, {TAHR_CAP_SENSORS, "sensors"},
};

int backend_is_path(const char *text)
{
    size_t length = strlen(text);
    return strchr(text, '/') != NULL || (length > 3 && strcmp(text + length - 3, ".so") == 0);
}

int backend_load(struct backend_plugin *loaded, const char *path)
{
    const tahr_log log = say_log();
    *loaded = (struct backend_plugin){0};
    tahr_status status = tahr_plugin_load(path, &log, &loaded->plugin);
    if (status < 0) {
        say_error("--backend '%s': %s", path, tahr_status_message(status));
        return -1;
    }
    const char *name = tahr_plugin_backend(loaded->plugin)->name;
    const struct backend_choice *twin = backend_choice_find(name);
    /* How deep it may go is not known of a stranger: as deep as any of ours. */
    loaded->choice = (struct backend_choice){name, path, NULL, NULL, twin != NULL ? twin->penetration_allowed : 0.005};
    return 0;
}

void backend_unload(struct backend_plugin *loaded)
{
    tahr_plugin_unload(loaded->plugin);
    loaded->plugin = NULL;
}

const tahr_backend *backend_table(const struct backend_choice *choice)
{
    return choice->get != NULL ? choice->get() : tahr_plugin_backend(((const struct backend_plugin *)choice)->plugin);
}

const struct backend_choice *backend_choice_at(size_t index)
{
    return index < sizeof choices / sizeof *choices ? &choices[index] : NULL;
}

const struct backend_choice *backend_choice_find(const char *name)
{
    for (size_t i = 0; backend_choice_at(i) != NULL; i++) {
        if (strcmp(choices[i].name, name) == 0) {
            return &choices[i];
        }
    }
    return NULL;
}

void backend_capabilities(const tahr_backend *backend, void (*visit)(void *user, const char *name), void *user)
{
    for (size_t i = 0; i < sizeof capabilities / sizeof *capabilities; i++) {
        if (backend->capabilities & capabilities[i].bit) {
            visit(user, capabilities[i].name);
        }
    }
}
