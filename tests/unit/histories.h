/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The parts of contacts, for tests that look within. */
#ifndef HISTORIES_H
#define HISTORIES_H

#include "field/field.h"
#include "history/contact.h"
#include "history/diagram.h"
#include "history/swing.h"

/* A contact that holds a memory, which it does not own. */
#define CONTACT_OF(m) (&(const fret_contact){.normal = (m)->normal, .mu = (m)->mu, .memory = (m)})

#endif
