/* SPDX-License-Identifier: MIT
 * test_wandering_full.c: 400 000 steps on every level; 100 000 with ccd, which is slower. */
#include "wandering.h"

int main(int argc, char **argv)
{
    return wandering_run(400000 / 16, 100000 / 16, argc, argv);
}
