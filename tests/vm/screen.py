#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Relievo authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The kiosk on a whole screen: KMS and a touch panel in a real kernel, the simulated rig before it. README.md says what holds.

Called by toolchain/vm, which builds what this needs.
"""
import os
import pathlib
import shutil
import signal
import sqlite3
import subprocess
import sys
import time

from kiosk import Kiosk, Panel
from machine import Failed, Machine, accelerator, until
from pages import Pages, different_pixels

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILT = ROOT / "build/release"
GUEST = ROOT / "build/vm"
RELIEVO = BUILT / "firmware/relievo"
NAME = "Ada Lovelace"    # as the gallery's page has it
SLOW = 300               # seconds for what is computed: a played processor takes twenty times as long


def check(holds, otherwise):
    if not holds:
        raise Failed(otherwise)


def drawn_headless(size):
    """The same pages without a screen, each with the places of its nodes; drawn anew when the program is newer."""
    folder = GUEST / "headless" / f"{size}_100_en"
    done = folder / "done"
    if not done.exists() or done.stat().st_mtime < RELIEVO.stat().st_mtime:
        shutil.rmtree(folder, ignore_errors=True)
        subprocess.run([RELIEVO, "--screenshots", folder.parent, "--only", folder.name, "--store", folder / "store"], check=True, timeout=900,
                       env={**os.environ, "SDL_VIDEODRIVER": "offscreen"}, stdout=subprocess.DEVNULL)
        shutil.rmtree(folder / "store")
        done.touch()
    return Pages(folder)


def photographed():
    """A pair of pictures of the simulated rig: to make the head is the work of minutes where processors are played."""
    folder = GUEST / "rig"
    if not (folder / "rig.yml").exists():
        shutil.rmtree(folder, ignore_errors=True)
        subprocess.run([RELIEVO, "simulate", "face", "--scale", "0.5", "-o", folder], check=True, timeout=900, stdout=subprocess.DEVNULL)
    return f"--board folder:{folder} --calibration {folder}/rig.yml"


def walk_in(kiosk):
    """From the page that invites to the live picture; fingers count where they are, to the pixel's neighbour."""
    kiosk.see("attract", SLOW, ["invitation_head"])
    button = kiosk.pages["attract"].nodes["start"]
    kiosk.tap(button["x"] - 4, button["y"] + button["h"] / 2)
    kiosk.tap(button["x"] + button["w"] / 2, button["y"] + button["h"] + 4)
    kiosk.stays("attract", 3, ["invitation_head"])
    kiosk.tap(button["x"] + 4, button["y"] + button["h"] - 5)
    kiosk.see("consent", 60)
    kiosk.tap_node("consent", "agree")
    kiosk.see("name_empty", 60)
    kiosk.type(NAME)
    kiosk.see("name", 60)
    kiosk.tap_node("name", "done")
    kiosk.see("position_look", SLOW, only=["shoot"])
    kiosk.tap_node("position_look", "shoot")    # a played processor may see too few pictures to count down by itself
    kiosk.see("working", SLOW, only=["title"])


def look_at_it(kiosk):
    """The face on the screen turns under one finger and grows under two."""
    page = kiosk.pages["review"]
    straight = kiosk.see("review", SLOW, ["face"])
    x, y = page.middle("face")
    step = page.nodes["face"]["w"] / 24
    kiosk.panel.tell(("down 0", x, y), *[("move 0", x + step * i, y) for i in range(1, 7)], ("up 0",))
    turned = face_changes(kiosk, straight, "turned")
    apart = [(f"move {finger}", x + side * step * i, y) for i in range(2, 6) for finger, side in ((0, -1), (1, 1))]
    kiosk.panel.tell(("down 0", x - step, y), ("down 1", x + step, y), *apart, ("up 0",), ("up 1",))
    face_changes(kiosk, turned, "larger")


def face_changes(kiosk, before, how):
    page = kiosk.pages["review"]

    def look():
        seen = kiosk.machine.screen()
        return seen if different_pixels(page.part(seen, "face"), page.part(before, "face")).mean() > 0.02 else None
    seen = until(f"the face is {how}", 60, look)
    kiosk.keep(how, seen)
    return seen


