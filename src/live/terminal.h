/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The terminal as a curses screen: opened, drawn on, read, and restored however the program ends. */
#ifndef LIVE_TERMINAL_H
#define LIVE_TERMINAL_H

#include <signal.h>
#include <stdbool.h>

#include "text/error.h"

/* Keys besides those of curses. KEY_STOP: Ctrl-C, or the terminal is gone; KEY_AGAIN: redraw the screen. */
enum { KEY_NONE = -1, KEY_STOP = 0x10000, KEY_AGAIN };

/* unseen: draws on /dev/null, for a script played without a terminal. False with the error. */
bool terminal_open(bool unseen, calc_error *error);
void terminal_close(void);
/* Sends what has changed on the screen; again: the whole screen. */
void terminal_show(bool again);
/* Milliseconds until a slow line has sent the last update: drawing before that would only queue up. */
int terminal_busy(void);
/* Returns the next key, KEY_NONE if none comes within `milliseconds`, or KEY_STOP, which clears *stop. */
int terminal_key(int milliseconds, volatile sig_atomic_t *stop);

#endif
