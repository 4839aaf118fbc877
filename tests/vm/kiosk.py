# SPDX-FileCopyrightText: 2026 The Relievo authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Kiosk: the product on the machine's console, and a person before it, who sees the screen and has fingers."""
import pathlib
import time

from PIL import Image

from machine import Failed, until

PANEL_STEPS = 32767
FIFO = "/run/fingers"
LOOKS_S = 1.5    # a page that has just come takes no touch (ui/view/visit.h: kTooLate)


class Panel:
    """A touch panel that is plugged into the machine: with Panel(machine, program) as panel: ..."""

    def __init__(self, machine, program):
        self.machine = machine
        self.program = program

    def __enter__(self):
        self.machine.run("modprobe uinput")
        self.machine.run(f"rm -f {FIFO}; mkfifo {FIFO}")
        # The fifo stays open for the time of a panel: a movement is one write to it.
        self.machine.run(f"sleep infinity >{FIFO} & echo $! >{FIFO}.holder; {self.program} <{FIFO} >{self.machine.results}/panel.err 2>&1 &")
        self.machine.run("udevadm settle --timeout=30; for tries in $(seq 100); do udevadm info --export-db | grep -q 'ID_INPUT_TOUCHSCREEN=1' && exit 0; sleep 0.1; done; exit 1")
        return self

    def __exit__(self, *_):
        self.machine.run(f"kill $(cat {FIFO}.holder); udevadm settle --timeout=30", check=False)

    def tell(self, *movements):
        """Each is "down FINGER", "move FINGER" with a place in pixels of the screen, or ("up FINGER",)."""
        lines = []
        for what, *place in movements:
            steps = [round(PANEL_STEPS * at / (side - 1)) for at, side in zip(place, self.machine.size_px)]
            lines.append(" ".join([what, *map(str, steps)]))
        self.machine.run("{ " + " ".join(f"echo {line};" for line in lines) + f" }} >{FIFO}", 20)


class Kiosk:
    def __init__(self, machine, program, pages, panel):
        self.machine = machine
        self.program = program
        self.pages = pages
        self.panel = panel
        self.files = machine.results / "kiosk"
        self.shots = 0

    def start(self, user="kiosk", words=""):
        for end in ("out", "err", "code"):
            self.files.with_suffix("." + end).unlink(missing_ok=True)
        on_console = pathlib.Path(__file__).parent / "guest/on_console"
        self.machine.run(f"{on_console} {user} {self.files} {self.program} --store {self.store(user)} {words}")

    def store(self, user="kiosk"):
        return f"/home/{user}/store"

    def ended(self, seconds):
        """Exit code, and what it said on standard error."""
        code = self.files.with_suffix(".code")
        until("the program ends", seconds, lambda: True if code.exists() and code.read_text().endswith("\n") else None)
        return int(code.read_text()), self.files.with_suffix(".err").read_text().strip()

    def stop(self):
        """As a service manager does: a signal. It ends with 0 and nothing to say."""
        self.machine.run("kill -TERM $(busybox pidof relievo)")
        code, said = self.ended(60)
        if (code, said) != (0, ""):
            raise Failed(f"the program should end with 0 and say nothing: {code}, {said}")

    def keep(self, name, picture):
        self.shots += 1
        Image.fromarray(picture).save(self.machine.results / f"{self.shots:02}_{name}.png")

    def see(self, name, seconds, without=(), only=()):
        """Waits for a page, keeps its picture, and returns it."""
        seen = difference = None

        def look():
            nonlocal seen, difference
            if self.files.with_suffix(".code").exists():
                raise Failed(f"the program has ended: {self.files.with_suffix('.err').read_text().strip()}")
            seen = self.machine.screen()
            difference = self.pages[name].difference(seen, without, only)
            return seen if difference is None else None
        try:
            picture = until(f"the page {name}", seconds, look)
        except Failed as failed:
            self.keep(f"not_{name}", seen)
            raise Failed(f"{failed}: {difference}; the picture: {self.shots:02}_not_{name}.png") from None
        self.keep(name, picture)
        return picture

    def stays(self, name, seconds, without=()):
        try:
            became = until("another page", seconds, lambda: self.pages[name].difference(self.machine.screen(), without))
        except Failed:
            return
        raise Failed(f"the page {name} should have stayed: {became}")

    def tap(self, x, y):
        time.sleep(LOOKS_S)
        self.panel.tell(("down 0", x, y), ("up 0",))

    def tap_node(self, page, node):
        self.tap(*self.pages[page].middle(node))

    def type(self, text):
        """On the page for the name, all letters at once: each is for the keys that the one before it led to."""
        taps = []
        for letter in text:
            page, key = ("name", "space") if letter == " " else ("name_empty" if letter.isupper() else "name", f"key {letter}")
            taps += [("down 0", *self.pages[page].middle(key)), ("up 0",)]
        time.sleep(LOOKS_S)
        self.panel.tell(*taps)
