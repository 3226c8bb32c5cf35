/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The two clocks, in seconds since no matter when. Asks the system and touches nothing. */
#ifndef TEXT_CLOCK_H
#define TEXT_CLOCK_H

/* By the wall, whatever becomes of the time of day. */
double clock_wall(void);
/* Of the processor, so that a busy machine does no harm. */
double clock_worked(void);

#endif
