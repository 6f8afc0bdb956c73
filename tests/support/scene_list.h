/* SPDX-License-Identifier: MIT
 * scene_list.h: the files of tests/scenes. */
#ifndef TAHR_TEST_SCENE_LIST_H
#define TAHR_TEST_SCENE_LIST_H

enum { SCENE_MAX_FILES = 256 };

/* [out] files: their paths by name, to be freed one by one. Returns how many. Ends the program if that fails. */
int scene_list(char *files[SCENE_MAX_FILES]);

/* Is this the path of the scene of that name? */
int scene_list_is(const char *path, const char *name);

#endif
