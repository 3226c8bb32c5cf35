/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Undo. A step needs no entry, since undo shortens the load program: 1e6 steps cost nothing. Uses `scene`. */
#include <stdlib.h>
#include <string.h>

#include "number/array.h"

#include "language/calc.h"

enum { UNDO_LEVELS = 1000 }; /* at least kept */

static void entry_end(undo_entry *e) {
    if (e->before)
        scene_keep(e->before);
    else
        counted_drop(e->old.definition);
    free(e->before);
}

void undo_begin(calc *c) {
    undo *u = &c->undo;
    u->group++;
    if (u->nesting++ == 0)
        u->outermost = u->group;
}

void undo_end(calc *c) {
    undo *u = &c->undo;
    if (--u->nesting > 0)
        return;
    for (size_t i = u->count; i > 0 && u->entry[i - 1].group > u->outermost; i--)
        u->entry[i - 1].group = u->outermost;
}

/* Reserves one more entry besides those promised. */
static bool reserve(undo *u) {
    return fret_array_room(&u->entry, &u->room, u->count + u->promised + 1, sizeof *u->entry);
}

/* Appends a reserved entry; drops the oldest ones at the limit. */
static undo_entry *push(calc *c) {
    undo *u = &c->undo;
    if (u->count == 2 * UNDO_LEVELS) { /* rare, so moving the rest is cheap */
        const size_t gone = UNDO_LEVELS;
        u->base_steps = u->entry[gone - 1].steps;
        for (size_t i = 0; i < gone; i++)
            entry_end(&u->entry[i]);
        u->count -= gone;
        memmove(u->entry, u->entry + gone, u->count * sizeof *u->entry);
    }
    undo_entry *e = &u->entry[u->count++];
    *e = (undo_entry){.group = u->group, .steps = c->scene.end.steps};
    return e;
}

scene_mark *undo_mark(calc *c) {
    scene_mark *m = malloc(sizeof *m);
    if (!m || !reserve(&c->undo)) {
        free(m);
        return NULL;
    }
    c->undo.promised++;
    scene_save(&c->scene, m, false);
    return m;
}

void undo_scene(calc *c, scene_mark *m) {
    c->undo.promised--;
    push(c)->before = m;
}

void undo_unmark(calc *c, scene_mark *m) {
    const scene *s = &c->scene;
    c->undo.promised--;
    if (s->program == m->program && s->end.steps == m->end.steps &&
        inputs_same(&s->in, &m->in, ~(input_set)0))
        scene_keep(m); /* results are still valid */
    else
        scene_restore(&c->scene, m);
    free(m);
}

bool undo_name(calc *c, size_t name) {
    if (!reserve(&c->undo))
        return false;
    undo_entry *e = push(c);
    e->name = name;
    e->old = c->names.row[name];
    counted_hold(e->old.definition);
    return true;
}

static void take_back(calc *c, undo_entry *e) {
    if (e->before) {
        scene_restore(&c->scene, e->before);
        free(e->before);
        return;
    }
    names_restore(&c->names, e->name, &e->old);
    if (c->scene.in.bindings)
        scene_forget(&c->scene);
}

void undo_pop(calc *c, bool back) {
    undo_entry *e = &c->undo.entry[--c->undo.count];
    if (back)
        take_back(c, e);
    else
        entry_end(e);
}

void undo_since(calc *c, unsigned long group) {
    while (c->undo.count > 0 && c->undo.entry[c->undo.count - 1].group > group)
        undo_pop(c, true);
}

bool calc_undo(calc *c) {
    undo *u = &c->undo;
    scene *s = &c->scene;
    const size_t steps = u->count ? u->entry[u->count - 1].steps : u->base_steps;
    if (s->end.steps > steps) {
        s->end.steps--;
        scene_forget(s);
        return true;
    }
    if (!u->count)
        return false;
    const unsigned long group = u->entry[u->count - 1].group;
    while (u->count > 0 && u->entry[u->count - 1].group == group)
        take_back(c, &u->entry[--u->count]);
    return true;
}
