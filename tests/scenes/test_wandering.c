/* SPDX-License-Identifier: MIT
 * test_wandering.c: 2 000 steps of 16 characters on every level and backend. */
#include "wandering.h"

int main(int argc, char **argv)
{
    return wandering_run(2000, 2000, argc, argv);
}
