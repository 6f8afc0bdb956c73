/* SPDX-License-Identifier: MIT
 * captured.h: a command of the shell called from a test, and what it said. */
#ifndef TESTS_CLI_CAPTURED_H
#define TESTS_CLI_CAPTURED_H

/* Calls a command with its words, which end in NULL, the first its name; what it prints on both streams is kept. */
int captured(int (*command)(int, char **), const char *const *words);

/* What the last one said; to be freed. */
char *captured_text(void);

/* Fails the test where that does not hold these words. */
void assert_said(const char *words);

#endif
