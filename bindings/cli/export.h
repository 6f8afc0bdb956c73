/* SPDX-License-Identifier: MIT
 * export.h: `tahr level`: the bundled level as a file. */
#ifndef TAHR_CLI_EXPORT_H
#define TAHR_CLI_EXPORT_H

int export_command(int argc, char **argv);

#endif