def visit(machine, pages):
    """A whole visit, another panel for the next one, and the end by a signal: the console is as it was."""
    machine.run("echo 'The console of this machine.' >/dev/tty1")
    before, keys_before = machine.screen(), machine.run("kbd_mode -C /dev/tty1")
    with Panel(machine, BUILT / "tests/vm/touch_panel") as panel:
        kiosk = Kiosk(machine, RELIEVO, pages, panel)
        kiosk.keep("console", before)
        kiosk.start(words=photographed())
        walk_in(kiosk)
        look_at_it(kiosk)
        kiosk.tap_node("review", "accept")
        kiosk.see("thanks", SLOW, only=["title", "what", "finish"])   # the box for the code is as wide as its digits
        kiosk.tap_node("thanks", "finish")
        kiosk.see("attract", 20, ["invitation_head"])
    with Panel(machine, BUILT / "tests/vm/touch_panel") as panel:
        kiosk.panel = panel
        kiosk.tap_node("attract", "start")
        kiosk.see("consent", 60)
    shown = machine.run("awk '/^[a-z]/ {part = $1} part ~ /^plane/ && /crtc=crtc/ {shown++} END {print shown + 0}' /sys/kernel/debug/dri/0/state")
    check(shown == "1", f"{shown} planes are shown: the picture alone should be, and no mouse's arrow")
    kiosk.stop()
    check(machine.run("kbd_mode -C /dev/tty1") == keys_before, "the console's keyboard was not given back")
    until("the console comes back", 30, lambda: True if not different_pixels(machine.screen(), before).any() else None)
    machine.run("echo 'It is in use again.' >/dev/tty1")
    after = until("the console can be written to", 30, lambda: seen if different_pixels(seen := machine.screen(), before).any() else None)
    kiosk.keep("console_again", after)
    rows(machine, kiosk)


def rows(machine, kiosk):
    """One person, one enrolment, with a consent and a model, in a store that is whole."""
    kept = machine.results / "relievo.db"
    machine.run(f"cp {kiosk.store()}/relievo.db {kept}")
    with sqlite3.connect(f"file:{kept}?mode=ro", uri=True) as store:
        counts = {table: store.execute(f"SELECT count(*) FROM {table}").fetchone()[0] for table in ("subject", "consent", "enrolment", "model")}
        whole = store.execute("PRAGMA integrity_check").fetchone()[0]
    kept.unlink()
    check(whole == "ok", f"the store: {whole}")
    check(set(counts.values()) == {1}, f"the store should have one row of each: {counts}")


def faults(machine, pages):
    """No right to the screen, a crash, and no screen at all: what is said, and that the console can be used afterwards."""
    kiosk = Kiosk(machine, RELIEVO, pages, None)
    keys = machine.run("kbd_mode -C /dev/tty1")
    refused(kiosk, "stranger", "relievo: /dev/dri/card0: this user may not use the screen: ")
    with Panel(machine, BUILT / "tests/vm/touch_panel"):
        kiosk.start(words=photographed())
        kiosk.see("attract", SLOW, ["invitation_head"])
        machine.run("kill -SEGV $(busybox pidof relievo)")
        code, _ = kiosk.ended(60)
        check(code != 0, "a crash should not look like an end")
    check(machine.run("kbd_mode -C /dev/tty1") == keys, "after a crash the console's keyboard is dead")
    machine.run("cd /sys/bus/virtio/drivers/virtio_gpu && echo virtio[0-9]* >unbind; udevadm settle --timeout=30")
    refused(kiosk, "kiosk", "relievo: /dev/dri: there is no graphics device: ")


def refused(kiosk, user, line):
    kiosk.start(user, photographed())
    code, said = kiosk.ended(SLOW)
    check(code == 1 and said.startswith(line) and "\n" not in said, f"should have ended with 1 and {line!r}: {code}, {said!r}")
    print(said, flush=True)


