/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Searches expressions and the definitions that they lead to. Evaluates nothing. */
#include <stdio.h>
#include <string.h>

#include "language/tree.h"

size_t chain_step(char *chain, size_t size, const char *name, const char *text) {
    static const char dots[] = "... -> ";
    if (size < sizeof dots)
        return 0;
    const int used = snprintf(chain, size, text ? "%s := %.80s -> " : "%s -> ", name, text);
    if (used >= 0 && (size_t)used + sizeof dots <= size)
        return (size_t)used;
    memcpy(chain, dots, sizeof dots);
    return size;
}

/* chain: NULL, or receives the chain of definitions to the name, as "b -> c -> ". Each definition is searched
 * once, and none deeper than CHAIN. */
static bool mentions(const calc *c, const expr *e, const quantity *q, const char *name, char *chain,
                     size_t size, int deep) {
    for (size_t i = 0; i < e->count; i++) {
        const expr_node *n = &e->nodes[i];
        if (q && (n->kind == N_QUANTITY || n->kind == N_CALL) && n->q == q)
            return true;
        const bool holds = n->kind == N_AT || n->kind == N_OVER;
        if (holds && mentions(c, &n->changed->body, q, name, chain, size, deep))
            return true;
        for (size_t j = 0; holds && j < n->changed->count; j++)
            if (mentions(c, &n->changed->change[j].value, q, name, chain, size, deep))
                return true;
        if (n->kind != N_NAME && n->kind != N_APPLY)
            continue;
        own_name *row = &c->names.row[n->index];
        const definition *d = (const definition *)row->definition;
        if (name && !strcmp(row->text, name))
            return true;
        if (row->seen || !d || deep > CHAIN)
            continue;
        row->seen = true;
        const size_t step = chain_step(chain, size, row->text, NULL);
        if (mentions(c, &d->body, q, name, chain ? chain + step : NULL, size - step, deep + 1))
            return true;
        if (step)
            chain[0] = 0;
    }
    return false;
}

static bool search(const calc *c, const expr *e, const quantity *q, const char *name, char *chain,
                   size_t size) {
    for (size_t i = 0; i < c->names.count; i++)
        c->names.row[i].seen = false;
    return mentions(c, e, q, name, chain, size, 0);
}

bool expr_chain(const calc *c, const expr *e, const char *name, char *chain, size_t size) {
    chain[0] = 0;
    return search(c, e, NULL, name, chain, size);
}

bool expr_mentions(const calc *c, const expr *e, const quantity *q, const char *name) {
    return search(c, e, q, name, NULL, 0);
}

bool bindings_mention(const calc *c, const inputs *in, const char *name) {
    bool found = false;
    for (input i = 0; i < INPUTS && !found; i++)
        found = in->bound[i] && expr_mentions(c, &((const definition *)in->bound[i])->body, NULL, name);
    return found;
}

const quantity *expr_quantity(const expr *e, size_t i, bool *call, size_t *at) {
    for (size_t j = 0; j < e->count; j++) {
        const expr_node *n = &e->nodes[j];
        if (n->kind != N_QUANTITY && n->kind != N_CALL)
            continue;
        bool again = false;
        for (size_t k = 0; k < j && n->kind == N_QUANTITY; k++)
            again = again || (e->nodes[k].q == n->q && e->nodes[k].kind == n->kind);
        if (!again && i-- == 0) {
            *call = n->kind == N_CALL;
            *at = n->at;
            return n->q;
        }
    }
    return NULL;
}

const char *expr_unit(const expr *e) {
    const expr_node *root = &e->nodes[e->count - 1];
    if (root->kind == N_AT)
        return expr_unit(&root->changed->body);
    return root->kind == N_QUANTITY || root->kind == N_CALL ? root->q->unit : NULL;
}

const definition *expr_definition(const calc *c, const expr *e, size_t i) {
    for (size_t j = 0; j < e->count; j++) {
        const expr_node *n = &e->nodes[j];
        const bool own = n->kind == N_NAME || n->kind == N_APPLY;
        const definition *d = own ? (const definition *)c->names.row[n->index].definition : NULL;
        if (d && i-- == 0)
            return d;
    }
    return NULL;
}

const expr *expr_meant(const calc *c, const expr *e) {
    const definition *d;
    while (e->count == 1 && (d = expr_definition(c, e, 0)))
        e = &d->body;
    return e;
}
