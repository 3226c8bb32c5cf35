/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two clocks, in seconds from an arbitrary origin: use differences only. Depends on libc alone. */
#ifndef TEXT_CLOCK_H
#define TEXT_CLOCK_H

/* Elapsed time; setting the system's time of day does not change it. */
double clock_wall(void);
/* Processor time of this process: the load of the machine does not count. */
double clock_worked(void);

#endif
