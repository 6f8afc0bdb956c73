/* SPDX-License-Identifier: MIT
 * plugin.c: backends from shared objects. Everything else of the library is pure computation; this file and
 * plugin_file.c alone reach for the system, and TAHR_NO_PLUGINS takes that away. */
#include <tahr/plugin.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "backend_check.h"
#include "message.h"
#include "plugin_file.h"

#define ENTRY "tahr_backend_v1"
static const char FUNCTION[] = "tahr_plugin_load";

struct tahr_plugin {
    void *library;
    const tahr_backend *backend;
};

/* One of three systems: it opens (NULL: why is in text), finds the entry and closes. */
#if defined(TAHR_NO_PLUGINS)
#define TAHR__LOADS 0
#elif defined(_WIN32)
#define TAHR__LOADS 1
/* Declared here, for windows.h is large and redefines words. */
__declspec(dllimport) void *__stdcall LoadLibraryA(const char *path);
__declspec(dllimport) int __stdcall FreeLibrary(void *library);
__declspec(dllimport) unsigned long __stdcall GetLastError(void);
__declspec(dllimport) void (*__stdcall GetProcAddress(void *library, const char *name))(void);

static const char HERE[] = ".\\", SEPARATORS[] = "/\\:";

static void *open_library(char *path, char *text, size_t room)
{
    for (char *c = path; *c; c++) { /* with a forward slash it would be searched for */
        *c = *c == '/' ? '\\' : *c;
    }
    void *library = LoadLibraryA(path);
    if (!library) {
        snprintf(text, room, "Windows says error %lu", GetLastError());
    }
    return library;
}

static tahr_backend_fn find_entry(void *library)
{
    return (tahr_backend_fn)GetProcAddress(library, ENTRY);
}

static void close_library(void *library)
{
    FreeLibrary(library);
}
#elif defined(__unix__) || defined(__APPLE__) || defined(__HAIKU__)
#define TAHR__LOADS 1
#include <dlfcn.h>

static const char HERE[] = "./", SEPARATORS[] = "/";

static void *open_library(char *path, char *text, size_t room)
{
    const size_t length = strlen(path);
    if (!tahr__plugin_file_check(path, text, room)) {
        return NULL;
    }
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        const char *why = dlerror();
        why = why ? why : "no reason given";
        why += strncmp(why, path, length) == 0 && strncmp(why + length, ": ", 2) == 0 ? length + 2 : 0;
        snprintf(text, room, "%s", why);
    }
    return library;
}

static tahr_backend_fn find_entry(void *library)
{
    void *symbol = dlsym(library, ENTRY);
    tahr_backend_fn entry;
    memcpy(&entry, &symbol, sizeof entry); /* ISO C has no cast between the two */
    return entry;
}

static void close_library(void *library)
{
    dlclose(library);
}
#else
#define TAHR__LOADS 0
#endif

#if TAHR__LOADS
/* The path with a folder in it, so that the system does not search for it; NULL without memory. */
static char *explicit_path(const char *path)
{
    size_t length = strlen(path), here = strpbrk(path, SEPARATORS) ? 0 : strlen(HERE);
    char *copy = malloc(here + length + 1);
    if (copy) {
        memcpy(copy, HERE, here);
        memcpy(copy + here, path, length + 1);
    }
    return copy;
}

/* Asks an opened library for its backend and checks it. */
static tahr_status ask(void *library, const char *path, const tahr_log *log, const tahr_backend **backend)
{
    char text[200];
    tahr_backend_fn entry = find_entry(library);
    if (!entry) {
        snprintf(text, sizeof text, "no function " ENTRY ", expected in every backend, in %.100s", path);
        tahr__say(log, TAHR_LOG_ERROR, FUNCTION, text);
        return TAHR_E_NOT_FOUND;
    }
    *backend = entry();
    if (!*backend) {
        snprintf(text, sizeof text, ENTRY " returned NULL, expected a backend, in %.100s", path);
        tahr__say(log, TAHR_LOG_ERROR, FUNCTION, text);
        return TAHR_E_NULL;
    }
    return tahr__backend_check(*backend, log, FUNCTION, path);
}

static tahr_status load(char *path, const tahr_log *log, tahr_plugin *plugin)
{
    char why[160] = "", text[240];
    plugin->library = open_library(path, why, sizeof why);
    if (!plugin->library) {
        snprintf(text, sizeof text, "%.80s does not load: %.140s", path, why);
        tahr__say(log, TAHR_LOG_ERROR, FUNCTION, text);
        return TAHR_E_NOT_FOUND;
    }
    tahr_status status = ask(plugin->library, path, log, &plugin->backend);
    if (status < 0) {
        close_library(plugin->library);
    }
    return status;
}

tahr_status tahr_plugin_load(const char *path, const tahr_log *log, tahr_plugin **out)
{
    if (!path || !out) {
        return tahr__complain(log, TAHR_E_NULL, FUNCTION, path ? "plugin" : "path", "is NULL");
    }
    char *copy = explicit_path(path);
    tahr_plugin *plugin = copy ? malloc(sizeof *plugin) : NULL;
    tahr_status status = TAHR_E_MEMORY;
    if (plugin) {
        status = load(copy, log, plugin);
    } else {
        tahr__complain(log, status, FUNCTION, "malloc", "returned NULL");
    }
    free(copy);
    if (status < 0) {
        free(plugin);
        return status;
    }
    *out = plugin;
    return TAHR_OK;
}

void tahr_plugin_unload(tahr_plugin *plugin)
{
    if (plugin) {
        close_library(plugin->library);
        free(plugin);
    }
}
#else
tahr_status tahr_plugin_load(const char *path, const tahr_log *log, tahr_plugin **out)
{
    if (!path || !out) {
        return tahr__complain(log, TAHR_E_NULL, FUNCTION, path ? "plugin" : "path", "is NULL");
    }
    return tahr__complain(log, TAHR_E_UNSUPPORTED, FUNCTION, ENTRY, "cannot be loaded: built without shared objects");
}

void tahr_plugin_unload(tahr_plugin *plugin)
{
    free(plugin);
}
#endif

const tahr_backend *tahr_plugin_backend(const tahr_plugin *plugin)
{
    return plugin ? plugin->backend : NULL;
}
