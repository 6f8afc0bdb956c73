/* SPDX-License-Identifier: MIT
 * version.c: the smallest program that links the library; what the install test builds when there is no README. */
#include <stdio.h>

#include <tahr/tahr.h>

int main(void)
{
    if (tahr_abi_check(TAHR_ABI) < 0) return 1;
    puts(tahr_version());
    return 0;
}
