/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Guesses the encoding from the bytes: UTF-8 if valid, else Shift-JIS if is_japanese finds evidence, else
 * Windows-1252, which includes Latin-1. Depends on iconv and text/characters. */
#include "text/encoding.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "text/characters.h"

static bool is_utf8(const char *text, size_t len) {
    for (size_t i = 0, n = 1; i < len; i += n) {
        n = (unsigned char)text[i] < 0x80 ? 1 : character_at(text + i, len - i, NULL);
        if (n == 0)
            return false;
    }
    return true;
}

/* Valid Shift-JIS, with evidence: lead bytes 0x81-0x9f, punctuation in Windows-1252, count 2, or 1 before
 * ASCII. Lead bytes from 0xe0 on, letters in Windows-1252, count nothing. */
static bool is_japanese(const char *text, size_t len) {
    unsigned evidence = 0;
    for (size_t i = 0; i < len; i++) {
        const unsigned first = (unsigned char)text[i], second = i + 1 < len ? (unsigned char)text[i + 1] : 0;
        if (first < 0x80 || (first >= 0xa1 && first <= 0xdf)) /* a character of one byte */
            continue;
        if (first == 0x80 || first == 0xa0 || first > 0xfc || second < 0x40 || second == 0x7f ||
            second > 0xfc)
            return false;
        evidence += first >= 0xa0 ? 0 : second < 0x80 ? 1 : 2;
        i++;
    }
    return evidence >= 2;
}

bool encoding_open(iconv_t *by, const char *name, const char *told, const char *path, calc_error *error) {
    *by = iconv_open("UTF-8", name);
    if (*by != (iconv_t)-1)
        return true;
    const int code = errno;
    *by = NULL;
    return code == EINVAL
               ? calc_fail(error, 0, 0, "%s is in %s, which this system cannot read: save it as UTF-8", path,
                           told)
               : calc_errno(error, code, "cannot read %s", path);
}

size_t encoding_decode(iconv_t by, size_t unit, char *from, size_t *len, char *to, size_t room) {
    char *const begin = to;
    while (*len > 0 && iconv(by, &from, len, &to, &room) == (size_t)-1 && errno == EILSEQ) {
        const size_t n = character_put(CHARACTER_LOST, to), bad = *len < unit ? *len : unit;
        to += n;
        room -= n;
        from += bad;
        *len -= bad;
    }
    return (size_t)(to - begin);
}

/* Repairs micro and degree signs that were encoded as UTF-8 twice. */
static void unmangle(char *text, size_t *len) {
    size_t n = 0;
    for (size_t i = 0; i < *len; i++) {
        if (text[i] == '\xc3' &&
            (!strncmp(text + i, "\xc3\x82\xc2\xb5", 4) || !strncmp(text + i, "\xc3\x82\xc2\xb0", 4)))
            i += 2;
        text[n++] = text[i];
    }
    text[n] = 0;
    *len = n;
}

bool encoding_to_utf8(char **text, size_t *len, const char **was, const char *path, calc_error *error) {
    *was = NULL;
    if (is_utf8(*text, *len)) {
        unmangle(*text, len);
        return true;
    }
    const bool by_pairs = is_japanese(*text, *len);
    iconv_t by;
    if (!encoding_open(&by, by_pairs ? "CP932" : "CP1252", by_pairs ? "Shift-JIS" : "Windows-1252", path,
                       error))
        return false;
    size_t room = 3 * *len, left = *len; /* each byte becomes at most 3 */
    char *to = malloc(room + CHARACTER_BYTES);
    if (to) {
        *was = by_pairs ? "Shift-JIS" : NULL;
        *len = encoding_decode(by, 1, *text, &left, to, room);
        to[*len] = 0;
        free(*text);
        *text = to;
    }
    iconv_close(by);
    return to || calc_no_memory(error);
}
