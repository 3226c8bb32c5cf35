/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Encodings told by their bytes: what is valid UTF-8 is that; pairs whose first byte is a quotation mark or a
 * dash to Western text, and a letter to Japanese, are Shift-JIS; all else is Windows-1252, Latin-1 included.
 */
#include "text/encoding.h"

#include <iconv.h>
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

static bool is_japanese(const char *text, size_t len) {
    unsigned sure = 0;
    for (size_t i = 0; i < len; i++) {
        const unsigned first = (unsigned char)text[i], second = i + 1 < len ? (unsigned char)text[i + 1] : 0;
        if (first < 0x80 || (first >= 0xa1 && first <= 0xdf)) /* of one byte */
            continue;
        if (first == 0x80 || first == 0xa0 || first > 0xfc || second < 0x40 || second == 0x7f ||
            second > 0xfc)
            return false;
        sure += first >= 0xa0 ? 0 : second < 0x80 ? 1 : 2;
        i++;
    }
    return sure >= 2;
}

/* Each byte is a character, of at most 3 bytes. */
static size_t western(const char *text, size_t len, char *to) {
    static const unsigned short high[32] = {0x20ac, 0xfffd, 0x201a, 0x192,  0x201e, 0x2026, 0x2020, 0x2021,
                                            0x2c6,  0x2030, 0x160,  0x2039, 0x152,  0xfffd, 0x17d,  0xfffd,
                                            0xfffd, 0x2018, 0x2019, 0x201c, 0x201d, 0x2022, 0x2013, 0x2014,
                                            0x2dc,  0x2122, 0x161,  0x203a, 0x153,  0xfffd, 0x17e,  0x178};
    size_t n = 0;
    for (size_t i = 0; i < len; i++) {
        const unsigned c = (unsigned char)text[i];
        if (c < 0x80)
            to[n++] = text[i];
        else
            n += character_put(c < 0xa0 ? high[c - 0x80] : c, to + n);
    }
    return n;
}

/* 0: the system does not know it, or it is none. */
static size_t japanese(char *text, size_t len, char *to, size_t room) {
    const iconv_t by = iconv_open("UTF-8", "CP932");
    char *in = text, *out = to;
    size_t left = room;
    if (by == (iconv_t)-1)
        return 0;
    const bool ok = iconv(by, &in, &len, &out, &left) != (size_t)-1;
    iconv_close(by);
    return ok ? room - left : 0;
}

/* Signs of micro and degrees that were UTF-8 taken for Windows-1252, and written as UTF-8 again. */
static void unmangle(char *text, size_t *len) {
    size_t n = 0;
    for (size_t i = 0; i < *len; i++) {
        if (!strncmp(text + i, "\xc3\x82\xc2\xb5", 4) || !strncmp(text + i, "\xc3\x82\xc2\xb0", 4))
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
    const size_t room = 3 * *len;
    char *to = malloc(room + CHARACTER_BYTES);
    if (!to)
        return calc_no_memory(error);
    const bool by_pairs = is_japanese(*text, *len);
    *was = by_pairs ? "Shift-JIS" : NULL;
    *len = by_pairs ? japanese(*text, *len, to, room) : western(*text, *len, to);
    if (*len == 0) {
        free(to);
        return calc_fail(error, 0, 0, "%s is in Shift-JIS, which this system cannot read: save it as UTF-8",
                         path);
    }
    to[*len] = 0;
    free(*text);
    *text = to;
    return true;
}
