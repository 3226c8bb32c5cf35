/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The terminal: taken over, given back, and never left as it should not be. */
#ifndef LIVE_TERMINAL_H
#define LIVE_TERMINAL_H

#include <signal.h>
#include <stdbool.h>

#include "text/error.h"

/* Beyond the keys of curses. */
enum { KEY_NONE = -1, KEY_STOP = 0x10000 /* Ctrl-C */, KEY_AGAIN /* the screen must be drawn anew */ };

bool terminal_there(void);
/* unseen: a screen of the usual size that nobody sees. */
bool terminal_open(bool unseen, calc_error *error);
void terminal_close(void);
/* Sends what has been drawn; again: all of it. */
void terminal_show(bool again);
/* Milliseconds until the line has taken what was sent last: what is drawn before would only pile up. */
int terminal_busy(void);
/* Waits for a key or for the time to pass. */
int terminal_key(int milliseconds, volatile sig_atomic_t *stop);

#endif