def service(machine, pages):
    """As it is installed, under systemd: a user and a store of its own, the screen, memory that stays; started again when it dies."""
    installed = machine.results / "installed"
    subprocess.run(["cmake", "--install", BUILT, "--component", "kiosk", "--prefix", "/usr/local"], check=True, stdout=subprocess.DEVNULL,
                   env={**os.environ, "DESTDIR": str(installed)})
    machine.run(f"cp -a {installed}/usr/local/. /usr/local/ && systemd-sysusers && systemctl daemon-reload && systemctl enable --now relievo")
    kiosk = Kiosk(machine, None, pages, None)

    def says():
        said = machine.run("journalctl -u relievo -o cat", check=False).splitlines()
        return next((line for line in said if line.startswith("relievo: /etc/relievo/board.toml")), None)
    print(until("it says that nothing is wired", SLOW, says), flush=True)
    override = "/etc/systemd/system/relievo.service.d"
    machine.run(f"mkdir -p {override} && printf '[Service]\\nExecStart=\\nExecStart=/usr/local/bin/relievo {photographed()} --store /var/lib/relievo\\n' "
                f">{override}/cameras.conf && systemctl daemon-reload && systemctl restart relievo")
    try:
        kiosk.see("attract", SLOW, ["invitation_head"])
    except Failed as failed:
        raise Failed(f"{failed}; its last words: {machine.run('journalctl -u relievo -o cat | tail -n 8', check=False)}") from None
    process = "/proc/$(systemctl show -p MainPID --value relievo)"
    for what, command, wanted in (("its user", f"stat -c %U {process}", "relievo"),
                                  ("its store", "stat -c '%a %U' /var/lib/relievo", "700 relievo"),
                                  ("the rights to set the clock and to mount sticks", f"awk '/CapAmb/ {{print $2}}' {process}/status", "0000000002200000"),
                                  ("no mounts of its own: sticks", f"[ $(readlink {process}/ns/mnt) = $(readlink /proc/1/ns/mnt) ] && echo shared", "shared"),
                                  ("core dumps", f"awk '/core file size/ {{print $5}}' {process}/limits", "0")):
        said = machine.run(command)
        check(said == wanted, f"{what}: {said!r}, wanted {wanted!r}")
    locked = int(machine.run(f"awk '/VmLck/ {{print $2}}' {process}/status"))
    check(locked > 100_000, f"only {locked} KiB of it stay in memory")
    machine.run("systemctl kill -s KILL relievo")
    kiosk.see("trouble_restarted", SLOW)
    machine.run("systemctl stop relievo")
    result = machine.run("systemctl show -p Result --value relievo")
    check(result == "success", f"it ended with {result}")


def sticks(machine, _):
    """Real file systems under an export: full, read-only, corrupt, pulled, hostile; what guest/sticks says is the result."""
    said = machine.run(f"bash {ROOT}/tests/vm/guest/sticks {RELIEVO} {BUILT}/tests/vm/stick_export 50 2>&1 | tee {machine.results}/sticks.log", 7200, check=False)
    print(said, flush=True)
    check("WRONG" not in said and "pulled 50 times" in said and "#1" in said, "a stick did what it should not, see above")


def power_cuts(machine, _):
    """What a store and files go through, on an ext4 whose device is replayed to every flush; tests/power judges."""
    said = machine.run("modprobe -a loop dm-log-writes ext4; mkdir /run/cut; TMPDIR=/run/cut RELIEVO_POWER_CUT_DEVICE=1 RELIEVO_POWER_CUT_SEEDS=4 "
                       f"{BUILT}/tests/power/test_power 2>&1 | tee {machine.results}/power_cuts.log", 7200, check=False)
    print(said, flush=True)
    check("[  PASSED  ]" in said and "FAILED" not in said, "something was lost, or half, or could be read, see above")


CASES = {
    "faults": ("1280x800", faults),
    "visit-1280x800": ("1280x800", visit),
    "service": ("1280x800", service, "relievo.systemd"),
    "sticks": (None, sticks),
    "power_cuts": (None, power_cuts),
    "visit-1080x1920": ("1080x1920", visit),
}


def play(name, accel):
    size, case, *words = CASES[name]
    pages = drawn_headless(size) if size else None
    results = GUEST / "seen" / name
    shutil.rmtree(results, ignore_errors=True)
    results.mkdir(parents=True)
    with Machine(GUEST, ROOT, results, accel, *map(int, (size or "640x480").split("x")), *words) as machine:
        case(machine, pages)


def main(names):
    if names == ["--list"]:
        print("\n".join(CASES))
        return 0
    unknown = [name for name in names if name not in CASES]
    if unknown:
        print(f"vm: there is no case {unknown[0]}: toolchain/vm --list names them", file=sys.stderr)
        return 2
    accel = accelerator(GUEST)
    print(f"vm: processors by {accel.split(',')[0]}", flush=True)
    failed = 0
    for name in names or CASES:
        begin = time.monotonic()
        print(f"== {name}", flush=True)
        try:
            play(name, accel)
            print(f"held, {time.monotonic() - begin:.0f} s", flush=True)
        except Failed as why:
            failed += 1
            print(f"FAILED: {why}", flush=True)
    count = len(names or CASES)
    print(f"vm: {count - failed} passed, {failed} failed; what was seen: {GUEST / 'seen'}")
    return 1 if failed else 0


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))   # the machine ends with us
    sys.exit(main(sys.argv[1:]))
