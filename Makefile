# SPDX-License-Identifier: GPL-3.0-or-later
# make run: install what is missing, build, play a demo.   make check: install, build, test.   tests/README.md has more.
VERSION := $(shell awk '/define FRET_VERSION_/ { v = v d $$3; d = "." } END { print v }' include/fret/fret.h)
PREFIX  ?= /usr/local
LIBDIR  ?= $(PREFIX)/lib
B       ?= build
DARWIN  := $(filter Darwin,$(shell uname))
# on macOS ld -r makes hidden symbols local by itself
OBJCOPY ?= $(if $(DARWIN),:,objcopy)
CC      ?= cc
# -fno-tree-slp-vectorize: that optimisation packs pairs of doubles through memory, and double-double arithmetic is a tenth
# slower. -fno-math-errno: no code reads the errno of libm, and without it a square root is one instruction.
OPT     ?= -O2 -g -fno-tree-slp-vectorize -fno-math-errno
WARN    := -Wall -Wextra -Wpedantic -Wshadow -Wconversion $(WERROR)
CFLAGS_ALL := -std=c11 -D_POSIX_C_SOURCE=200809L -D_DEFAULT_SOURCE -D_DARWIN_C_SOURCE -DGSL_DISABLE_DEPRECATED $(OPT) $(WARN) -ffp-contract=off \
	-fvisibility=hidden -MMD -MP \
	-Iinclude -Isrc -DFRET_VERSION='"$(VERSION)"' $(CFLAGS)
# READLINE=no: a prompt without editing and history
READLINE  ?= yes
# GSL=no: without the commands maximize, minimize, fit and uncertainty, and without smooth
GSL       ?= yes
# LIVE=no: no full-screen mode
LIVE      ?= yes
CURSES    := $(shell pkg-config --libs ncursesw 2>/dev/null || echo -lncursesw -ltinfo)
LIBS_CORE := -lm
LIBS_GSL  := $(if $(filter no,$(GSL)),,-lgsl -lgslcblas) $(if $(DARWIN),-liconv) # elsewhere in libc
LIBS      := $(LIBS_GSL) $(LIBS_CORE) $(if $(filter no,$(READLINE)),,-lreadline) $(if $(filter no,$(LIVE)),,$(CURSES))

# sources that are left out: those that need GSL, with GSL=no; what stands in for them, otherwise
BACK  := $(if $(filter no,$(GSL)),$(addprefix src/study/,$(addsuffix .c,optimise fit residuals determined uncertainty smooth)) \
	src/measured/branches.c src/commands/fit_command.c,src/commands/study_none.c)
