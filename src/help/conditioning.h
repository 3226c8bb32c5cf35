/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far the last digit of each input moves a value, on a page of `explain`. */
#ifndef HELP_CONDITIONING_H
#define HELP_CONDITIONING_H

#include "statement/answer.h"
#include "study/influence.h"

/* name: what is moved. */
void conditioning_tell(answer *out, const char *name, const influence_study *study);

#endif
