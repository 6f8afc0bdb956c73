/* SPDX-License-Identifier: MIT
 * scene.h: reading and checking the description of bodies. */
#ifndef TAHR_SCENE_H
#define TAHR_SCENE_H

#include <tahr/backend.h>

/* Name of the first bad field of a pose, or NULL. */
const char *tahr__bad_pose(const tahr_pose *pose, int zero_is_identity);

/* Checks all bodies of a scene; the log names the body and the field. Descriptions of a newer, longer header are copied
 * to an array of this library's size: [out] own, to be freed; scene->bodies then points to it. */
tahr_status tahr__bodies_read(const tahr_host *host, const tahr_log *log, tahr_world_desc *scene, tahr_body_desc **own);

/* TAHR_E_UNSUPPORTED, and a message, if a backend cannot hold one of the bodies. */
tahr_status tahr__bodies_fit(const tahr_backend *backend, const tahr_log *log, const tahr_world_desc *scene);

/* Frees what tahr__bodies_read copied; NULL is allowed. */
void tahr__bodies_free(const tahr_host *host, tahr_body_desc *own, uint32_t count);

#endif
