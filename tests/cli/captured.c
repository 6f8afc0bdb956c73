/* SPDX-License-Identifier: MIT
 * captured.c: a command of the shell called from a test, and what it said. */
#include "captured.h"

#include <getopt.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { WORDS = 24 };

static FILE *said;

int captured(int (*command)(int, char **), const char *const *words)
{
    char *copies[WORDS] = {0}, *argv[WORDS + 1] = {0}; /* a command may change the order of its arguments */
    int argc = 0;
    for (; words[argc] != NULL; argc++) {
        assert_true(argc < WORDS);
        argv[argc] = copies[argc] = strdup(words[argc]);
        assert_non_null(copies[argc]);
    }
    if (said != NULL) {
        fclose(said);
    }
    said = tmpfile();
    assert_non_null(said);
    fflush(stdout);
    fflush(stderr);
    const int out = dup(STDOUT_FILENO), err = dup(STDERR_FILENO);
    dup2(fileno(said), STDOUT_FILENO);
    dup2(fileno(said), STDERR_FILENO);
    optind = 1;
    const int code = command(argc, argv);
    fflush(stdout);
    fflush(stderr);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    close(out);
    close(err);
    for (int i = 0; i < argc; i++) {
        free(copies[i]);
    }
    return code;
}

char *captured_text(void)
{
    assert_int_equal(fseek(said, 0, SEEK_END), 0);
    const size_t size = (size_t)ftell(said);
    rewind(said);
    char *text = calloc(size + 1, 1);
    assert_non_null(text);
    assert_int_equal(fread(text, 1, size, said), size);
    return text;
}

void assert_said(const char *words)
{
    char *text = captured_text();
    const int found = strstr(text, words) != NULL;
    if (!found) {
        printf("no '%s' in:\n%s\n", words, text);
    }
    free(text);
    assert_true(found);
}
