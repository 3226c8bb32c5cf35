/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Guesses the encoding of a text and converts it to UTF-8. Depends on iconv alone. */
#ifndef TEXT_ENCODING_H
#define TEXT_ENCODING_H

#include <iconv.h>

#include "text/error.h"

/* Opens *by to convert from the encoding that iconv calls `name` and messages call `told` to UTF-8. On
 * failure *by is NULL and the error names the file `path`. */
bool encoding_open(iconv_t *by, const char *name, const char *told, const char *path, calc_error *error);
/* Converts `from` to `to`, which has room for 3 bytes per unit of `unit` bytes; bad units become
 * CHARACTER_LOST. Returns the bytes written; *len becomes the bytes of an incomplete last character. */
size_t encoding_decode(iconv_t by, size_t unit, char *from, size_t *len, char *to, size_t room);

/* Converts *text from UTF-8, Windows-1252 or Shift-JIS to NUL-terminated UTF-8; it may be freed and replaced.
 * *was: "Shift-JIS" if that was the guess, else NULL. */
bool encoding_to_utf8(char **text, size_t *len, const char **was, const char *path, calc_error *error);

#endif
