/* SPDX-License-Identifier: MIT
 * interrupt.h: a wish to end (SIGINT, SIGTERM), noted, so that what is under way can be ended well. */
#ifndef TAHR_CLI_INTERRUPT_H
#define TAHR_CLI_INTERRUPT_H

/* From here on the first such signal is noted; a second one ends the program as always. */
void interrupt_watch(void);

/* 1 once it came. */
int interrupt_came(void);

#endif
