/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Storage of load programs. Touches only the program and, where a comment says so, the inputs. */
#include "scene/program.h"

#include <stdlib.h>

#include "number/array.h"

static void free_program(counted *self) {
    program *p = (program *)self;
    free(p->steps);
    free(p->cycles);
    free(p);
}

program *program_make(void) {
    program *p = calloc(1, sizeof *p);
    if (p)
        p->base = (counted){1, free_program};
    return p;
}

bool program_append(program *p, load_mark *mark, const load_step *step, const cycle_extra *extra) {
    if (!fret_array_room(&p->steps, &p->room, mark->steps + 1, sizeof *p->steps))
        return false;
    if (extra) {
        if (!fret_array_room(&p->cycles, &p->cycle_room, mark->cycles + 1, sizeof *p->cycles))
            return false;
        p->cycles[mark->cycles++] = *extra;
    }
    p->steps[mark->steps++] = *step;
    return true;
}

program *program_copy(const program *from, load_mark mark) {
    program *p = program_make();
    load_mark at = {0, 0};
    for (size_t i = 0; p && i < mark.steps; i++) {
        const cycle_extra *extra = from->steps[i].kind == LOAD_CYCLE ? &from->cycles[at.cycles] : NULL;
        if (!program_append(p, &at, &from->steps[i], extra)) {
            counted_drop(p);
            p = NULL;
        }
    }
    return p;
}

size_t program_last_cycle(const program *p, load_mark mark) {
    size_t i = mark.cycles ? mark.steps : 0;
    while (i > 0 && p->steps[i - 1].kind != LOAD_CYCLE)
        i--;
    return i ? i - 1 : NO_CYCLE;
}

/* The ways to press, one row each. */
static const struct {
    input in;
    fret_status (*press)(const fret_normal *, double, fret_press *);
} presses[] = {[BY_FORCE] = {IN_FN, fret_press_by_force},
               [BY_DISPLACEMENT] = {IN_DZ, fret_press_by_depth},
               [BY_RADIUS] = {IN_CONTACT, fret_press_by_radius},
               [BY_PEAK] = {IN_P0, fret_press_by_peak},
               [BY_MEAN] = {IN_PMEAN, fret_press_by_mean}};

input press_input(load_by by) {
    return presses[by].in;
}

input cycle_input(load_by by) {
    return by == BY_FORCE ? IN_FA : by == BY_RIG ? IN_DRIGA : IN_DXA;
}

load_by cycle_by(const inputs *in) {
    return in->set[IN_FA] ? BY_FORCE : in->set[IN_DRIGA] ? BY_RIG : BY_DISPLACEMENT;
}

load_by press_by(input in) {
    load_by by = BY_MEAN;
    while (by > BY_NONE && presses[by].in != in)
        by--;
    return by;
}

fret_status press_to(const fret_normal *normal, load_by by, double value, fret_press *out) {
    return presses[by].press(normal, value, out);
}

load_item program_item(const program *p, load_mark here, size_t last_cycle, const inputs *in) {
    load_item item = {.step = p->steps[here.steps]};
    load_step *step = &item.step;
    if (step->kind == LOAD_CYCLE)
        item.extra = p->cycles[here.cycles];
    if (step->kind == LOAD_PRESS) {
        step->normal_value = in->v[press_input((load_by)step->normal)];
    } else if (here.steps == last_cycle) {
        step->tangential = (unsigned char)cycle_by(in);
        step->tangential_value = in->v[cycle_input(cycle_by(in))];
        step->normal_value = in->v[IN_FNA];
        item.extra.phase = in->v[IN_PHASE];
    }
    return item;
}

void program_to_inputs(const load_step *step, const cycle_extra *extra, inputs *in) {
    if (step->kind == LOAD_PRESS) {
        inputs_unset(in, INPUT_CYCLE | INPUT_PRESS);
        inputs_put(in, press_input((load_by)step->normal), step->normal_value);
    } else if (step->kind == LOAD_CYCLE) {
        inputs_unset(in, INPUT_CYCLE);
        inputs_put(in, cycle_input((load_by)step->tangential), step->tangential_value);
        inputs_put(in, IN_FNA, step->normal_value);
        inputs_put(in, IN_PHASE, extra->phase);
    }
}

void program_freeze(program *p, size_t last_cycle, size_t cycle, const inputs *in) {
    load_item item = program_item(p, (load_mark){last_cycle, cycle}, last_cycle, in);
    p->steps[last_cycle] = item.step;
    p->cycles[cycle] = item.extra;
}
