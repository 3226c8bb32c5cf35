/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which encoding the text of a file has, where nothing in the file says it. Touches nothing but iconv. */
#ifndef TEXT_ENCODING_H
#define TEXT_ENCODING_H

#include <iconv.h>

#include "text/error.h"

/* From the encoding of this name, which is told so, to UTF-8; NULL with the error. */
bool encoding_open(iconv_t *by, const char *name, const char *told, const char *path, calc_error *error);
/* To UTF-8, of which there is room for 3 bytes a unit; units that are no characters are replaced. What it has
 * written; *len: bytes at the end that are no whole character. */
size_t encoding_decode(iconv_t by, size_t unit, char *from, size_t *len, char *to, size_t room);

/* Makes *text, which may be freed, UTF-8, and NUL-terminated: of Windows-1252, or of Shift-JIS. was:
 * "Shift-JIS", or NULL. */
bool encoding_to_utf8(char **text, size_t *len, const char **was, const char *path, calc_error *error);

#endif
