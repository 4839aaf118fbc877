# SPDX-FileCopyrightText: 2026 The Relievo authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Machine: a Debian in QEMU with this repository at its own path, a screen, and a line on which it takes commands.

Nothing sleeps for a time that should be enough: everything is waited for, at most so long, and then told.
"""
import contextlib
import json
import pathlib
import re
import select
import shutil
import socket
import subprocess
import tempfile
import time

import numpy
from PIL import Image


class Failed(Exception):
    """What was expected did not come: a sentence for a person."""


def until(what, seconds, look, pause=0.25):
    """The first answer of look() that is not None; Failed when there is none in time."""
    end = time.monotonic() + seconds
    while True:
        answer = look()
        if answer is not None:
            return answer
        if time.monotonic() > end:
            raise Failed(f"{what}: not within {seconds} s")
        time.sleep(pause)


def end(process):
    process.terminate()
    try:
        process.wait(10)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def accelerator(guest):
    """The fastest that boots a kernel: one that can be opened may still not."""
    if pathlib.Path("/dev/kvm").exists():
        process = subprocess.Popen(
            ["qemu-system-x86_64", "-M", "q35", "-accel", "kvm", "-cpu", "max", "-m", "512", "-nodefaults", "-no-reboot", "-display", "none",
             "-kernel", guest / "vmlinuz", "-initrd", guest / "probe", "-append", "quiet panic=-1", "-serial", "stdio"],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        with contextlib.suppress(subprocess.TimeoutExpired):
            said, _ = process.communicate(timeout=10)
            if "the kernel boots" in said:
                return "kvm"
        end(process)
    return "tcg,thread=multi,tb-size=512"


class Machine:
    """with Machine(...) as machine: machine.run("a command of the guest")"""

    def __init__(self, guest, repository, results, accel, width_px, height_px, words=""):
        for path in (repository, results):
            if re.search(r"[\s,]", str(path)):
                raise Failed(f"{path}: has a blank or a comma in it, which a kernel's command line cannot take: use another folder")
        self.size_px = (width_px, height_px)
        self.results = pathlib.Path(results)
        self.sockets = pathlib.Path(tempfile.mkdtemp(prefix="relievo-vm-"))  # their names must be short
        self.said = b""
        # QEMU 7.2 plays AVX2's gathering loads wrongly: what llvmpipe compiles for them crashes.
        cpu = "host" if accel == "kvm" else "Nehalem"
        share = "local,security_model=none,multidevs=remap"
        self.command = [
            "nice", "qemu-system-x86_64", "-M", "q35", "-accel", accel, "-cpu", cpu, "-smp", "2", "-m", "3072", "-nodefaults", "-no-reboot",
            "-display", "none", "-kernel", f"{guest}/vmlinuz", "-initrd", f"{guest}/initrd",
            "-append", f"console=ttyS0 quiet panic=-1 mitigations=off consoleblank=0 vt.global_cursor_default=0 relievo.repository={repository} relievo.results={results} {words}",
            "-drive", f"file={guest}/root.sqfs,if=virtio,format=raw,readonly=on",
            "-virtfs", f"{share},path={repository},mount_tag=repository,readonly=on", "-virtfs", f"{share},path={results},mount_tag=results",
            "-device", f"virtio-gpu-pci,xres={width_px},yres={height_px}", "-device", "virtio-rng-pci",
            "-serial", f"file:{results}/console.log", "-chardev", f"socket,id=line,path={self.sockets}/line,server=on,wait=off", "-serial", "chardev:line",
            "-qmp", f"unix:{self.sockets}/qmp,server=on,wait=off"]

    def __enter__(self):
        try:
            self.process = subprocess.Popen(self.command, stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            self.line = self._connect("line")
            self.qmp = self._connect("qmp").makefile("rw")
            self.qmp.readline()
            self._ask("qmp_capabilities")
            self._read_until(rb"guest: ready\n", 600, "the guest does not boot")
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        end(self.process)
        shutil.rmtree(self.sockets, ignore_errors=True)

    def _connect(self, name):
        def attempt():
            if self.process.poll() is not None:
                raise Failed(f"qemu ended: {self.process.stderr.read().strip()}")
            with contextlib.suppress(OSError):
                connection = socket.socket(socket.AF_UNIX)
                connection.settimeout(60)
                connection.connect(str(self.sockets / name))
                return connection
            return None
        return until("qemu's line", 20, attempt)

    def _ask(self, command, **arguments):
        self.qmp.write(json.dumps({"execute": command, "arguments": arguments}) + "\n")
        self.qmp.flush()
        while True:
            line = self.qmp.readline()
            if not line:
                raise Failed("qemu has ended")
            answer = json.loads(line)
            if "error" in answer:
                raise Failed(f"qemu: {command}: {answer['error']['desc']}")
            if "return" in answer:
                return answer["return"]

    def _read_until(self, pattern, seconds, what):
        last = time.monotonic() + seconds
        while True:
            found = re.search(pattern, self.said)
            if found:
                before, self.said = self.said[:found.start()], self.said[found.end():]
                return before.decode(errors="replace"), found
            left = last - time.monotonic()
            if left <= 0 or self.process.poll() is not None:
                raise Failed(f"{what}: nothing within {seconds} s; the kernel's words: {self.results / 'console.log'}")
            if select.select([self.line], [], [], min(left, 1))[0]:
                self.said += self.line.recv(65536)

    def run(self, command, seconds=60, check=True):
        """What a shell of the guest's root says to the command; Failed if it does not end in time, or (check) not with 0."""
        assert "\n" not in command
        self.line.sendall(command.encode() + b"\n")
        said, found = self._read_until(rb"\nguest: (\d+)\n", seconds, command)
        if check and found[1] != b"0":
            raise Failed(f"{command}: exit code {int(found[1])}: {said.strip()}")
        return said.strip()

    def screen(self):
        """What a person would see now: rows x columns x RGB."""
        file = self.sockets / "screen.ppm"
        self._ask("screendump", filename=str(file))
        with Image.open(file) as picture:
            return numpy.asarray(picture.convert("RGB"))
