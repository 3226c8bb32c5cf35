/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What answers and changes want of the load of a scene beyond scene.h. */
#ifndef SCENE_LOAD_H
#define SCENE_LOAD_H

#include "scene/scene.h"

/* scene_load of a step that is no press. */
bool load_go_on(scene *s, const load_step *step, const cycle_extra *extra, calc_error *error);
/* The press at the beginning of the program. */
bool load_press(scene *s, const fret_normal *normal, fret_press *out, calc_error *error);
/* Can a swinging load be taken as it is? On no table of rows. */
bool load_takes_sine(const load_view *load);
/* The run that has come to the end of the program, or to now. */
bool load_run(scene *s, const runner **run, calc_error *error);

#endif
