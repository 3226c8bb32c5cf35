# SPDX-License-Identifier: GPL-3.0-or-later
"""A terminal emulator for tests: keeps the output of a program as rows of characters. Knows what curses sends to an xterm or a vt100."""
import re

CSI = re.compile(r"\x1b\[([?>]?)([0-9;]*)([@A-Za-z`])")


class Screen:
    def __init__(self, rows, cols):
        self.resize(rows, cols)
        self.pending = self.modes_text = ""
        self.cleared = 0  # how often
        self.modes = {}
        self.main = None  # the main screen while the alternate one is shown, and its cursor

    def resize(self, rows, cols):
        self.rows, self.cols = rows, cols
        self.cells = [[" "] * cols for _ in range(rows)]
        self.y = self.x = 0
        self.top, self.bottom = 0, rows - 1
        self.last = " "

    def text(self):
        return "\n".join("".join(row).rstrip() for row in self.cells)

    def row(self, i):
        return "".join(self.cells[i]).rstrip()

    def feed(self, text):
        text = self.pending + text
        self.pending = ""
        i = 0
        while i < len(text):
            c = text[i]
            if c != "\x1b":
                self.plain(c)
                i += 1
                continue
            found = CSI.match(text, i)
            if found:
                self.control(*found.groups())
                i = found.end()
            elif re.match(r"\x1b[()].", text[i:], re.S):
                i += 3
            elif re.match(r"\x1b\][^\x07]*\x07", text[i:]):
                i = text.index("\x07", i) + 1
            elif re.match(r"\x1b[78=>MDEHc]", text[i:]):
                self.escape(text[i + 1])
                i += 2
            elif re.match(r"\x1b\[[0-9;?]*\x1b", text[i:]):  # a sequence that Ctrl-C cut off
                i = text.index("\x1b", i + 1)
            elif len(text) - i < 24:
                self.pending = text[i:]
                return
            else:
                raise ValueError("an unknown sequence: %r" % text[i:i + 12])

    def plain(self, c):
        if c == "\n":
            self.down()
        elif c == "\r":
            self.x = 0
        elif c == "\b":
            self.x = max(0, self.x - 1)
        elif c == "\t":
            self.x = min(self.cols - 1, (self.x // 8 + 1) * 8)
        elif c >= " ":
            if self.x == self.cols:
                self.x = 0
                self.down()
            self.cells[self.y][self.x] = self.last = c
            self.x += 1

    def down(self):
        if self.y == self.bottom:
            self.scroll(self.top, 1)
        elif self.y < self.rows - 1:
            self.y += 1

    def scroll(self, top, by):
        """Scrolls the region from row `top` on up by `by` rows, or down."""
        for _ in range(abs(by)):
            blank = [" "] * self.cols
            if by > 0:
                del self.cells[top]
                self.cells.insert(self.bottom, blank)
            else:
                del self.cells[self.bottom]
                self.cells.insert(top, blank)

    def escape(self, c):
        if c == "7":
            self.kept = self.y, self.x
        elif c == "8":
            self.y, self.x = self.kept
        elif c == "M":
            if self.y == self.top:
                self.scroll(self.top, -1)
            else:
                self.y = max(0, self.y - 1)

    def control(self, private, numbers, c):
        n = [int(part or 0) for part in numbers.split(";")] if numbers else []
        first = max(1, n[0] if n else 1)
        row = self.cells[self.y]
        if private:
            for mode in n:
                self.modes[mode] = c == "h"
                if mode == 1049:
                    self.other_screen(c == "h")
        elif c in "Hf":
            self.y = min(self.rows, first) - 1
            self.x = min(self.cols, max(1, n[1] if len(n) > 1 else 1)) - 1
        elif c == "A":
            self.y = max(0, self.y - first)
        elif c == "B":
            self.y = min(self.rows - 1, self.y + first)
        elif c == "C":
            self.x = min(self.cols - 1, self.x + first)
        elif c == "D":
            self.x = max(0, self.x - first)
        elif c in "G`":
            self.x = min(self.cols, first) - 1
        elif c == "d":
            self.y = min(self.rows, first) - 1
        elif c == "Z":
            self.x = max(0, (self.x - 1) // 8 * 8)
        elif c == "J":
            self.cleared += n == [2] or self.y == self.x == 0
            self.erase_screen(n[0] if n else 0)
        elif c == "K":
            self.erase(self.y, *{0: (self.x, self.cols), 1: (0, self.x + 1), 2: (0, self.cols)}[n[0] if n else 0])
        elif c == "X":
            self.erase(self.y, self.x, self.x + first)
        elif c == "P":
            self.cells[self.y] = (row[:self.x] + row[self.x + first:] + [" "] * first)[:self.cols]
        elif c == "@":
            self.cells[self.y] = (row[:self.x] + [" "] * first + row[self.x:])[:self.cols]
        elif c == "L":
            self.scroll(self.y, -first)
        elif c == "M":
            self.scroll(self.y, first)
        elif c in "ST":
            self.scroll(self.top, first if c == "S" else -first)
        elif c == "b":
            for _ in range(first):
                self.plain(self.last)
        elif c == "r":
            self.top = (n[0] if n else 1) - 1
            self.bottom = (n[1] if len(n) > 1 else self.rows) - 1
            self.y = self.x = 0
        elif c not in "mlhntgc":
            raise ValueError("an unknown control: %s%s" % (numbers, c))

    def other_screen(self, there):
        """Switches to the alternate screen, which is empty, or back."""
        if there:
            self.main = self.cells, self.y, self.x
            self.cells = [[" "] * self.cols for _ in range(self.rows)]
        elif self.main:
            cells, self.y, self.x = self.main
            self.cells = [(row + [" "] * self.cols)[:self.cols] for row in (cells + [[]] * self.rows)[:self.rows]]
            self.main = None

    def erase(self, y, begin, end):
        for x in range(max(0, begin), min(self.cols, end)):
            self.cells[y][x] = " "

    def erase_screen(self, part):
        if part != 1:
            self.erase(self.y, self.x if part == 0 else 0, self.cols)
            for y in range(self.y + 1 if part == 0 else 0, self.rows):
                self.erase(y, 0, self.cols)
        else:
            self.erase(self.y, 0, self.x + 1)
            for y in range(self.y):
                self.erase(y, 0, self.cols)
