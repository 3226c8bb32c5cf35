/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The long texts of help, each the text of the topic of its name. */
#ifndef HELP_TEXTS_H
#define HELP_TEXTS_H

extern const char expressions_text[], scripts_text[], prompt_text[], files_text[], lessons_text[],
    theory_text[], limits_text[], exactness_text[], cracking_text[], damper_text[], parts_text[],
    programs_text[], news_text[];

#endif
