/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The part of an `explain` page that says how far a change in the last digit of each input moves a value. */
#ifndef HELP_CONDITIONING_H
#define HELP_CONDITIONING_H

#include "statement/answer.h"
#include "study/influence.h"

/* Writes the result of `study` for the value called `name`. */
void conditioning_tell(answer *out, const char *name, const influence_study *study);

#endif
