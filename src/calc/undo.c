/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The way back of a session. A step needs no entry: taking it off the load program is enough, and programs of 1e6
 * steps cost nothing. */
#include <stdlib.h>
#include <string.h>

#include "calc/calc.h"

enum { UNDO_LEVELS = 1000 };

static void entry_end(undo_entry *e) {
    if (e->before)
        scene_drop(e->before);
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

/* The entry to fill, with the oldest gone where there are too many; NULL: out of memory, the past is forgotten. */
static undo_entry *push(calc *c) {
    undo *u = &c->undo;
    if (u->count == UNDO_LEVELS) {
        size_t gone = UNDO_LEVELS / 4;
        u->base_steps = u->entry[gone - 1].steps;
        for (size_t i = 0; i < gone; i++)
            entry_end(&u->entry[i]);
        u->count -= gone;
        memmove(u->entry, u->entry + gone, u->count * sizeof *u->entry);
    }
    if (u->count == u->room) {
        size_t room = u->room ? 2 * u->room : 8;
        undo_entry *grown = realloc(u->entry, room * sizeof *grown);
        if (!grown)
            return NULL;
        u->entry = grown;
        u->room = room;
    }
    undo_entry *e = &u->entry[u->count++];
    *e = (undo_entry){.group = u->group, .program = c->scene.program, .steps = c->scene.end.steps};
    return e;
}

void undo_scene(calc *c, scene_mark *m) {
    scene_mark *kept = malloc(sizeof *kept);
    undo_entry *e = kept ? push(c) : NULL;
    if (!e) {
        free(kept);
        scene_drop(m);
        return;
    }
    *kept = *m;
    e->before = kept;
}

bool undo_name(calc *c, size_t name) {
    undo_entry *e = push(c);
    if (!e)
        return false;
    e->name = name;
    e->old = c->names.row[name];
    counted_hold(e->old.definition);
    return true;
}

static void take_back(calc *c, undo_entry *e) {
    if (e->before) {
        scene_back(&c->scene, e->before);
        free(e->before);
        return;
    }
    own_name *row = &c->names.row[e->name];
    char *text = row->text;
    counted_drop(row->definition);
    *row = e->old;
    row->text = text;
    if (c->scene.in.bindings)
        scene_forget(&c->scene, false);
}

void undo_pop(calc *c, bool back) {
    undo_entry *e = &c->undo.entry[--c->undo.count];
    if (back)
        take_back(c, e);
    else
        entry_end(e);
}

bool calc_undo(calc *c) {
    undo *u = &c->undo;
    scene *s = &c->scene;
    const undo_entry *top = u->count ? &u->entry[u->count - 1] : NULL;
    const size_t base = top ? top->steps : u->base_steps;
    if (s->end.steps > base && (!top || top->program == s->program)) {
        s->end.steps--;
        scene_forget(s, true);
        return true;
    }
    if (!top)
        return false;
    const unsigned long group = top->group;
    while (u->count > 0 && u->entry[u->count - 1].group == group)
        take_back(c, &u->entry[--u->count]);
    return true;
}