CORE  := $(wildcard src/number/*.c src/law/*.c src/history/*.c src/field/*.c src/wear/*.c src/arrays/*.c)
ABOVE := text measured scene language study plot statement commands help prompt
PROG  := $(filter-out src/prompt/prompt_$(if $(filter no,$(READLINE)),readline,plain).c $(BACK), \
	$(wildcard $(ABOVE:%=src/%/*.c))) \
	$(if $(filter no,$(LIVE)),src/live/none.c,$(filter-out src/live/none.c,$(wildcard src/live/*.c)))
# for scripts.c: scripts/demos and scripts/paper for `demo`, scripts/help for `help`
PAPER   := $(wildcard scripts/paper/*.txt)
SCRIPTS := $(wildcard scripts/demos/*.txt) $(PAPER)
TOPICS  := $(wildcard scripts/help/*.txt)
UNIT  := $(wildcard tests/unit/test_*.c)
HARD  := $(wildcard tests/hard/*.c)
# only the oracle of tests/hard needs MPFR
MPFR  := $(wildcard /usr/include/mpfr.h /usr/local/include/mpfr.h)
OBJ    = $(patsubst %.c,$(B)/%.o,$(1))
SHARED = $(patsubst %.c,$(B)/shared/%.o,$(1))
# the first number of the version: it changes when programs must be linked anew
SONAME := libfret.so.$(firstword $(subst ., ,$(VERSION)))
TESTS := $(patsubst tests/unit/%.c,$(B)/tests/%,$(UNIT))

COMMA := ,

all: $(B)/fret $(B)/libfret.a $(B)/libfret.so $(B)/fret.pc

# Makes the functions that the public headers declare visible; the rest is hidden (-fvisibility=hidden).
$(B)/exported.h:
	@mkdir -p $(@D)
	@printf '#pragma GCC visibility push(default)\n#include "fret/fret.h"\n#pragma GCC visibility pop\n' > $@

$(call OBJ,$(CORE)) $(call SHARED,$(CORE)): CFLAGS_ALL += -include $(B)/exported.h
$(call OBJ,$(CORE)) $(call SHARED,$(CORE)): | $(B)/exported.h

$(B)/%.o: %.c
	@mkdir -p $(@D)
	$(CC) $(CFLAGS_ALL) -c $< -o $@

$(B)/shared/%.o: %.c
	@mkdir -p $(@D)
	$(CC) $(CFLAGS_ALL) -fPIC -c $< -o $@

# One object, in which the hidden functions have become local.
$(B)/libfret.a: $(call OBJ,$(CORE))
	$(LD) -r -o $(B)/libfret.o $^
	$(OBJCOPY) --localize-hidden $(B)/libfret.o
	@rm -f $@
	$(AR) rcs $@ $(B)/libfret.o

$(B)/libfret.so: $(call SHARED,$(CORE))
	$(CC) $(CFLAGS_ALL) $(LDFLAGS) -shared $(if $(DARWIN),-Wl$(COMMA)-install_name$(COMMA)$(LIBDIR)/$(SONAME),-Wl$(COMMA)-soname$(COMMA)$(SONAME)) -o $@ $^ $(LIBS_CORE)

$(B)/scripts.c: scripts/embed $(SCRIPTS) $(TOPICS)
	@mkdir -p $(@D)
	@{ echo '#include "statement/scripts.h"'; sh scripts/embed scripts $(SCRIPTS) && sh scripts/embed topics $(TOPICS); } > $@.part && mv $@.part $@

$(B)/scripts.o: $(B)/scripts.c
	$(CC) $(CFLAGS_ALL) -c $< -o $@

$(B)/fret: $(call OBJ,$(PROG) $(CORE)) $(B)/scripts.o
	$(CC) $(CFLAGS_ALL) $(LDFLAGS) -o $@ $^ $(LIBS)

# Every figure and video of the paper, and the pictures in README.md.
FIGURES := $(patsubst scripts/paper/%.txt,$(B)/figures/%.png,$(filter-out scripts/paper/s%,$(PAPER))) \
	$(patsubst scripts/paper/%.txt,$(B)/figures/%.gif,$(filter scripts/paper/s%,$(PAPER)))
STILLS  := $(patsubst %.keys,%.svg,$(wildcard scripts/paper/*.keys))
figures: $(FIGURES) scripts/paper/fig07a.svg scripts/paper/fig07b.svg $(STILLS)
DRAW = sed '$$s|$$| to $@|' $< | $(B)/fret
$(B)/figures/%.png $(B)/figures/%.gif: scripts/paper/%.txt $(B)/fret
	@mkdir -p $(@D)
	@$(DRAW)
scripts/paper/%.svg: scripts/paper/%.txt $(B)/fret
	@$(DRAW)

# An HTML page of each lesson, to print.
HANDOUTS := $(foreach n,$(notdir $(basename $(wildcard scripts/demos/*.txt))),$(B)/handouts/$(n).html)
handouts: $(HANDOUTS)
$(HANDOUTS): $(B)/handouts/%.html: scripts/demos/%.txt $(B)/fret
	@mkdir -p $(@D)
	@$(B)/fret -c 'demo $(lastword $(subst -, ,$*)) to $@'

# Pictures of a terminal after the lines of a .keys file have been typed.
$(STILLS): %.svg: %.keys scripts/still $(B)/fret
	@python3 scripts/still $@ 80x32 $(B)/fret --no-rc --quiet < $<

# written anew each time: PREFIX may have changed
$(B)/fret.pc: FORCE
	@mkdir -p $(@D)
	@printf 'prefix=%s\nlibdir=%s\nName: fret\nDescription: partial-slip contact of power-law graded elastic solids\nVersion: %s\nCflags: -I$${prefix}/include\nLibs: -L$${libdir} -lfret\nLibs.private: %s\n' \
		'$(PREFIX)' '$(LIBDIR)' '$(VERSION)' '$(LIBS_CORE)' > $@

# Unit tests call hidden functions too, so they are linked with the objects, not with the library. OUTER: those above it.
OUTER := $(call OBJ,$(filter-out $(BACK),$(wildcard $(patsubst %,src/%/*.c,text measured scene language study plot))))
$(B)/tests/%: $(B)/tests/unit/%.o $(call OBJ,$(CORE)) $(OUTER)
	$(CC) $(CFLAGS_ALL) $(LDFLAGS) $(WRAP) -o $@ $(filter %.o,$^) $(LIBS_GSL) $(LIBS_CORE)
# tests of the table of commands need all of the program
$(B)/tests/test_grammar $(B)/tests/test_output $(B)/tests/test_reader: LIBS_GSL := $(LIBS)
$(B)/tests/test_grammar $(B)/tests/test_output $(B)/tests/test_reader: $(call OBJ,$(filter-out src/prompt/main.c,$(PROG))) $(B)/scripts.o
# the tests replace these functions, to let them fail or to count them
$(B)/tests/test_allocation $(B)/tests/test_answers $(B)/tests/test_calc $(B)/tests/test_wear: WRAP = $(addprefix -Wl$(COMMA)--wrap=,malloc calloc realloc aligned_alloc)
$(B)/tests/test_threads: WRAP += -pthread
$(B)/tests/test_gnuplot: WRAP = -Wl,--wrap=waitpid
$(B)/tests/test_moments: WRAP = $(addprefix -Wl$(COMMA)--wrap=,expl logl fret_pow fret_table_distance fret_gap_profile)
$(B)/tests/test_file: WRAP = $(addprefix -Wl$(COMMA)--wrap=,malloc realloc strdup getpwuid open fdopen fcntl stat fstat ftruncate)

# A static program to copy to another machine: with musl, where it is installed.
STATIC_CC = $(if $(filter default,$(origin CC)),$(shell command -v musl-gcc || echo $(CC)),$(CC))
static:
	@$(MAKE) --no-print-directory B=$(B)/static CC='$(STATIC_CC)' READLINE=no GSL=no LIVE=no LDFLAGS='-static -s $(LDFLAGS)' $(B)/static/fret

$(B)/tests/hard/hard: $(call OBJ,$(HARD) $(CORE))
	$(CC) $(CFLAGS_ALL) $(LDFLAGS) -o $@ $^ -lmpfr -lgmp $(LIBS_CORE)

# Preloaded (LD_PRELOAD): makes allocations fail. It needs glibc, and a program without sanitizer.
$(B)/tests/faults.so: tests/fuzz/faults.c
	@mkdir -p $(@D)
	$(CC) -O1 -g $(WARN) -fPIC -shared -o $@ $<

# Runs a program and makes its system calls fail, on Linux.
SECCOMP := $(wildcard /usr/include/linux/seccomp.h)
$(B)/tests/calls: tests/fuzz/calls.c
	@mkdir -p $(@D)
	$(CC) -O1 -g $(WARN) -o $@ $<

tests: $(B)/tests/faults.so $(if $(SECCOMP),$(B)/tests/calls) $(TESTS) $(if $(MPFR),$(B)/tests/hard/hard)

deps:
	@sh scripts/install-deps run
deps-check:
	@sh scripts/install-deps check

run: deps
	@$(MAKE) --no-print-directory -s all
	@$(B)/fret -c demo
	@echo
	@echo 'Now type  $(B)/fret  for a prompt of your own, and  help  there; Ctrl-D leaves.'

# ROOMS: run only these rooms of tests
check: deps-check
	@sh tests/run $(ROOMS)

check-all: check
	@sh tests/run --rest $(ROOMS)

# Random scenes and histories against an oracle: minutes to an hour. The table of worst errors is kept in git.
HARD_SCENES ?= 10000000
HARD_STEPS  ?= 100000000
hard: deps-check
	@$(MAKE) --no-print-directory -s $(B)/tests/hard/hard
	@{ echo '# make hard HARD_SCENES=$(HARD_SCENES) HARD_STEPS=$(HARD_STEPS)'; \
	  nice $(B)/tests/hard/hard --scenes $(HARD_SCENES) --steps $(HARD_STEPS) --jobs $$(nproc); } > $(B)/worst.txt; \
	  status=$$?; mv $(B)/worst.txt tests/hard/worst.txt; tail -n 1 tests/hard/worst.txt; exit $$status

# The memory diagram in double against the exact one: minutes. The table is kept in git.
hard-diagram: deps-check
	@$(MAKE) --no-print-directory -s $(B)/tests/hard/hard
	@{ echo '# make hard-diagram HARD_STEPS=$(HARD_STEPS)'; nice $(B)/tests/hard/hard --diagrams $(HARD_STEPS); } > $(B)/diagram.txt; \
	  status=$$?; mv $(B)/diagram.txt tests/hard/diagram.txt; tail -n 1 tests/hard/diagram.txt; exit $$status

# Are the standard errors of fit right? FITS loops with noise of each kind. The table is kept in git.
FITS ?= 200
fits: deps-check
	@$(MAKE) --no-print-directory -s $(B)/fret
	@nice python3 tests/hard/fits.py $(B)/fret $(FITS) > $(B)/fits.txt; status=$$?; \
	  mv $(B)/fits.txt tests/hard/fits.txt; tail -n 1 tests/hard/fits.txt; exit $$status

# Makes every allocation and system call of every kind of statement fail once. The table is kept in git.
faults: deps-check
	@$(MAKE) --no-print-directory -s $(B)/fret $(B)/tests/faults.so $(B)/tests/calls
	@$(MAKE) --no-print-directory -s B=build/leaks OPT='-O1 -g -fsanitize=leak' build/leaks/fret
	@mkdir -p build/leaks/tests && $(CC) -DLEAKS -O1 -g -fPIC -shared -o build/leaks/tests/faults.so tests/fuzz/faults.c
	@(python3 tests/fuzz/faults.py $(B)/fret $(B)/tests; status=$$?; \
	  python3 tests/fuzz/faults.py --leaks build/leaks/fret build/leaks/tests && exit $$status) > $(B)/faults.txt; \
	  status=$$?; mv $(B)/faults.txt tests/hard/faults.txt; tail -n 3 tests/hard/faults.txt; exit $$status

# Lines and branches that the tests reach; coverage-short: that `make check` reaches.
coverage coverage-short: deps-check
	@PYTHONDONTWRITEBYTECODE=1 nice python3 tests/coverage.py $(if $(findstring short,$@),--short) $(ROOMS)

# Changes MUTANTS tokens of the sources, one at a time, and lists the changes that no test notices. Hours.
MUTANTS ?= 300
SEED    ?= 1
mutants: deps-check
	@PYTHONDONTWRITEBYTECODE=1 nice -n 19 python3 tests/fuzz/mutants.py --count $(MUTANTS) --seed $(SEED)

# The build with sanitizers for the tests; with clang also with libFuzzer's counters, which cost little. SANITIZED: targets.
sanitized:
	@$(MAKE) --no-print-directory -s B=build/asan OPT='-O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all \
		$(if $(findstring clang,$(CC)),-fsanitize-coverage=inline-8bit-counters$(COMMA)pc-table)' $(or $(SANITIZED),build/asan/fret tests)

# Needs clang. FUZZ: seconds for each target; figures in tests/hard/fuzz.txt, new inputs in build/fuzz/corpus.
# The fuzz target replaces the FUZZ_CALLS of the program.
FUZZ      ?= 450
FUZZ_CALLS := open fopen posix_spawnp system popen fork mkdtemp
fuzz-build:
	@$(MAKE) --no-print-directory -s CC=clang SANITIZED=build/asan/fuzz sanitized
$(B)/program.o: $(call OBJ,$(filter-out src/prompt/main.c,$(PROG)) $(CORE)) $(B)/scripts.o
	ld -r -o $@ $^
	objcopy $(foreach call,$(FUZZ_CALLS),--redefine-sym $(call)=fuzz_$(call)) $@
$(B)/fuzz: tests/fuzz/fuzz.c $(B)/program.o
	$(CC) $(CFLAGS_ALL) $(LDFLAGS) -fsanitize=fuzzer -o $@ $(filter %.c %.o,$^) $(LIBS)
fuzz: deps-check
	@$(MAKE) --no-print-directory -s fuzz-build $(B)/fret
	@PYTHONDONTWRITEBYTECODE=1 python3 tests/fuzz/fuzzing.py build/asan/fuzz $(FUZZ)
	@PYTHONDONTWRITEBYTECODE=1 python3 tests/fuzz/programs.py $(B)/fret $(FUZZ) $$(date +%s)
	@PYTHONDONTWRITEBYTECODE=1 python3 tests/fuzz/typed.py $(B)/fret $(FUZZ) $$(date +%s)

# Measures how long Ctrl-C takes. The table is kept in git.
INTERRUPTS ?= 25
LONGEST    ?= 5
latency: deps-check
	@$(MAKE) --no-print-directory -s $(B)/fret
	@INTERRUPTS=$(INTERRUPTS) LONGEST=$(LONGEST) python3 tests/interactive/latency.py $(B)/fret > $(B)/latency.txt
	@mv $(B)/latency.txt tests/hard/latency.txt; cat tests/hard/latency.txt

# Times and memory, each as a ratio to a baseline of the same run; asserts nothing.
bench: all
	@sh scripts/bench $(B)

# Compares numbers with those published by others.
published: $(B)/fret
	@FRET=$(B)/fret sh scripts/published

# Needs clang-format.
format:
	clang-format -i $(shell git ls-files '*.c' '*.h')

# Man pages, bash completion and NEWS, made from the program's help and the public headers.
manual: $(B)/fret
	@mkdir -p $(B)/manual
	@for page in 1 5 bash; do sh scripts/manual $$page $(B)/fret > $(B)/manual/fret.$$page || exit 1; done
	@sh scripts/manual 3 $(B)/fret $(HEADERS) > $(B)/manual/libfret.3
	@$(B)/fret -c 'help news' > $(B)/manual/NEWS

HEADERS := $(sort $(wildcard include/fret/*.h))
SHARE    = $(DESTDIR)$(PREFIX)/share
install: all manual
	install -d $(DESTDIR)$(PREFIX)/bin $(DESTDIR)$(LIBDIR)/pkgconfig $(DESTDIR)$(PREFIX)/include/fret \
		$(SHARE)/man/man1 $(SHARE)/man/man3 $(SHARE)/man/man5 $(SHARE)/bash-completion/completions $(SHARE)/doc/fret
	install -m 755 $(B)/fret $(DESTDIR)$(PREFIX)/bin/
	install -m 644 $(B)/libfret.a $(DESTDIR)$(LIBDIR)/
	install -m 755 $(B)/libfret.so $(DESTDIR)$(LIBDIR)/libfret.so.$(VERSION)
	ln -sf libfret.so.$(VERSION) $(DESTDIR)$(LIBDIR)/$(SONAME)
	ln -sf $(SONAME) $(DESTDIR)$(LIBDIR)/libfret.so
	install -m 644 $(B)/fret.pc $(DESTDIR)$(LIBDIR)/pkgconfig/
	install -m 644 $(HEADERS) $(DESTDIR)$(PREFIX)/include/fret/
	for n in 1 5; do install -m 644 $(B)/manual/fret.$$n $(SHARE)/man/man$$n/; done
	install -m 644 $(B)/manual/libfret.3 $(SHARE)/man/man3/
	install -m 644 $(B)/manual/fret.bash $(SHARE)/bash-completion/completions/fret
	install -m 644 $(B)/manual/NEWS $(SHARE)/doc/fret/

# Removes what install has installed, and fret's own directories.
uninstall:
	rm -f $(DESTDIR)$(PREFIX)/bin/fret $(DESTDIR)$(LIBDIR)/libfret.a $(DESTDIR)$(LIBDIR)/libfret.so \
		$(DESTDIR)$(LIBDIR)/$(SONAME) $(DESTDIR)$(LIBDIR)/libfret.so.$(VERSION) $(DESTDIR)$(LIBDIR)/pkgconfig/fret.pc \
		$(SHARE)/man/man1/fret.1 $(SHARE)/man/man5/fret.5 $(SHARE)/man/man3/libfret.3 \
		$(SHARE)/bash-completion/completions/fret $(SHARE)/doc/fret/NEWS $(addprefix $(DESTDIR)$(PREFIX)/,$(HEADERS))
	for d in $(DESTDIR)$(PREFIX)/include/fret $(SHARE)/doc/fret; do if [ -d $$d ]; then rmdir $$d; fi; done

# make run, make check, make deb and a build by every compiler, in clean Debian systems. Needs root and debootstrap; an hour.
CHROOTS ?= $(B)/chroots
chroots:
	@sh scripts/chroots $(CHROOTS)

# Debian packages, in build/deb.
deb:
	@sh scripts/deb $(VERSION)

FORCE:

# keeps the objects of tests, which make would delete as intermediate files
.SECONDARY:

clean:
	rm -rf build

.PHONY: published coverage coverage-short mutants fuzz fuzz-build sanitized all figures handouts manual uninstall deb static chroots tests deps deps-check run check check-all hard hard-diagram fits faults latency bench format install clean FORCE
-include $(shell find $(B) -name chroots -prune -o -name '*.d' -print 2>/dev/null)
