/* SPDX-License-Identifier: MIT
 * plugin.c: backends from shared objects. */
#include <tahr/plugin.h>

tahr_status tahr_plugin_load(const char *path, const tahr_log *log, tahr_plugin **plugin)
{
    (void)path, (void)log, (void)plugin;
    return TAHR_E_UNSUPPORTED;
}

const tahr_backend *tahr_plugin_backend(const tahr_plugin *plugin)
{
    (void)plugin;
    return NULL;
}

void tahr_plugin_unload(tahr_plugin *plugin)
{
    (void)plugin;
}
